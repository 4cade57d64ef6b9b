#pragma once

#include <string>
#include <vector>

#include "planner/ground/base/result.h"
#include "planner/model/nouns/enumerations.h"
#include "planner/model/plan/plan.h"

namespace capstan::exchange {

/// How far a left-handed helix, which ISO 14649's HELIX cannot say, may stray from its chords.
inline constexpr double kHelixChordMm = 0.001;  // default, unsourced

/// Gives every trajectory that has a model::CutterPath and no basiccurve its curves: one
/// CUTTER_LOCATION_TRAJECTORY per run of equal purpose, feed and speed, in the place of the one that had the
/// path; POLYLINE for straight runs and left-handed helices (left_helix.h), TRIMMED_CURVE of CIRCLE or HELIX
/// for arcs, COMPOSITE_CURVE where mixed; FEEDSTOP for a dwell. A step whose path stands only in `plan.steps`
/// gets a toolpath first. Curve coordinates are those that `frame_of_step` names. Changes `plan.model` only.
///
/// Losses  sentences about what the curves cannot say.
/// Fails   when a step's frame cannot be found.
[[nodiscard]] Status write_curves(model::Plan& plan, std::vector<std::string>& losses);

// Functions on toolpaths that both exchanges need.

/// Paths that only the plan's results hold get a toolpath in the model.
void adopt_paths(model::Plan& plan);
/// Whether a trajectory has a path and no curves.
[[nodiscard]] bool has_bare_path(const model::Model& m, model::AnyRef at);
/// The purpose of a run of moves, in the file's terms.
[[nodiscard]] model::ToolpathType toolpath_type_of(model::MoveRole role, bool rapid);
/// The list of toolpaths of an executable, unset if it has none.
[[nodiscard]] model::AnyRef toolpath_list_of(const model::Model& m, model::AnyRef step);

}  // namespace capstan::exchange

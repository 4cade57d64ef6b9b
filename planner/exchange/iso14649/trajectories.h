#pragma once

#include <string>
#include <vector>

#include "planner/base/result.h"
#include "planner/model/plan.h"

namespace capstan::exchange {

/// How far a left-handed helix, which ISO 14649's HELIX cannot say, may stray from its chords.
inline constexpr double kHelixChordMm = 0.001;  // default, unsourced

/// Gives every trajectory that has a model::CutterPath and no basiccurve its curves: one
/// CUTTER_LOCATION_TRAJECTORY per run of equal purpose, feed and speed, in the place of the one that had the
/// path; POLYLINE for straight runs, TRIMMED_CURVE of CIRCLE or HELIX for arcs, COMPOSITE_CURVE where mixed;
/// FEEDSTOP for a dwell. A step whose path stands only in `plan.steps` gets a toolpath first. Curve
/// coordinates are those that `frame_of_step` names. Changes `plan.model` only.
///
/// Losses  sentences about what the curves cannot say.
/// Fails   when a step's frame cannot be found.
[[nodiscard]] Status write_curves(model::Plan& plan, std::vector<std::string>& losses);

}  // namespace capstan::exchange

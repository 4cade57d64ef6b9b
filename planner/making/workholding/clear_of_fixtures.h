#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "planner/ground/base/result.h"
#include "planner/ground/geometry/region.h"
#include "planner/making/draft/draft.h"
#include "planner/making/toolpath/path_job.h"
#include "planner/model/plan/cutter_path.h"
#include "planner/model/plan/resources/workholding.h"

// Paths against the solids that hold the piece.

namespace capstan::workholding {

/// A move that comes nearer to a solid than the clearance.
struct NearMove {
  std::size_t move = 0;
  std::string text;  ///< move, part of the tool, solid and distance
};
/// The worst move of a path, or nothing when all keep clear. Rapids are taken as the box between their ends;
/// the tool as upright cylinders (flutes, shank, holder), each at all heights that the move takes it through.
[[nodiscard]] std::optional<NearMove> near_move_of(const model::CutterPath& path, const model::Cutter& cutter,
                                                   const model::Workholding& holding);

/// Makes a path in a set-up. If it comes near the workholding, makes it again with higher links, then around
/// the workholding.
/// Fails  as `make`; PIP-HOLDING, naming move and solid, if none of these keeps clear, or some of the feature
///        would stay uncut under a clamp.
[[nodiscard]] Result<toolpath::GeneratedPath> kept_clear(
    const draft::SetupDraft& setup, const model::Cutter& cutter, const toolpath::PathJob& job,
    const std::function<Result<toolpath::GeneratedPath>(const toolpath::PathJob&)>& make);

/// Area of a step's cut in a set-up, and its lowest height, set-up frame.
struct Footprint {
  geometry::Region area;
  double low_mm = 0.0;
};
/// Those of the steps of set-up `at`.
[[nodiscard]] std::vector<Footprint> footprints(const draft::SetupDraft& setup, std::size_t at,
                                                const std::vector<draft::StepDraft>& steps);
/// The first solid that a cut would come near; null: none.
[[nodiscard]] const model::FixtureSolid* in_the_way(const model::Workholding& holding,
                                                    const std::vector<Footprint>& cuts);

}  // namespace capstan::workholding

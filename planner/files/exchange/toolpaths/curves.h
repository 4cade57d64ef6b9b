#pragma once

#include <cstddef>
#include <vector>

#include "planner/files/exchange/toolpaths/step_frames.h"
#include "planner/ground/base/job.h"
#include "planner/ground/base/result.h"
#include "planner/ground/geometry/placement.h"
#include "planner/model/plan/cutter_path.h"
#include "planner/model/plan/plan.h"

namespace capstan::exchange {

struct CurveOptions {
  double chord_tolerance_mm =
      0.001;             ///< of curves that are neither lines nor arcs about z; default, unsourced
  double gap_mm = 0.01;  ///< ends this near are one point; default, unsourced (files have 4 decimals)
  std::size_t max_moves = 1'000'000;  ///< of one path
  double coincident_mm = 1e-5;        ///< via points this near to a neighbour make no arc
  geometry::Vec3 helix_axis = {0, 0,
                               1};  ///< of via_helix_points: the stated tool axis, else the curve's own z
};

/// The path of a step, from its toolpaths.
struct StepPath {
  model::CutterPath path;         ///< in the set-up's frame
  model::FeedSchedule schedule;   ///< from each toolpath's technology, else the operation's; 0 where open
                                  ///< cutspeed and feed per tooth by the tool's diameter and teeth; speed
                                  ///< curves and ratios as multiples of that feed
  model::SectionSeries sections;  ///< where a file states the cross-section parameters
};

/// The whole step: toolpaths one after the other; empty if it has none. A toolpath that carries a
/// model::CutterPath (which is in the set-up's frame already) is taken as it is, with the schedule that the
/// plan's results have for it. `recorded`: of a plan that is executed anew, its results as they were read. If
/// the technology states another feed or speed than these, it was edited since, and it holds throughout.
///
/// Arcs about the set-up's z stay arcs, a helix too (turn by turn); other curves are
/// sampled. A trimmed LINE runs from trim_1 to trim_2 whatever its sense says (published files contradict
/// themselves there); a trimmed circle or helix runs from trim_1 to trim_2 in the sense stated.
///
/// Tool    stays along the set-up's z: a tool axis that tilts is refused.
/// Moves   rapid when its_speed is RAPID, or when its_type is CONNECT without a technology of its own (so the
///         published toolkit reads it); else at feed.
/// Fails   EXC-CURVE (a curve that cannot be followed), EXC-TOOLPATH (a kind without geometry of its own),
///         EXC-TOOL-AXIS; EXC-GAP where a toolpath does not begin where the one before ended.
[[nodiscard]] Result<StepPath> path_of_step(const model::Plan& plan, model::Ref<model::Executable> step,
                                            const CurveOptions& options, Job& job,
                                            const std::vector<model::StepResult>* recorded = nullptr);

}  // namespace capstan::exchange

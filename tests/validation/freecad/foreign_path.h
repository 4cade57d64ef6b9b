#pragma once

#include <string_view>

#include "planner/door/pipeline/pipeline.h"
#include "planner/ground/base/job.h"
#include "planner/ground/base/result.h"
#include "planner/model/plan/cutter_path.h"
#include "planner/model/plan/plan.h"

// Paths that another planner made, in one of our plans.

namespace capstan::validation {

/// The moves of a program (RS274/NGC) as a path: what runs at feed above `top_z_mm` is an approach, what goes
/// down is a plunge or a ramp, straight up a retract, anything else cuts. Feeds are not taken.
/// Frame  the program's work offset. Units  mm.
/// Fails  VAL-PROGRAM for what the reader cannot follow, or a program without a move.
[[nodiscard]] Result<model::CutterPath> path_of_program(std::string_view text, double top_z_mm);

/// The same path in pieces of at most this length, so that a heavy corner slows its piece and not a long
/// move: our own paths are split there, given ones are not.
[[nodiscard]] model::CutterPath in_pieces(const model::CutterPath& path, double most_mm);

/// The plan with this path in the place of the path of step `at`, planned again: cutter, spindle speed and
/// limits stay, the feed is chosen for the path's own sections, one for the whole step where the inputs ask
/// for constant feeds. The path is taken as a file's own: nothing of it is changed.
/// Needs  inputs and policy with which `plan` was made.
/// Fails  as `pipeline::bind`.
[[nodiscard]] Result<model::Plan> with_path(const model::Plan& plan, std::size_t at, model::CutterPath path,
                                            const pipeline::Inputs& inputs, Job& job);

}  // namespace capstan::validation

#pragma once

#include <cstddef>

#include "planner/controls/gcode/moves/hole_cycles.h"
#include "planner/ground/base/result.h"
#include "planner/model/plan/plan.h"

namespace capstan::controls::gcode {

/// The tapped hole that begins with move `down` of the step, the tool at `top` (rounded): the control goes
/// down in step with the spindle, which turns at `rpm` (1/min, below 0 left-handed), reverses it, and comes
/// back to where it began: the move down, perhaps dwells, and the move up. Held by a compensating chuck where
/// the operation says so. Errors  OUT-TAP: other moves, a spindle that stands, a pitch that is not the
/// cutter's.
[[nodiscard]] Result<HoleInPath> tap_at(const model::Plan& plan, const model::StepResult& step,
                                        const model::Cutter& cutter, std::size_t down, geometry::Vec3 top,
                                        double rpm);

}  // namespace capstan::controls::gcode

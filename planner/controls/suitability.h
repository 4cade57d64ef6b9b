#pragma once

#include <vector>

#include "planner/controls/dialect.h"
#include "planner/model/plan/plan.h"

namespace capstan::controls {

/// Whether the control of a plan's machine is able to do what the plan asks of it, before the first chip.
///
/// Errors    what it cannot do: FIT-ARC, FIT-HELIX, FIT-TAP, FIT-AXES, FIT-RADIUS, FIT-FEED, FIT-OFFSETS,
///           FIT-TOOL-NUMBER, FIT-TOOL-CHANGE.
///
/// Warnings  what may come out otherwise than planned: FIT-TOLERANCE, a tolerance of the path that the
///           program cannot say, or that is less than the last decimal of its numbers.
///
/// Notes     what takes longer than planned: FIT-BLOCK-TIME, moves shorter than the control takes for one
///           block; FIT-LOOK-AHEAD, feeds from which it cannot stop within the moves that it looks ahead.
///
/// One finding for each code and step, at the worst move, with the number of the others. Once for the plan
/// FIT-TOLERANCE says which figure of the machine's file is assumed of a control whose programs state none,
/// until the file says that the control's parameter is set to it.
[[nodiscard]] std::vector<model::Finding> suitability(const model::Plan& plan, const Conformance& control);
/// The same with the row of the plan's control; nothing for a control without one.
[[nodiscard]] std::vector<model::Finding> suitability(const model::Plan& plan);

}  // namespace capstan::controls

#pragma once

#include "planner/files/exchange/common/noun_faults.h"
#include "planner/model/plan/plan.h"

namespace capstan::exchange {

/// Marks as open in the plan's ledger the values that the project needs and the file leaves out: `$` in
/// its_operation, its_tool and its_technology, a tool without usable dimensions, a technology without feed or
/// speed. Each is reported by the note EXC-OPEN.
void open_what_is_left_out(model::Plan& plan, const Marks& reached, Reporter& reporter);

}  // namespace capstan::exchange

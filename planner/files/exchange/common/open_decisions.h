#pragma once

#include "planner/files/exchange/common/noun_faults.h"
#include "planner/model/plan/plan.h"

namespace capstan::exchange {

/// Marks as open in the plan's ledger what the file left out and what the project needs: `$` in
/// its_operation, its_tool and its_technology, a tool without usable dimensions, a technology without feed
/// or speed. Each is told as the note EXC-OPEN.
void open_what_is_left_out(model::Plan& plan, const Marks& reached, Reporter& reporter);

}  // namespace capstan::exchange

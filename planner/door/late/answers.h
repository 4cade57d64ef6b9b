#pragma once

#include <vector>

#include "planner/ground/base/result.h"
#include "planner/making/given/magazine.h"
#include "planner/model/plan/plan.h"

// What every answer of late binding is asked before it is checked, however it came about.

namespace capstan::late {

/// No answer may use a cutter that is not in the table, or without a length there: LATE-TOOL, with step and
/// tool, and of one that is out of use the reason.
[[nodiscard]] Status only_loaded(const model::Plan& plan, const std::vector<model::Cutter>& magazine,
                                 const std::vector<given::OutOfUse>& out_of_use);

/// None may leave anything open: LATE-OPEN, with the first reason.
[[nodiscard]] Status nothing_open(const model::Plan& plan);

/// Nobody at the machine agrees to rest material that was not agreed to when the part was planned: LATE-REST.
[[nodiscard]] Status no_more_rest(const model::Plan& brought, const model::Plan& made);

/// Whether planning chose all operations and paths of the plan, and nobody pinned a value: then it may choose
/// them once more.
[[nodiscard]] bool planning_chose_all(const model::Plan& plan);

}  // namespace capstan::late

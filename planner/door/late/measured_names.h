#pragma once

#include "planner/door/late/branches.h"
#include "planner/ground/base/result.h"
#include "planner/model/plan/plan.h"

namespace capstan::late {

/// Refuses a name that no condition of the plan reads: its value would decide nothing. An if statement that
/// an earlier binding decided is no statement any more. Fails  NAME-UNKNOWN, with the names that are near.
[[nodiscard]] Status only_read(const model::Plan& plan, const Measured& measured);

}  // namespace capstan::late

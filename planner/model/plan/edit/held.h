#pragma once

#include <string>

#include "planner/model/plan/plan.h"

namespace capstan::model {

/// The edits that hold values of a workingstep, in words, "; " between them; empty: none. The ledger says so,
/// and with it every form of a plan.
[[nodiscard]] std::string edits_of_step(const Plan& plan, AnyRef step);

}  // namespace capstan::model

#pragma once

#include <map>
#include <string>

#include "planner/model/plan/plan.h"

namespace capstan::model {

/// The edits that hold values of a workingstep, in words, "; " between them; empty: none. The ledger says so,
/// and with it every form of a plan.
[[nodiscard]] std::string edits_of_step(const Plan& plan, AnyRef step);

/// Those of all steps of which edits hold a value, by persistent id.
[[nodiscard]] std::map<std::string, std::string> held_steps(const Plan& plan);
/// Adds to a finding of such a step which edits hold its values: it names both the limit and the edit.
void name_edits(const std::map<std::string, std::string>& held, Finding& f);

}  // namespace capstan::model

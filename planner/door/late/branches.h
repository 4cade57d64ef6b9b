#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "planner/door/late/changes.h"
#include "planner/ground/base/result.h"
#include "planner/model/plan/cutter/cutter.h"
#include "planner/model/plan/plan.h"

namespace capstan::late {

/// What was measured, by the names of NC variables.
using Measured = std::map<std::string, double>;
/// "wall=0.04,floor=-0.01". Fails  OPTION-VALUE.
[[nodiscard]] Result<Measured> parse_measured(const std::string& text);

/// Whether a plan has statements or alternatives that `take_branches` could decide.
[[nodiscard]] bool has_branches(const model::Plan& plan);

/// Takes the ways of a plan that are the machine's to choose, in the order of execution. In the workplan
/// stands then what is executed, in place of
///  - an if statement: its branch, by what was measured; nothing where that is the false one and there is
///  none;
///  - a while statement that is reached: once more its body, with the statement behind it, which is decided
///  again by
///    the next binding; nothing where its condition does not hold. Reached: of the steps before it `bound`
///    are bound, which are all;
///  - a selective: the first of its enabled elements of which all given tools are loaded, where that is not
///  the first
///    of all.
/// A condition whose variables were not all measured, and have no other value, stays: what depends on it is
/// not planned. Gives what was decided and why, one sentence each; the ledger has the same with the element
/// that was taken (attribute "enabled"). Fails  LATE-POLICY for a decision that may not be taken here.
[[nodiscard]] Result<std::vector<std::string>> take_branches(model::Plan& plan, const Measured& measured,
                                                             const std::vector<model::Cutter>& magazine,
                                                             Decisions may, std::size_t bound);

}  // namespace capstan::late

#pragma once

#include <string>
#include <vector>

#include "planner/ground/base/result.h"
#include "planner/model/nouns/all.h"
#include "planner/model/plan/plan.h"

namespace capstan::service {

/// An object that holds values of a workingstep, and its role in the step.
struct StepPart {
  std::string role;  ///< "operation", "its_tool", "its_technology", "its_machining_strategy", ...
  model::AnyRef object;
};

/// One workingstep as explain and diff look at it.
struct StepView {
  model::AnyRef step, feature, operation;
  const model::StepResult* result = nullptr;  ///< null: not planned (yet)
  std::size_t number = 0;                     ///< in the order of execution, from 1; 0 when not planned
  std::string id;
  /// Step, operation, and what only they lead to; the feature, where it was recognised. In a fixed order.
  std::vector<StepPart> parts;
};

/// Every workingstep: the planned ones in the order of execution, then those that only the file has.
[[nodiscard]] std::vector<StepView> views_of(const model::Plan& plan);

/// The step that is meant by an id or a number.
/// Fails  EXP-STEP.
[[nodiscard]] Result<StepView> find_step(const model::Plan& plan, std::string_view wanted);

/// Who bound the decision, in words ("rule", "given in the file", ...).
[[nodiscard]] std::string binder_text(const model::Plan& plan, const model::Decision* d);

/// Diameter, class and id of a cutter in a few words.
[[nodiscard]] std::string cutter_text(const model::Plan& plan, std::string_view cutter_id);

/// The open decisions of the objects that the project, its steps and features reach. A technology that was
/// replaced is not reached any more.
[[nodiscard]] std::vector<model::DecisionKey> open_decisions(const model::Plan& plan);

}  // namespace capstan::service

#include "planner/making/given/steps/safety_changes.h"

#include <string>
#include <utility>

#include "planner/ground/base/number.h"
#include "planner/model/nouns/all.h"

namespace capstan::given {
namespace {

using draft::StepDraft;
using model::AnyRef;

/// A tool cannot be withdrawn at no feed: such a value is taken as not stated, for this operation only.
void overrule_retract(model::Plan& plan, const StepDraft& step, Job& job) {
  auto* op = plan.model.get<model::DrillingTypeOperation>(step.operation);
  if (op == nullptr || !op->feed_on_retract || *op->feed_on_retract > 0.0) return;
  const std::string value = trimmed(*op->feed_on_retract, 4);
  op->feed_on_retract.reset();
  job.report({.code = "PIP-CHANGED",
              .severity = Severity::kWarning,
              .message = "operation '" + op->its_id.value_or("") + "': feed_on_retract is " + value +
                         ", at which the tool never leaves its hole; taken as not stated",
              .file = plan.file_name,
              .line = plan.model.origin(step.operation).line,
              .instance = plan.model.origin(step.operation).instance});
}

/// A reamer that stops in its hole marks the wall: given so, it is kept only while everything given is kept.
void overrule_stop(model::Plan& plan, const StepDraft& step, Job& job) {
  auto* op = plan.model.get<model::Reaming>(step.operation);
  if (op == nullptr || !step.open_technology || !op->spindle_stop_at_bottom.value_or(false)) return;
  op->spindle_stop_at_bottom = false;
  job.warn("PIP-CHANGED", "operation '" + op->its_id.value_or("") +
                              "': the reamer would be withdrawn with the spindle stopped; it keeps turning");
  plan.ledger.bind(step.operation, "spindle_stop_at_bottom", model::Binder::kRule,
                   {"safety.reamer_turns", "a reamer withdrawn without turning scores the wall and may break",
                    "safety: the spindle turns while the tool is in the material"});
}

/// Replaces coolant that the machine does not have by the next best, and reports it.
void overrule_coolant(model::Plan& plan, const StepDraft& step, Job& job) {
  const auto* op = plan.model.get<model::MachiningOperation>(step.operation);
  if (op == nullptr) return;
  const AnyRef functions = op->its_machine_functions;
  auto* f = plan.model.get<model::MillingMachineFunctions>(functions);
  if (f == nullptr) return;
  const model::Machine& machine = plan.machine;
  const bool through = f->through_spindle_coolant.value_or(false) && !machine.has_through;
  const bool mist = f->mist.value_or(false) && !machine.has_mist;
  const bool flood = f->coolant.value_or(false) && !machine.has_flood;
  if (!through && !mist && !flood) return;
  std::string what;
  for (const auto& [lacks, name] : {std::pair{through, "coolant through the spindle"},
                                    std::pair{mist, "mist"}, std::pair{flood, "flood coolant"}}) {
    if (lacks) what += (what.empty() ? "" : " and ") + std::string(name);
  }
  if (through) f->through_spindle_coolant = false;
  if (mist) f->mist = false;
  if (flood) f->coolant = false;
  const bool on = f->coolant.value_or(false) || f->mist.value_or(false);
  const char* instead = on ? "cut without it" : "cut dry";
  if (!on && machine.has_flood) {
    f->coolant = true;
    instead = "cut with flood";
  } else if (!on && machine.has_mist) {
    f->mist = true;
    instead = "cut with mist";
  }
  const std::string text = "machine '" + machine.id + "' has no " + what + ": " + instead;
  job.warn("PIP-CHANGED", "operation '" + op->its_id.value_or("") + "': " + text);
  for (const char* attribute : {"through_spindle_coolant", "mist", "coolant"}) {
    if ((attribute[0] == 't' && !through) || (attribute[0] == 'm' && !mist) ||
        (attribute[0] == 'c' && !flood))
      continue;
    plan.ledger.bind(functions, attribute, model::Binder::kRule,
                     {"machine.coolant", text, "the machine's own description"});
  }
}

}  // namespace

void change_for_safety(model::Plan& plan, const StepDraft& step, Job& job) {
  overrule_stop(plan, step, job);
  overrule_retract(plan, step, job);
  overrule_coolant(plan, step, job);
}

}  // namespace capstan::given

#include "planner/model/plan/edit/cycles.h"

#include "planner/model/nouns/all.h"
#include "planner/model/plan/edit/deciding.h"
#include "planner/model/plan/edit/provenance.h"
#include "planner/model/plan/edit/step_names.h"
#include "planner/model/plan/resources/control_options.h"

namespace capstan::model {

std::vector<std::string> cycles_by_step(const Plan& plan) {
  std::vector<std::string> out(plan.steps.size());
  const std::vector<Edit> edits = edits_of(plan);
  if (edits.empty()) return out;
  for (std::size_t i = 0; i < plan.steps.size(); ++i) {
    const auto* ws = plan.model.get<MachiningWorkingstep>(plan.steps[i].step);
    if (ws == nullptr) continue;
    const StepNames names = step_names(plan.model, plan.steps[i].step, ws->its_feature);
    if (const Edit* e = deciding(edits, EditOf::kCycles, names)) out[i] = e->value;
  }
  return out;
}

bool asks_for_pocket_cycle(const Machine& machine, std::string_view of_step) {
  return (of_step.empty() ? control_option(machine, "cycles") : of_step) == kPocketCycles;
}

}  // namespace capstan::model

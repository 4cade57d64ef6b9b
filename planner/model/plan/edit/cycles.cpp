#include "planner/model/plan/edit/cycles.h"

#include <optional>

#include "planner/model/nouns/all.h"
#include "planner/model/plan/edit/deciding.h"
#include "planner/model/plan/edit/provenance.h"

namespace capstan::model {

std::vector<std::string> cycles_by_step(const Plan& plan) {
  std::vector<std::string> out(plan.steps.size());
  const std::vector<Edit> edits = edits_of(plan);
  if (edits.empty()) return out;
  const auto text = [](const auto& t) { return t ? std::string_view(*t) : std::string_view(); };
  for (std::size_t i = 0; i < plan.steps.size(); ++i) {
    const auto* ws = plan.model.get<MachiningWorkingstep>(plan.steps[i].step);
    if (ws == nullptr) continue;
    const auto* feature = plan.model.get<ManufacturingFeature>(ws->its_feature);
    const StepNames names{feature != nullptr ? text(feature->its_id) : std::string_view(), text(ws->its_id),
                          text(ws->persistent_id)};
    if (const Edit* e = deciding(edits, EditOf::kCycles, names)) out[i] = e->value;
  }
  return out;
}

}  // namespace capstan::model

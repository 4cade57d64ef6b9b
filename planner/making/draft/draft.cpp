#include "planner/making/draft/draft.h"

#include <algorithm>

#include "planner/model/plan/edit/step_names.h"

namespace capstan::draft {

std::string key_of(const std::vector<model::ProposedStep>& chain) {
  if (chain.empty()) return {};
  return chain.front().why.id + "#" + std::to_string(chain.front().priority);
}

std::string name_of(const model::Model& m, const StepDraft& step) {
  const auto* e = m.get<model::Executable>(step.step);
  return e != nullptr ? e->its_id.value_or("") : "";
}

std::string_view feature_name(const model::Model& m, AnyRef feature) {
  return model::feature_name(m, feature);
}

model::StepNames edit_names(const model::Model& m, const StepDraft& step) {
  model::StepNames out = model::step_names(m, step.step, step.feature);
  if (m.get<model::Executable>(step.step) == nullptr) out.step = step.proposal.name;
  return out;
}

bool cuts_levels(const model::Model& m, const StepDraft& step) {
  return m.holds<model::FreeformFinishMilling>(step.operation) &&
         step.cutter.cutter_class == model::CutterClass::kEndmill;
}

std::vector<std::string> cutters_of(const std::vector<StepDraft>& steps) {
  std::vector<std::string> out;
  const auto add = [&](const std::string& id) {
    if (!id.empty() && std::find(out.begin(), out.end(), id) == out.end()) out.push_back(id);
  };
  for (const StepDraft& s : steps) {
    add(s.cutter.id);
    if (s.probing && s.probing->probe) add(s.probing->probe->cutter.id);
  }
  return out;
}

}  // namespace capstan::draft

#include "planner/making/draft/draft.h"

namespace capstan::draft {

std::string key_of(const std::vector<model::ProposedStep>& chain) {
  if (chain.empty()) return {};
  return chain.front().why.id + "#" + std::to_string(chain.front().priority);
}

std::string name_of(const model::Model& m, const StepDraft& step) {
  const auto* e = m.get<model::Executable>(step.step);
  return e != nullptr ? e->its_id.value_or("") : "";
}

bool cuts_levels(const model::Model& m, const StepDraft& step) {
  return m.holds<model::FreeformFinishMilling>(step.operation) &&
         step.cutter.cutter_class == model::CutterClass::kEndmill;
}

}  // namespace capstan::draft

#include "planner/making/draft/draft.h"

#include <algorithm>

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
  const auto* f = m.get<model::ManufacturingFeature>(feature);
  return f != nullptr && f->its_id ? std::string_view(*f->its_id) : std::string_view();
}

model::StepNames edit_names(const model::Model& m, const StepDraft& step) {
  const auto* e = m.get<model::Executable>(step.step);
  const auto text = [](const auto& t) { return t ? std::string_view(*t) : std::string_view(); };
  if (e == nullptr) return {feature_name(m, step.feature), step.proposal.name, {}};
  return {feature_name(m, step.feature), text(e->its_id), text(e->persistent_id)};
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

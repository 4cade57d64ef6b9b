#include "planner/model/plan/edit/step_names.h"

#include "planner/model/nouns/all.h"
#include "planner/model/nouns/arena/model.h"

namespace capstan::model {

std::string_view feature_name(const Model& m, AnyRef feature) {
  const auto* f = m.get<ManufacturingFeature>(feature);
  return f != nullptr && f->its_id ? std::string_view(*f->its_id) : std::string_view();
}

StepNames step_names(const Model& m, AnyRef step, AnyRef feature) {
  const auto* e = m.get<Executable>(step);
  if (e == nullptr) return {feature_name(m, feature), {}, {}};
  const auto text = [](const auto& t) { return t ? std::string_view(*t) : std::string_view(); };
  return {feature_name(m, feature), text(e->its_id), text(e->persistent_id)};
}

}  // namespace capstan::model

#include "planner/model/plan/plan.h"

#include "planner/model/nouns/executable.h"

namespace capstan::model {
namespace {

std::string own_id(const Plan& plan, Ref<Executable> step) {
  const Executable* e = plan.model.get<Executable>(step);
  if (e == nullptr) return {};
  return e->persistent_id ? *e->persistent_id : e->its_id.value_or("");
}

}  // namespace

std::string step_id(const Plan& plan, const StepResult& step) {
  const std::string id = own_id(plan, step.step);
  std::size_t same_before = 0;
  for (const StepResult& other : plan.steps) {
    if (&other == &step) break;
    if (own_id(plan, other.step) == id && other.step != step.step) ++same_before;
  }
  return same_before == 0 ? id : id + "~" + std::to_string(same_before + 1);
}

const Cutter* find_cutter(const Plan& plan, std::string_view id) {
  for (const Cutter& c : plan.cutters) {
    if (c.id == id) return &c;
  }
  return nullptr;
}

}  // namespace capstan::model

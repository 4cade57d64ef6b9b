#include "planner/model/plan/plan.h"

#include <map>
#include <utility>

#include "planner/model/nouns/executable.h"
#include "planner/model/plan/step_ids.h"

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

std::vector<std::string> step_ids(const Plan& plan) {
  std::vector<std::string> out;
  // How many results of each own id there were, and how many of them of the same step.
  std::map<std::string, std::pair<std::size_t, std::map<Ref<Executable>, std::size_t>>> before;
  for (const StepResult& s : plan.steps) {
    std::string id = own_id(plan, s.step);
    auto& [all, of_step] = before[id];
    const std::size_t same_before = all++ - of_step[s.step]++;
    out.push_back(same_before == 0 ? std::move(id) : id + "~" + std::to_string(same_before + 1));
  }
  return out;
}

const Cutter* find_cutter(const Plan& plan, std::string_view id) {
  for (const Cutter& c : plan.cutters) {
    if (c.id == id) return &c;
  }
  return nullptr;
}

}  // namespace capstan::model

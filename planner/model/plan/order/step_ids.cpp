#include "planner/model/plan/order/step_ids.h"

#include <map>
#include <utility>

#include "planner/model/nouns/executable.h"

namespace capstan::model {

std::vector<std::string> step_ids(const Plan& plan) {
  struct Seen {
    std::size_t all = 0;
    std::map<AnyRef, std::size_t> of_step;
  };
  std::map<std::string, Seen> seen;
  std::vector<std::string> out;
  out.reserve(plan.steps.size());
  for (const StepResult& step : plan.steps) {
    const auto* e = plan.model.get<Executable>(step.step);
    std::string id;
    if (e != nullptr) id = e->persistent_id ? *e->persistent_id : e->its_id.value_or("");
    Seen& same = seen[id];
    const std::size_t before = same.all - same.of_step[step.step];
    ++same.all;
    ++same.of_step[step.step];
    out.push_back(before == 0 ? std::move(id) : id + "~" + std::to_string(before + 1));
  }
  return out;
}

}  // namespace capstan::model

#include "planner/proof/verify/touches/measured.h"

#include <set>
#include <utility>

#include "planner/model/nouns/all.h"

namespace capstan::verify {

// Without recursion.
std::map<model::AnyRef, std::vector<model::AnyRef>> touches_before(const model::Plan& plan) {
  std::map<model::AnyRef, std::vector<model::AnyRef>> out;
  const model::Model& m = plan.model;
  const auto* project = m.get<model::Project>(plan.project);
  if (project == nullptr) return out;
  std::set<model::AnyRef> steps, seen;
  for (const auto& s : plan.steps) steps.insert(s.step);
  std::vector<model::AnyRef> waiting, open{project->main_workplan};
  while (!open.empty()) {
    const model::AnyRef r = open.back();
    open.pop_back();
    if (const auto* plan_of = m.get<model::Workplan>(r)) {
      if (!seen.insert(r).second) continue;
      const auto& inner = plan_of->its_elements.items;
      for (auto e = inner.rbegin(); e != inner.rend(); ++e) open.push_back(*e);
    } else if (const auto* touch = m.get<model::WorkpieceProbing>(r)) {
      if (touch->enabled.value_or(true)) waiting.push_back(r);
    } else if (!waiting.empty() && steps.contains(r)) {
      out[r] = std::exchange(waiting, {});
    }
  }
  if (!waiting.empty()) out[model::AnyRef{}] = std::move(waiting);
  return out;
}

}  // namespace capstan::verify

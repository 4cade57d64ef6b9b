#include "planner/model/plan/order/workplan_order.h"

#include <algorithm>
#include <map>
#include <numeric>
#include <set>
#include <utility>
#include <vector>

#include "planner/model/nouns/all.h"

// The workplan is walked in the order of execution, each workplan once, as planning walks it: the k-th place
// of a workingstep is that of the k-th entry of the list that names it.

namespace capstan::model {
namespace {

struct Place {
  std::size_t number = 0;
  Ref<Setup> setup;
};
using Places = std::map<AnyRef, std::vector<Place>>;

Places places_in(const Model& m, AnyRef root) {
  struct Item {
    AnyRef at;
    Ref<Setup> setup;
  };
  Places out;
  std::set<AnyRef> entered;
  std::size_t number = 0;
  std::vector<Item> pending = {{root, {}}};
  while (!pending.empty()) {
    const Item item = pending.back();
    pending.pop_back();
    const auto inner = [&](const auto& list, Ref<Setup> setup) {
      for (std::size_t i = list.size(); i-- > 0;) pending.push_back({list[i], setup});
    };
    if (m.holds<ProgramStructure>(item.at) && !entered.insert(item.at).second) continue;
    if (const auto* w = m.get<Workplan>(item.at)) {
      inner(w->its_elements, w->its_setup.set() ? w->its_setup : item.setup);
    } else if (const auto* p = m.get<Parallel>(item.at)) {
      inner(p->branches, item.setup);
    } else if (const auto* n = m.get<NonSequential>(item.at)) {
      inner(n->its_elements, item.setup);
    } else if (const auto* s = m.get<Selective>(item.at)) {
      inner(s->its_elements, item.setup);
    } else if (item.at.set()) {
      out[item.at].push_back({number++, item.setup});
    }
  }
  return out;
}

}  // namespace

std::string follow_workplan(Plan& plan) {
  const auto* project = plan.model.get<Project>(plan.project);
  if (project == nullptr || !plan.model.holds<Workplan>(project->main_workplan)) return {};
  const Places places = places_in(plan.model, project->main_workplan);
  std::map<AnyRef, std::size_t> seen;
  std::vector<std::size_t> number;
  std::string parted;
  for (StepResult& s : plan.steps) {
    const auto it = places.find(s.step);
    const std::size_t k = seen[s.step]++;
    if (it == places.end() || k >= it->second.size()) {
      number.push_back(number.empty() ? 0 : number.back());
      continue;
    }
    const Place& place = it->second[k];
    number.push_back(place.number);
    if (s.setup < plan.setups.size() && plan.setups[s.setup].setup == place.setup) continue;
    const auto in = std::find_if(plan.setups.begin(), plan.setups.end(),
                                 [&](const SetupResult& r) { return r.setup == place.setup; });
    if (in == plan.setups.end()) continue;  // said where the set-ups are read
    const auto now = static_cast<std::size_t>(in - plan.setups.begin());
    if (parted.empty())
      parted = "step '" + step_id(plan, s) + "' is in set-up " + std::to_string(s.setup + 1) +
               " by the list of steps, and in set-up " + std::to_string(now + 1) + " by its workplan";
    s.setup = now;
  }
  std::string out;
  const auto broken = std::is_sorted_until(number.begin(), number.end());
  if (broken != number.end()) {
    const auto i = static_cast<std::size_t>(broken - number.begin());
    out = "step '" + step_id(plan, plan.steps[i - 1]) + "' comes before '" + step_id(plan, plan.steps[i]) +
          "' in the list of steps, and behind it in the workplan";
    std::vector<std::size_t> order(number.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t a, std::size_t b) { return number[a] < number[b]; });
    std::vector<StepResult> steps;
    for (const std::size_t k : order) steps.push_back(std::move(plan.steps[k]));
    plan.steps = std::move(steps);
  }
  if (!parted.empty()) out += (out.empty() ? "" : "; ") + parted;
  return out;
}

}  // namespace capstan::model

#include "planner/model/plan/edit/held.h"

#include <algorithm>
#include <vector>

#include "planner/model/nouns/all.h"
#include "planner/model/plan/edit/restrictions.h"
#include "planner/model/plan/order/step_ids.h"

namespace capstan::model {

std::string edits_of_step(const Plan& plan, AnyRef step) {
  const auto* ws = plan.model.get<MachiningWorkingstep>(step);
  const auto* op = ws == nullptr ? nullptr : plan.model.get<MachiningOperation>(ws->its_operation);
  if (op == nullptr) return {};
  const AnyRef operation = ws->its_operation, technology = op->its_technology;
  std::vector<std::string> said;
  for (const DecisionKey& key :
       {DecisionKey{operation, "its_tool"}, DecisionKey{operation, "axial_cutting_depth"},
        DecisionKey{technology, "spindle"}, DecisionKey{technology, "feedrate"}}) {
    const auto* d = key.object.set() ? plan.ledger.find(key.object, key.attribute) : nullptr;
    if (d == nullptr || !d->pinned) continue;
    const Reason& why = plan.ledger.reason(d->reason);
    if (why.id == kByEdit && std::find(said.begin(), said.end(), why.text) == said.end())
      said.push_back(why.text);
  }
  std::string out;
  for (const std::string& s : said) out += (out.empty() ? "" : "; ") + s;
  return out;
}

std::map<std::string, std::string> held_steps(const Plan& plan) {
  std::map<std::string, std::string> out;
  const std::vector<std::string> ids = step_ids(plan);
  for (std::size_t i = 0; i < ids.size(); ++i) {
    if (auto words = edits_of_step(plan, plan.steps[i].step); !words.empty()) out.emplace(ids[i], words);
  }
  return out;
}

void name_edits(const std::map<std::string, std::string>& held, Finding& f) {
  const auto at = held.find(f.step);
  if (f.severity != Severity::kNote && at != held.end()) f.message += "; held by " + at->second;
}

}  // namespace capstan::model

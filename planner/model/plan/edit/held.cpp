#include "planner/model/plan/edit/held.h"

#include <algorithm>
#include <vector>

#include "planner/model/nouns/all.h"
#include "planner/model/plan/edit/restrictions.h"

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

}  // namespace capstan::model

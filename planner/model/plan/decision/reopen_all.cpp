#include "planner/model/plan/decision/reopen_all.h"

#include <map>
#include <set>
#include <utility>

namespace capstan::model {

void reopen_all(Ledger& ledger, const std::vector<DecisionKey>& keys) {
  std::map<DecisionKey, std::vector<DecisionKey>> dependents;
  for (const auto& [key, decision] : ledger.entries())
    for (const DecisionKey& on : decision.depends_on) dependents[on].push_back(key);
  std::set<DecisionKey> opened;
  std::vector<DecisionKey> pending = keys;
  while (!pending.empty()) {
    const DecisionKey at = std::move(pending.back());
    pending.pop_back();
    Decision* entry = ledger.find(at.object, at.attribute);
    if ((entry != nullptr && entry->pinned) || !opened.insert(at).second) continue;
    if (entry == nullptr) {
      Decision open;
      open.state = DecisionState::kOpen;
      ledger.set(at, std::move(open));
    } else {
      entry->state = DecisionState::kOpen;
    }
    if (const auto on = dependents.find(at); on != dependents.end())
      pending.insert(pending.end(), on->second.begin(), on->second.end());
  }
}

}  // namespace capstan::model

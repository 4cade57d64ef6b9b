#include "planner/model/plan/decision/fresh_edits.h"

// A decision that was read has the hash of its value (Decision::value_hash), and writing computes it anew: 0
// is left by `take_edits` only.

namespace capstan::model {

std::vector<DecisionKey> fresh_edits(const Ledger& ledger) {
  std::vector<DecisionKey> out;
  for (const auto& [key, d] : ledger.entries()) {
    if (d.value_hash == 0 && ledger.reason(d.reason).id == kEditedReason) out.push_back(key);
  }
  return out;
}

void settle_edits(const Model& model, Ledger& ledger) {
  for (const DecisionKey& key : fresh_edits(ledger))
    ledger.find(key.object, key.attribute)->value_hash = hash_attribute(model, key.object, key.attribute);
}

}  // namespace capstan::model

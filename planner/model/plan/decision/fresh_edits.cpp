#include "planner/model/plan/decision/fresh_edits.h"

#include "planner/model/plan/decision/has_reason.h"

// A decision that was read has the hash of its value (Decision::value_hash), and writing computes it anew,
// but for the 0 that `take_edits` leaves.

namespace capstan::model {

bool is_fresh_edit(const Ledger& ledger, const Decision& d) {
  return d.value_hash == 0 && ledger.reason(d.reason).id == kEditedReason;
}

std::uint64_t written_hash(const Model& written, const Ledger& ledger, const DecisionKey& key,
                           const Decision& d) {
  return is_fresh_edit(ledger, d) ? 0 : hash_attribute(written, key.object, key.attribute);
}

std::vector<DecisionKey> fresh_edits(const Ledger& ledger) {
  std::vector<DecisionKey> out;
  if (!has_reason(ledger, kEditedReason)) return out;
  for (const auto& [key, d] : ledger.entries()) {
    if (is_fresh_edit(ledger, d)) out.push_back(key);
  }
  return out;
}

void settle_edits(const Model& model, Ledger& ledger) {
  for (const DecisionKey& key : fresh_edits(ledger))
    ledger.find(key.object, key.attribute)->value_hash = hash_attribute(model, key.object, key.attribute);
}

}  // namespace capstan::model

#pragma once

#include <string_view>
#include <vector>

#include "planner/model/plan/decision/decision.h"

namespace capstan::model {

class Model;

/// The reason's id of a value that somebody edited in the plan's file.
inline constexpr std::string_view kEditedReason = "given.edited";

/// Whether `take_edits` (edited.h) found that somebody changed the value since the plan was bound. A plan
/// that is written without being bound, as `capstan convert` does, keeps it so: its hash is written as 0.
[[nodiscard]] bool is_fresh_edit(const Ledger& ledger, const Decision& d);
/// The hash of a decision's value as a file keeps it; 0 for a fresh edit.
[[nodiscard]] std::uint64_t written_hash(const Model& written, const Ledger& ledger, const DecisionKey& key,
                                         const Decision& d);
/// All fresh edits, in the order of the keys; none after `settle_edits`.
[[nodiscard]] std::vector<DecisionKey> fresh_edits(const Ledger& ledger);
/// From now on the plan is bound with its edits: none of them is fresh any more.
void settle_edits(const Model& model, Ledger& ledger);

}  // namespace capstan::model

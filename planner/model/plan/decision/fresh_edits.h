#pragma once

#include <string_view>
#include <vector>

#include "planner/model/plan/decision/decision.h"

namespace capstan::model {

class Model;

/// The reason's id of a value that somebody edited in the plan's file.
inline constexpr std::string_view kEditedReason = "given.edited";

/// What `take_edits` (edited.h) found in the file that the plan was read from, in the order of the keys;
/// nothing of earlier files, nor after `settle_edits`.
[[nodiscard]] std::vector<DecisionKey> fresh_edits(const Ledger& ledger);
/// From now on the plan is bound with its edits: none of them is fresh any more.
void settle_edits(const Model& model, Ledger& ledger);

}  // namespace capstan::model

#pragma once

#include <algorithm>
#include <string_view>

#include "planner/model/plan/decision/decision.h"

namespace capstan::model {

/// Whether a decision of the ledger may have a reason of this id. Reasons are few and lie together: asked
/// before all decisions of a large plan are walked through in vain.
[[nodiscard]] inline bool has_reason(const Ledger& ledger, std::string_view id) {
  return std::any_of(ledger.reasons().begin(), ledger.reasons().end(),
                     [&](const Reason& why) { return why.id == id; });
}

}  // namespace capstan::model

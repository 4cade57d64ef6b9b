#pragma once

#include <string_view>
#include <vector>

#include "casebase/casebase.h"
#include "casebase/recall/advice.h"

namespace capstan::casebase {

/// The nearest cases of a base as evidence: within `kPrecedentDistance`, and as many as it takes to see
/// kNearAsked cuts, each counted once. Cases of another strategy than the one named are left out; an empty
/// name, and a case without one, is any. Empty for a question that cannot be (`fault_of`).
[[nodiscard]] std::vector<Evidence> evidence_near(const CaseBase& base, const Question& question,
                                                  std::string_view strategy);

}  // namespace capstan::casebase

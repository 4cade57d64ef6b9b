#pragma once

#include <vector>

#include "casebase/casebase.h"
#include "casebase/recall/advice.h"

namespace capstan::casebase {

/// The nearest cases of a base as evidence: within `kPrecedentDistance`, and as many as it takes to see
/// kNearAsked cuts, each counted once. Fails CASE-INVALID on a question that cannot be (`fault_of`).
[[nodiscard]] Result<std::vector<Evidence>> evidence_near(const CaseBase& base, const Question& question);

}  // namespace capstan::casebase

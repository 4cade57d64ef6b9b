#pragma once

#include <vector>

#include "casebase/casebase.h"
#include "casebase/recall/advice.h"

namespace capstan::casebase {

/// The nearest cases of a base: within `kPrecedentDistance`, and as many as it takes to see
/// kNearAsked cuts, each counted once. Fails CASE-INVALID on a question that cannot be (`fault_of`).
[[nodiscard]] Result<std::vector<Neighbour>> cases_near(const CaseBase& base, const Question& question);
/// Each of them as evidence, in the same order.
[[nodiscard]] std::vector<Evidence> evidence_of(const std::vector<Neighbour>& near, const Question& question);
/// Both in one.
[[nodiscard]] Result<std::vector<Evidence>> evidence_near(const CaseBase& base, const Question& question);

}  // namespace capstan::casebase

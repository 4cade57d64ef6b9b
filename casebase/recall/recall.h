#pragma once

#include <vector>

#include "casebase/casebase.h"
#include "casebase/recall/advice.h"

namespace capstan::casebase {

/// The nearest cases of a base, and what stands against what they say: cases as near that are not what was
/// stored, and whether rows of the base are gone (`CaseBase::whole`).
struct NearCases {
  std::vector<Neighbour> found;
  std::vector<CaseBase::Lost> lost;
  bool whole = true;
};

/// The nearest cases of a base: within `kPrecedentDistance`, and as many as it takes to see
/// kNearAsked cuts, each counted once. Fails CASE-INVALID on a question that cannot be (`fault_of`).
[[nodiscard]] Result<NearCases> cases_near(const CaseBase& base, const Question& question);
/// Each of them as evidence, in the same order. Where something is lost none of it raises
/// (`Evidence::raises`), and the lost ones whose head says that they failed follow, with nothing known of
/// their cut (`Evidence::lost`).
[[nodiscard]] std::vector<Evidence> evidence_of(const NearCases& near, const Question& question);
[[nodiscard]] std::vector<Evidence> evidence_of(const std::vector<Neighbour>& near, const Question& question);
/// Both in one.
[[nodiscard]] Result<std::vector<Evidence>> evidence_near(const CaseBase& base, const Question& question);

}  // namespace capstan::casebase

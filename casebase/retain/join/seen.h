#pragma once

#include <optional>
#include <span>

#include "casebase/casebase.h"

/// Logs that come a second time, by another name or for another part.
namespace capstan::casebase::retain {

/// A note (CASE-SAME) of cases that are new to the base and have the readings and the time of others: of those
/// that it holds, or of these. What was measured of the part does not count, as it may come later. Nothing
/// where none has. By the same figures `recall/evidence.h` takes two cases for one cut.
[[nodiscard]] std::optional<Diagnostic> seen_before(const CaseBase& base, std::span<const Case> cases);

}  // namespace capstan::casebase::retain

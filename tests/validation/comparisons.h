#pragma once

#include <string>
#include <vector>

#include "tests/validation/report.h"

namespace capstan::validation {

/// Everything that docs/validation.md shows, in its order. `corpus` is the folder of real files, empty where
/// it is absent: what needs it is skipped then, and says so. Of a sample the summary is missing, and of those
/// that plan many parts all but some lines.
[[nodiscard]] std::vector<Comparison> all_comparisons(const std::string& corpus, Extent extent);

}  // namespace capstan::validation

#pragma once

#include <string>
#include <vector>

#include "tests/validation/report.h"

namespace capstan::validation {

/// Everything that docs/validation.md shows, in its order. `corpus` is the folder of real files, empty where
/// it is absent: what needs it is skipped then, and says so.
[[nodiscard]] std::vector<Comparison> all_comparisons(const std::string& corpus);

}  // namespace capstan::validation

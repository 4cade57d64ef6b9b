#pragma once

#include <string>
#include <vector>

#include "planner/ground/base/result.h"
#include "tooling/library/records/records.h"

namespace capstan::tooling {

/// Impossible values of a library, as stated and before any completion: a diameter of zero, flutes or a reach
/// longer than the tool, a corner radius above half the diameter, numbers that are not finite or negative,
/// holder segments without height, ids given twice, references to missing records.
/// Codes TOOL-VALUE, TOOL-ID, TOOL-RECORD; `path` names the tool.
[[nodiscard]] std::vector<Diagnostic> check_library(const ToolLibrary& library, const std::string& file);

}  // namespace capstan::tooling

#pragma once

#include <string>
#include <vector>

#include "planner/ground/base/result.h"
#include "tooling/library/records/records.h"

namespace capstan::tooling {

/// What a library says that cannot be, as it is stated and before anything is completed: a diameter of zero,
/// flutes or a reach longer than the tool, a corner radius above half the diameter, numbers that are not
/// finite or negative, holder segments without height, ids given twice, records that name no other.
/// Codes TOOL-VALUE, TOOL-ID, TOOL-RECORD; `path` names the tool.
[[nodiscard]] std::vector<Diagnostic> check_library(const ToolLibrary& library, const std::string& file);

}  // namespace capstan::tooling

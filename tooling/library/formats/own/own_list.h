#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "planner/ground/base/job.h"
#include "planner/ground/base/result.h"
#include "planner/model/plan/cutter/cutter.h"

namespace capstan::tooling {

/// Our own list (YAML or JSON, tooling/data/README.md) as cutters, completed from the generic series.
/// Fails  DATA-*, TOOL-VALUE, TOOL-ID, TOOL-NUMBER, with file and line.
[[nodiscard]] Result<std::vector<model::Cutter>> read_own_list(std::string_view text, const std::string& file,
                                                               Job& job);
[[nodiscard]] bool looks_like_own_list(std::string_view text);

}  // namespace capstan::tooling

#pragma once

#include <string>
#include <vector>

#include "planner/ground/base/result.h"
#include "planner/model/plan/cutter/cutter_faults.h"

namespace capstan::tooling {

using model::faults_of;
/// Why a size, though it exists, is more likely in another unit; empty: it is not.
[[nodiscard]] std::string unlikely_of(const model::Cutter& c);

/// Faults of a whole library: those of each cutter (TOOL-VALUE), ids given twice (TOOL-ID) and tool numbers
/// given twice (TOOL-NUMBER). `lines`: of each cutter in the file, or empty.
[[nodiscard]] std::vector<Diagnostic> check_cutters(const std::vector<model::Cutter>& cutters,
                                                    const std::string& file,
                                                    const std::vector<std::uint64_t>& lines);

}  // namespace capstan::tooling

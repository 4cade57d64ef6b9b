#pragma once

#include <string>
#include <vector>

#include "planner/base/result.h"
#include "planner/model/cutter.h"

namespace capstan::tooling {

/// What is wrong with one cutter, each as a sentence with its numbers; empty when nothing is.
///
/// Lengths and counts finite and not negative, diameter above zero, corner radius at most D/2, flutes not
/// longer than the tool sticks out, the stick-out not longer than gage line to tip, teeth 1 to 60, angles in
/// range, a pitch for taps.
[[nodiscard]] std::vector<std::string> faults_of(const model::Cutter& c);
/// A size that exists but is more likely of another unit; empty: none.
[[nodiscard]] std::string unlikely_of(const model::Cutter& c);

/// Faults of a whole library: those of each cutter (TOOL-VALUE), ids given twice (TOOL-ID) and tool numbers
/// given twice (TOOL-NUMBER). `lines`: of each cutter in the file, or empty.
[[nodiscard]] std::vector<Diagnostic> check_cutters(const std::vector<model::Cutter>& cutters,
                                                    const std::string& file,
                                                    const std::vector<std::uint64_t>& lines);

}  // namespace capstan::tooling

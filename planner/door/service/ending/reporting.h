#pragma once

#include <string>
#include <vector>

#include "planner/door/service/planning.h"

namespace capstan::service {

/// The report of a plan that was judged, of the workingsteps bound now where only some were: with the
/// verdict, findings and decisions, and the program among the outputs, if it is given. Needs the outputs'
/// bytes; errors in reading are among the job's diagnostics. Files that the request names are read again for
/// their hashes.
[[nodiscard]] std::string report_of(const Request& request, const Planned& planned, const Verdict& verdict,
                                    const std::vector<Output>& outputs, const Job& job);
/// The same of a plan that nobody judged here.
[[nodiscard]] std::string report_of(const model::Plan& plan);

}  // namespace capstan::service

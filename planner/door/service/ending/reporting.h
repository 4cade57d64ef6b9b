#pragma once

#include <string>
#include <vector>

#include "planner/door/service/planning.h"

namespace capstan::service {

/// The report of a plan that was judged: with the verdict, findings and decisions, and the program among the
/// outputs, if it is given. Needs the outputs' bytes.
[[nodiscard]] std::string report_of(const Planned& planned, const Verdict& verdict,
                                    const std::vector<Output>& outputs);
/// The same of a plan that nobody judged here.
[[nodiscard]] std::string report_of(const model::Plan& plan);

}  // namespace capstan::service

#pragma once

#include <string>
#include <vector>

#include "planner/ground/base/result.h"
#include "planner/making/optimise/solver/backend.h"

namespace capstan::optimise {

/// `solve_with_ipopt` (backend.h) by the library of this name, as the system's loader finds it, or path.
/// Fails  OPT-BACKEND-ABSENT the library is not there, or this build has no Ipopt; OPT-IPOPT it refuses
///        problem or options, or ends before it asks for a point.
[[nodiscard]] Result<std::vector<double>> solve_with_ipopt_of(const std::string& library,
                                                              Evaluator& evaluator, const Attempt& attempt);

}  // namespace capstan::optimise

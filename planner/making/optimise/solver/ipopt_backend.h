#pragma once

#include "planner/making/optimise/solver/backend.h"

namespace capstan::optimise {

/// Ipopt 3.11 with a limited-memory Hessian, or OPT-BACKEND-ABSENT when built without it. Its linear
/// solver is not thread-safe: runs wait for each other on a mutex. No option file is read.
[[nodiscard]] Result<std::vector<double>> solve_with_ipopt(Evaluator& evaluator, const Attempt& attempt);

}  // namespace capstan::optimise

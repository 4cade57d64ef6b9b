#pragma once

#include "planner/making/optimise/solver/solver.h"

namespace capstan::optimise {

/// Every solver library that was built: for programs that may link them all.
[[nodiscard]] Backends every_backend();

}  // namespace capstan::optimise

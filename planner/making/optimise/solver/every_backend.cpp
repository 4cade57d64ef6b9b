#include "planner/making/optimise/solver/every_backend.h"

namespace capstan::optimise {

#define CAPSTAN_SOLVER(Name, word, function) \
  [[nodiscard]] Result<std::vector<double>> function(Evaluator& evaluator, const Attempt& attempt);
#include "planner/making/optimise/solver/solvers.inc"
#undef CAPSTAN_SOLVER

Backends every_backend() {
  Backends out;
#define CAPSTAN_SOLVER(Name, word, function) out.word = &function;
#include "planner/making/optimise/solver/solvers.inc"
#undef CAPSTAN_SOLVER
  return out;
}

}  // namespace capstan::optimise

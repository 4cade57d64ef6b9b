#include "planner/making/optimise/solver/solvers.h"

namespace capstan::optimise {

Backends all_backends() {
  Backends all;
#define CAPSTAN_SOLVER(noun, word) all[Solver::k##noun] = &solve_with_##word;
#include "planner/making/optimise/solver/solvers.inc"
#undef CAPSTAN_SOLVER
  return all;
}

}  // namespace capstan::optimise

#pragma once

#include <cstdint>
#include <vector>

#include "planner/ground/base/result.h"
#include "planner/making/optimise/solver/evaluator.h"

/// The interface that each solver library implements. Callers use solver.h.
namespace capstan::optimise {

enum class Algorithm : std::uint8_t {
  kSlsqp,        ///< sequential quadratic programming: first choice, smooth problems
  kAuglagLbfgs,  ///< augmented Lagrangian over L-BFGS: slower, surer
  kCobyla,       ///< without slopes
  kIsres,        ///< evolution strategy, thousands of points: a referee for tests
};

/// One run from one start, in the unit box of the evaluator.
struct Attempt {
  Algorithm algorithm = Algorithm::kSlsqp;
  std::vector<double> start;
  double relative_tolerance = 1e-10;
  std::uint32_t max_evaluations = 0;
};

/// Runs and gives the point it ended at; feasibility and optimality are judged by the caller.
///
/// Must      evaluate only inside the box; stop when evaluator.exhausted(); never let an exception of its
///           library out; rethrow, after its library has returned, what the evaluator threw.
using Backend = Result<std::vector<double>> (*)(Evaluator& evaluator, const Attempt& attempt);

/// solve_with_nlopt (NLopt 2.7), solve_with_ipopt …: each answers OPT-BACKEND-ABSENT when built without its
/// library, or where that is opened when it is needed and is not there; OPT-IPOPT where Ipopt is there and
/// does not begin.
#define CAPSTAN_SOLVER(noun, word) \
  [[nodiscard]] Result<std::vector<double>> solve_with_##word(Evaluator& evaluator, const Attempt& attempt);
#include "planner/making/optimise/solver/solvers.inc"
#undef CAPSTAN_SOLVER

}  // namespace capstan::optimise

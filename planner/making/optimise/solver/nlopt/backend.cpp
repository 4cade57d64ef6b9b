#include <algorithm>
#include <cmath>
#include <exception>
#include <limits>
#include <nlopt.hpp>
#include <string>

#include "planner/making/optimise/solver/backend.h"
#include "planner/making/optimise/solver/spent_budget.h"

namespace capstan::optimise {
namespace {

constexpr unsigned long kSeed = 20240501;      // ISRES only; the same run every time
constexpr double kConstraintTolerance = 1e-9;  // well inside what the caller checks
constexpr double kStepTolerance = 1e-10;       // of the unit box

/// Between NLopt and the evaluator. NLopt replaces what a callback throws by a stop of its own, so the
/// exception is kept here and rethrown outside.
struct Bridge {
  Evaluator& evaluator;
  std::exception_ptr thrown = {};

  const Evaluation* at(unsigned n, const double* u, bool want_slopes) {
    const std::span<const double> point(u, n);
    if (evaluator.exhausted()) throw nlopt::forced_stop();
    try {
      const Evaluation& e = evaluator.at(point, want_slopes);
      return evaluator.finite() ? &e : nullptr;
    } catch (...) {
      thrown = std::current_exception();
      throw nlopt::forced_stop();
    }
  }
};

double objective(unsigned n, const double* u, double* gradient, void* data) {
  const Evaluation* e = static_cast<Bridge*>(data)->at(n, u, gradient != nullptr);
  if (e == nullptr) {  // not a number: a wall, from which the line search steps back
    if (gradient != nullptr) std::fill(gradient, gradient + n, 0.0);
    return std::numeric_limits<double>::max();
  }
  if (gradient != nullptr) std::copy(e->gradient.begin(), e->gradient.end(), gradient);
  return e->objective;
}

void constraints(unsigned m, double* result, unsigned n, const double* u, double* jacobian, void* data) {
  const Evaluation* e = static_cast<Bridge*>(data)->at(n, u, jacobian != nullptr);
  if (e == nullptr) {
    std::fill(result, result + m, 1e6);
    if (jacobian != nullptr) std::fill(jacobian, jacobian + std::size_t{m} * n, 0.0);
    return;
  }
  std::copy(e->constraints.begin(), e->constraints.end(), result);
  if (jacobian != nullptr) std::copy(e->jacobian.begin(), e->jacobian.end(), jacobian);
}

nlopt::algorithm code(Algorithm a) {
  switch (a) {
    case Algorithm::kSlsqp:
      return nlopt::LD_SLSQP;
    case Algorithm::kAuglagLbfgs:
      return nlopt::AUGLAG;
    case Algorithm::kCobyla:
      return nlopt::LN_COBYLA;
    case Algorithm::kIsres:
      return nlopt::GN_ISRES;
  }
  return nlopt::LD_SLSQP;
}

void set_stops(nlopt::opt& opt, const Attempt& attempt) {
  opt.set_ftol_rel(attempt.relative_tolerance);
  opt.set_xtol_abs(kStepTolerance);
  // NLopt counts calls, the evaluator points; the evaluator's budget decides, this is a second guard.
  opt.set_maxeval(static_cast<int>(std::min<std::uint32_t>(attempt.max_evaluations, 1u << 30)));
}

}  // namespace

Result<std::vector<double>> solve_with_nlopt(Evaluator& evaluator, const Attempt& attempt) {
  const auto n = static_cast<unsigned>(evaluator.variables());
  Bridge bridge{evaluator};
  std::vector<double> u = attempt.start;
  try {
    nlopt::opt opt(code(attempt.algorithm), n);
    opt.set_lower_bounds(0.0);
    opt.set_upper_bounds(1.0);
    opt.set_min_objective(objective, &bridge);
    if (evaluator.constraints() != 0) {
      opt.add_inequality_mconstraint(constraints, &bridge,
                                     std::vector<double>(evaluator.constraints(), kConstraintTolerance));
    }
    set_stops(opt, attempt);
    if (attempt.algorithm == Algorithm::kAuglagLbfgs) {
      nlopt::opt inner(nlopt::LD_LBFGS, n);
      set_stops(inner, attempt);
      opt.set_local_optimizer(inner);
    }
    if (attempt.algorithm == Algorithm::kCobyla) opt.set_initial_step(0.1);
    if (attempt.algorithm == Algorithm::kIsres) nlopt::srand(kSeed);
    double value = 0.0;
    if (opt.optimize(u, value) == nlopt::MAXEVAL_REACHED) tell_budget_spent();
  } catch (const std::exception&) {
    // roundoff_limited, forced_stop (our budget, or what the model threw), NLOPT_FAILURE: NLopt leaves
    // the point it reached in u, usable or not; the caller measures it.
  }
  if (bridge.thrown) std::rethrow_exception(bridge.thrown);
  return u;
}

}  // namespace capstan::optimise

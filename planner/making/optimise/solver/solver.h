#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "planner/ground/base/job.h"
#include "planner/ground/base/result.h"
#include "planner/making/optimise/problem/problem.h"
#include "planner/making/optimise/solver/backend.h"

/// The fence around the solvers: a checked problem in, a checked solution out, whichever solver ran.
namespace capstan::optimise {

/// Solver libraries; their rows are in solvers.inc.
enum class Solver : std::uint8_t {
#define CAPSTAN_SOLVER(Name, word, function) k##Name,
#include "planner/making/optimise/solver/solvers.inc"
#undef CAPSTAN_SOLVER
};
/// "nlopt": as options call it.
[[nodiscard]] const char* to_text(Solver solver);
[[nodiscard]] std::span<const Solver> solvers();

/// The libraries a program brings. NLopt is part of this room; the others are another target, so that only a
/// program that names them links them:
///
///     #include "planner/making/optimise/solver/every_backend.h"     // and link capstan::optimise_ipopt
///     options.backends = optimise::every_backend();
///
/// A null pointer is a backend that is absent.
struct Backends {
  Backends() : nlopt(&solve_with_nlopt) {}
#define CAPSTAN_SOLVER(Name, word, function) Backend word = nullptr;
#include "planner/making/optimise/solver/solvers.inc"
#undef CAPSTAN_SOLVER
  [[nodiscard]] Backend of(Solver solver) const;
};

struct Options {
  Solver solver = Solver::kNlopt;
  Algorithm algorithm = Algorithm::kSlsqp;  ///< of NLopt; others have one
  std::uint32_t evaluation_budget = 0;      ///< points in all; 0: the job's budget
  std::uint32_t starts = 8;             ///< the problem's own start, then a fixed low-discrepancy sequence
  double relative_tolerance = 1e-10;    ///< of the objective, where a solver stops
  double feasibility_tolerance = 1e-6;  ///< largest c_i that counts as kept
  bool fall_back = true;                ///< SLSQP, then AUGLAG + L-BFGS, then others that are there
  Backends backends;
};

/// What the search came to. Feasibility and optimality are measured here, not believed.
enum class Outcome : std::uint8_t {
  kOptimal,       ///< feasible, and first-order optimal (kkt_residual <= kOptimalityTolerance)
  kFeasible,      ///< feasible, the best seen; not shown to be optimal
  kInfeasible,    ///< no feasible point from any start by any method; x violates least. Not a proof.
  kLimitReached,  ///< budget, stop or deadline came first; usable when `feasible`
};

[[nodiscard]] const char* to_text(Outcome outcome);

/// A limit that holds the solution back.
struct ActiveLimit {
  std::string name;  ///< of the constraint, or of the variable whose bound it is
  enum class Kind : std::uint8_t { kConstraint, kLowerBound, kUpperBound } kind = Kind::kConstraint;
  double value = 0.0;  ///< c_i, or the bound
  /// Shadow price, >= 0: by how much the objective falls per unit that the limit gives way (a constraint
  /// written as a ratio: per 100 % of its limit; a bound: per unit of the variable). Estimated by
  /// non-negative least squares on the gradients at x.
  double multiplier = 0.0;
};

struct Solution {
  Outcome outcome = Outcome::kInfeasible;
  bool feasible = false;
  std::vector<double> x;  ///< within the bounds, always
  double objective = 0.0;
  double max_violation = 0.0;       ///< largest c_i above zero, else 0
  double kkt_residual = 0.0;        ///< |grad f + J^T lambda| / max(1, |grad f|), unit box, largest part
  std::vector<ActiveLimit> active;  ///< constraints first, in the problem's order; then bounds
  std::uint32_t evaluations = 0;
  std::string method;  ///< that found x: "start", "slsqp", "auglag+lbfgs", "cobyla", "isres", "ipopt"
};

inline constexpr double kOptimalityTolerance = 1e-4;

/// Minimises from several fixed starts and keeps the best feasible end; falls back when none is optimal.
///
/// Determinism   same problem, same options, same budget: same bytes. Starts are fixed; budgets count
///               points, not time. Only a stop request or a deadline on `job` may cut it short.
/// Fails         OPT-PROBLEM (see validate); OPT-BACKEND-ABSENT when the asked solver was not built or not
///               brought; OPT-MODEL when the model is not finite at every start.
/// Throws        whatever the model throws, unchanged.
[[nodiscard]] Result<Solution> solve(const Problem& problem, const Options& options, Job& job);

}  // namespace capstan::optimise

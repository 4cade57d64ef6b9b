#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "planner/ground/base/job.h"
#include "planner/ground/base/result.h"
#include "planner/making/optimise/problem/problem.h"
#include "planner/making/optimise/solver/backend.h"
#include "planner/making/optimise/solver/solvers.h"

/// The fence around the solvers: a checked problem in, a checked solution out, whichever solver ran.
namespace capstan::optimise {

struct Options {
  Solver solver = Solver::kNlopt;
  Algorithm algorithm = Algorithm::kSlsqp;  ///< of NLopt; Ipopt has one
  std::uint32_t evaluation_budget = 0;      ///< points in all; 0: the job's budget
  std::uint32_t starts = 8;             ///< the problem's own start, then a fixed low-discrepancy sequence
  double relative_tolerance = 1e-10;    ///< of the objective, where a solver stops
  double feasibility_tolerance = 1e-6;  ///< largest c_i that counts as kept
  bool fall_back = true;  ///< SLSQP, then AUGLAG + L-BFGS, then the other solvers that are there
  Backends backends;
};

/// Result of the search. Feasibility and optimality are measured here; the backend's own claim does not
/// count.
enum class Outcome : std::uint8_t {
  kOptimal,       ///< feasible, and first-order optimal (FirstOrder::residual <= kOptimalityTolerance)
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
  std::vector<ActiveLimit> active;  ///< constraints first, in the problem's order; then bounds
  std::uint32_t evaluations = 0;
  std::string method;  ///< that found x: "start", "slsqp", "auglag+lbfgs", "cobyla", "isres", "ipopt"
};

inline constexpr double kOptimalityTolerance = 1e-4;

/// Minimises from several fixed starts and keeps the best feasible result; tries the next method if no result
/// is optimal.
///
/// Determinism   same problem, same options, same budget: same bytes. Starts are fixed; budgets count
///               points, not time. Only a stop request or a deadline on `job` may cut it short.
/// Fails         OPT-PROBLEM (see validate); OPT-BACKEND-ABSENT when the asked solver was not built or not
///               brought, or its library is not there; OPT-IPOPT when Ipopt does not begin; OPT-MODEL when
///               the model is not finite at every start.
/// Throws        whatever the model throws, unchanged.
[[nodiscard]] Result<Solution> solve(const Problem& problem, const Options& options, Job& job);

}  // namespace capstan::optimise

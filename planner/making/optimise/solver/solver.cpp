#include "planner/making/optimise/solver/solver.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstdint>
#include <optional>
#include <utility>

#include "planner/making/optimise/solver/multipliers.h"
#include "planner/making/optimise/solver/spent_budget.h"

namespace capstan::optimise {
namespace {

thread_local SpentBudgetScope* told = nullptr;
/// How often threads without a scope were to tell one.
std::atomic<std::uint64_t> told_elsewhere{0};

/// Close enough to a limit to be held by it, in constraint ratios and parts of a variable's range.
constexpr double kActiveTolerance = 1e-5;

/// One method to try, in the order of the fallback.
struct Stage {
  Backend backend = nullptr;
  Algorithm algorithm = Algorithm::kSlsqp;
  const char* name = "";
};

const char* name_of(Algorithm a) {
  switch (a) {
    case Algorithm::kSlsqp:
      return "slsqp";
    case Algorithm::kAuglagLbfgs:
      return "auglag+lbfgs";
    case Algorithm::kCobyla:
      return "cobyla";
    case Algorithm::kIsres:
      return "isres";
  }
  return "";
}

std::vector<Stage> stages_of(const Options& options) {
  const Backends& b = options.backends;
  const Backend nlopt = b[Solver::kNlopt];
  std::vector<Stage> stages;
  if (options.solver == Solver::kNlopt) {
    stages.push_back({nlopt, options.algorithm, name_of(options.algorithm)});
  } else {
    stages.push_back({b[options.solver], Algorithm::kSlsqp, word_of(options.solver)});
  }
  if (!options.fall_back) return stages;
  if (nlopt != nullptr) {
    for (const Algorithm a : {Algorithm::kSlsqp, Algorithm::kAuglagLbfgs}) {
      const bool behind = options.solver == Solver::kNlopt && a == options.algorithm;
      const bool slower = a == Algorithm::kSlsqp && options.algorithm == Algorithm::kAuglagLbfgs;
      if (!behind && !slower) stages.push_back({nlopt, a, name_of(a)});
    }
  }
  for (const auto& [solver, word] : kSolvers) {
    if (solver == Solver::kNlopt || solver == options.solver || b[solver] == nullptr) continue;
    stages.push_back({b[solver], Algorithm::kSlsqp, word});
  }
  return stages;
}

/// Start k: the problem's own, then the additive recurrence of the generalised golden ratio, which fills
/// the box evenly from the first point on (Roberts 2018, "The unreasonable effectiveness of quasirandom
/// sequences"; phi_d is the root of x^(d+1) = x + 1).
std::vector<double> start_point(const Evaluator& evaluator, const Problem& problem, std::uint32_t k) {
  if (k == 0) {
    std::vector<double> x;
    for (const Variable& v : problem.variables) x.push_back(v.start);
    return evaluator.to_u(x);
  }
  const std::size_t d = evaluator.variables();
  double phi = 2.0;
  for (int i = 0; i < 64; ++i) phi = std::pow(1.0 + phi, 1.0 / static_cast<double>(d + 1));
  std::vector<double> u;
  double alpha = 1.0;
  for (std::size_t j = 0; j < d; ++j) {
    alpha /= phi;
    const double t = 0.5 + k * alpha;
    // Off the borders, where slopes may be infinite.
    u.push_back(0.02 + 0.96 * (t - std::floor(t)));
  }
  return u;
}

/// The end of a run, measured.
struct Candidate {
  std::vector<double> u;
  double objective = 0.0;
  double violation = 0.0;
  const char* method = "";
  bool optimal = false;
};

/// Whether a is worth more than b: feasible first, then objective (a hair apart counts as equal, so that
/// rounding does not choose between starts), then violation.
bool better(const Candidate& a, const Candidate& b, double tolerance) {
  const bool fa = a.violation <= tolerance;
  const bool fb = b.violation <= tolerance;
  if (fa != fb) return fa;
  if (!fa) return a.violation < b.violation;
  const double hair = 1e-9 * std::max(1.0, std::abs(b.objective));
  if (std::abs(a.objective - b.objective) <= hair) return a.optimal && !b.optimal;
  return a.objective < b.objective;
}

class Search {
 public:
  Search(const Problem& problem, const Options& options, Job& job)
      : problem_(problem),
        options_(options),
        evaluator_(problem, job, options.feasibility_tolerance),
        budget_(options.evaluation_budget != 0 ? options.evaluation_budget : job.evaluation_budget) {}

  Result<Solution> run() {
    if (evaluator_.variables() == 0) {
      evaluator_.allow_until(1);
      judge({}, "fixed");
      return finish(false);
    }
    // Whatever happens later, the problem's own start is there to fall back on.
    evaluator_.allow_until(1);
    judge(start_point(evaluator_, problem_, 0), "start");
    const std::vector<Stage> stages = stages_of(options_);
    bool cut_short = false;
    for (std::size_t s = 0; s < stages.size(); ++s) {
      if (stages[s].backend == nullptr) {
        return fail(Diagnostic{.code = "OPT-BACKEND-ABSENT",
                               .message = std::string("this program brings no ") + stages[s].name,
                               .hint = "set options.backends, or ask for another solver"});
      }
      const std::uint32_t left = budget_ - std::min(budget_, evaluator_.evaluations());
      // Half of what is left, so that a method that never ends cannot starve the next.
      const std::uint32_t share = s + 1 < stages.size() ? left - left / 2 : left;
      const auto cut = run_stage(stages[s], evaluator_.evaluations() + share);
      if (!cut) {
        if (s > 0 && cut.error().code == "OPT-BACKEND-ABSENT") continue;  // a fallback that is not built
        return fail(cut.error());
      }
      cut_short = *cut;
      spent_ = spent_ || cut_short;
      if (best_ && best_->optimal) break;
      if (evaluator_.exhausted() && evaluator_.evaluations() >= budget_) break;
    }
    return finish(cut_short);
  }

 private:
  /// Whether the budget ended a run or kept a start from running.
  Result<bool> run_stage(const Stage& stage, std::uint32_t until) {
    const std::uint32_t starts = std::max<std::uint32_t>(1, options_.starts);
    bool cut = false;
    for (std::uint32_t k = 0; k < starts; ++k) {
      evaluator_.allow_until(until);
      if (evaluator_.exhausted()) return true;
      const std::uint32_t used = evaluator_.evaluations();
      const std::uint32_t share = std::max<std::uint32_t>(1, (until - used) / (starts - k));
      evaluator_.allow_until(used + share);
      evaluator_.forget_best();
      auto end = stage.backend(evaluator_, Attempt{.algorithm = stage.algorithm,
                                                   .start = start_point(evaluator_, problem_, k),
                                                   .relative_tolerance = options_.relative_tolerance,
                                                   .max_evaluations = share});
      if (!end) return fail(end.error());
      cut = evaluator_.exhausted() || cut;
      // Judging costs a point or two beyond the budget of the search.
      const Evaluator::Best seen = evaluator_.best();
      for (double& t : *end) t = std::isfinite(t) ? std::clamp(t, 0.0, 1.0) : 0.5;
      const bool usable = judge(*end, stage.name);
      if (!usable && seen.known) judge(clamped(seen.u), stage.name);
    }
    return cut;
  }

  static std::vector<double> clamped(std::vector<double> u) {
    for (double& t : u) t = std::clamp(t, 0.0, 1.0);
    return u;
  }

  /// Measures a point and keeps it if it is the best; whether it is feasible.
  bool judge(const std::vector<double>& u, const char* method) {
    const Evaluation& e = evaluator_.at(u, true);
    if (!std::isfinite(e.objective)) return false;
    Candidate c{u, e.objective, max_violation(e), method, false};
    if (!std::isfinite(c.violation)) return false;
    const bool feasible = c.violation <= options_.feasibility_tolerance;
    c.optimal = feasible && evaluator_.finite() &&
                first_order(e, u, kActiveTolerance).residual <= kOptimalityTolerance;
    if (!best_ || better(c, *best_, options_.feasibility_tolerance)) best_ = c;
    return feasible;
  }

  Result<Solution> finish(bool cut_short) {
    const std::uint32_t spent = evaluator_.evaluations();
    if (spent_ || spent >= budget_) tell_budget_spent();
    if (!best_) {
      return fail("OPT-MODEL", "the model gives no finite value at any point that was tried");
    }
    const Evaluation& e = evaluator_.at(best_->u, true);
    Solution s;
    s.x = evaluator_.to_x(best_->u);
    s.objective = e.objective;
    s.max_violation = best_->violation;
    s.feasible = best_->violation <= options_.feasibility_tolerance;
    s.evaluations = spent;
    s.method = best_->method;
    if (evaluator_.finite()) describe(first_order(e, best_->u, kActiveTolerance), e, s);
    if (best_->optimal) {
      s.outcome = Outcome::kOptimal;
    } else if (cut_short) {
      s.outcome = Outcome::kLimitReached;
    } else {
      s.outcome = s.feasible ? Outcome::kFeasible : Outcome::kInfeasible;
    }
    return s;
  }

  void describe(const FirstOrder& order, const Evaluation& e, Solution& s) const {
    for (const ReachedLimit& r : order.reached) {
      if (r.kind == ReachedLimit::Kind::kConstraint) {
        s.active.push_back({problem_.constraints[r.index], ActiveLimit::Kind::kConstraint,
                            e.constraints[r.index], r.multiplier});
        continue;
      }
      const bool lower = r.kind == ReachedLimit::Kind::kLowerBound;
      const Variable& v = problem_.variables[evaluator_.index(r.index)];
      s.active.push_back({v.name, lower ? ActiveLimit::Kind::kLowerBound : ActiveLimit::Kind::kUpperBound,
                          lower ? v.lower : v.upper,
                          r.multiplier / evaluator_.stretch(r.index, best_->u[r.index])});
    }
  }

  const Problem& problem_;
  const Options& options_;
  Evaluator evaluator_;
  std::uint32_t budget_;
  bool spent_ = false;  ///< the budget ended a run, or kept one from beginning
  std::optional<Candidate> best_;
};

}  // namespace

const char* to_text(Outcome outcome) {
  switch (outcome) {
    case Outcome::kOptimal:
      return "optimal";
    case Outcome::kFeasible:
      return "feasible";
    case Outcome::kInfeasible:
      return "infeasible";
    case Outcome::kLimitReached:
      return "limit reached";
  }
  return "";
}

SpentBudgetScope::SpentBudgetScope() : around_(std::exchange(told, this)), elsewhere_(told_elsewhere) {}
SpentBudgetScope::~SpentBudgetScope() { told = around_; }
bool SpentBudgetScope::spent() const { return spent_ || told_elsewhere != elsewhere_; }

void tell_budget_spent() {
  if (told == nullptr) ++told_elsewhere;
  for (SpentBudgetScope* s = told; s != nullptr; s = s->around_) s->spent_ = true;
}

Result<Solution> solve(const Problem& problem, const Options& options, Job& job) {
  if (auto s = validate(problem); !s) return fail(s.error());
  return Search(problem, options, job).run();
}

}  // namespace capstan::optimise

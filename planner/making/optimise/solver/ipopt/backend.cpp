#include <IpStdCInterface.h>

#include <algorithm>
#include <exception>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>

#include "planner/ground/base/loading/library.h"
#include "planner/making/optimise/solver/backend.h"
#include "planner/making/optimise/solver/ipopt/library.h"
#include "planner/making/optimise/solver/spent_budget.h"

// Ipopt through its C interface. Its library is opened when a problem first comes here: with what it needs
// itself (MUMPS, LAPACK, the Fortran runtime) it would take a sixth of the start of every command.

namespace capstan::optimise {
namespace {

constexpr Number kNoBound = -2e19;  // Ipopt reads below -1e19 as minus infinity
constexpr Index kCountFrom0 = 0;    // rows and columns

/// Its functions, of the types that its header declares.
struct Ipopt {
  decltype(&CreateIpoptProblem) create = nullptr;
  decltype(&FreeIpoptProblem) free = nullptr;
  decltype(&AddIpoptStrOption) add_text = nullptr;
  decltype(&AddIpoptNumOption) add_number = nullptr;
  decltype(&AddIpoptIntOption) add_whole = nullptr;
  decltype(&SetIntermediateCallback) ask_between = nullptr;
  decltype(&IpoptSolve) solve = nullptr;
};

Result<Ipopt> opened(const std::string& file) {
  const auto library = Library::open(file);
  if (!library) return tl::unexpected(library.error());
  Ipopt f;
  Status all;
  const auto take = [&](const char* name, auto*& to) {
    if (all) all = library->take(name, to);
  };
  take("CreateIpoptProblem", f.create);
  take("FreeIpoptProblem", f.free);
  take("AddIpoptStrOption", f.add_text);
  take("AddIpoptNumOption", f.add_number);
  take("AddIpoptIntOption", f.add_whole);
  take("SetIntermediateCallback", f.ask_between);
  take("IpoptSolve", f.solve);
  if (!all) return tl::unexpected(all.error());
  return f;
}

/// The evaluator as Ipopt's problem: dense Jacobian, no Hessian. Exceptions are kept, never passed
/// through Ipopt.
class Bridge {
 public:
  explicit Bridge(Evaluator& evaluator) : evaluator_(evaluator) {}

  static Bool objective(Index n, Number* u, Bool, Number* value, UserDataPtr bridge) {
    const Evaluation* e = of(bridge).at(n, u, false);
    if (e != nullptr) *value = e->objective;
    return e != nullptr;
  }

  static Bool gradient(Index n, Number* u, Bool, Number* slopes, UserDataPtr bridge) {
    const Evaluation* e = of(bridge).at(n, u, true);
    if (e != nullptr) std::copy(e->gradient.begin(), e->gradient.end(), slopes);
    return e != nullptr;
  }

  static Bool constraints(Index n, Number* u, Bool, Index, Number* c, UserDataPtr bridge) {
    const Evaluation* e = of(bridge).at(n, u, false);
    if (e != nullptr) std::copy(e->constraints.begin(), e->constraints.end(), c);
    return e != nullptr;
  }

  static Bool jacobian(Index n, Number* u, Bool, Index m, Index, Index* row, Index* column, Number* values,
                       UserDataPtr bridge) {
    if (values == nullptr) {
      for (Index i = 0; i < m; ++i) {
        for (Index j = 0; j < n; ++j) {
          row[i * n + j] = i;
          column[i * n + j] = j;
        }
      }
      return TRUE;
    }
    const Evaluation* e = of(bridge).at(n, u, true);
    if (e != nullptr) std::copy(e->jacobian.begin(), e->jacobian.end(), values);
    return e != nullptr;
  }

  static Bool hessian(Index, Number*, Bool, Number, Index, Number*, Bool, Index, Index*, Index*, Number*,
                      UserDataPtr) {
    return FALSE;
  }

  /// Whether to go on.
  static Bool between(Index, Index, Number, Number, Number, Number, Number, Number, Number, Number, Index,
                      UserDataPtr bridge) {
    return !of(bridge).thrown_ && !of(bridge).evaluator_.exhausted();
  }

  /// Whether a point was asked for: what fails before is no run.
  [[nodiscard]] bool asked() const { return asked_; }

  void rethrow() const {
    if (thrown_) std::rethrow_exception(thrown_);
  }

 private:
  static Bridge& of(UserDataPtr bridge) { return *static_cast<Bridge*>(bridge); }

  const Evaluation* at(Index n, const Number* u, bool want_slopes) {
    asked_ = true;
    if (thrown_ || evaluator_.exhausted()) return nullptr;
    try {
      const Evaluation& e = evaluator_.at({u, static_cast<std::size_t>(n)}, want_slopes);
      return evaluator_.finite() ? &e : nullptr;
    } catch (...) {
      thrown_ = std::current_exception();
      return nullptr;
    }
  }

  Evaluator& evaluator_;
  std::exception_ptr thrown_;
  bool asked_ = false;
};

/// Why there was no run; null: there was one, and what its point is worth is measured by the caller. `status`
/// is what IpoptSolve gave, nothing where it threw. It initialises first, and its statuses for that are those
/// of a run, too (IpReturnCodes_inc.h): where no point was asked for, it has not solved anything.
const char* never_ran(const std::optional<ApplicationReturnStatus>& status, bool asked) {
  if (status == Invalid_Option) return "refused an option, or lacks what it asks for";
  if (status == Invalid_Problem_Definition) return "refused the problem";
  if (asked) return nullptr;
  return status == Insufficient_Memory ? "had not enough memory to begin"
                                       : "ended before it asked for a point";
}

std::mutex& one_at_a_time() {
  static std::mutex mutex;
  return mutex;
}

/// False where Ipopt refuses an option.
bool set_options(const Ipopt& ipopt, IpoptProblem problem, const Attempt& attempt) {
  const auto text = [&](std::string key, std::string value) {
    return ipopt.add_text(problem, key.data(), value.data()) != FALSE;
  };
  const auto number = [&](std::string key, Number value) {
    return ipopt.add_number(problem, key.data(), value) != FALSE;
  };
  const auto whole = [&](std::string key, Int value) {
    return ipopt.add_whole(problem, key.data(), value) != FALSE;
  };
  const auto most = static_cast<Int>(std::min<std::uint32_t>(attempt.max_evaluations, 500));
  return text("option_file_name", "") && whole("print_level", 0) && text("sb", "yes") &&
         text("hessian_approximation", "limited-memory") && number("bound_relax_factor", 0.0) &&
         number("tol", std::max(attempt.relative_tolerance, 1e-9)) && whole("max_iter", most);
}

/// Its functions, or why they are not there. Needs the lock.
const Result<Ipopt>& ipopt_of(const std::string& library) {
  static std::map<std::string, Result<Ipopt>> known;
  auto at = known.find(library);
  if (at == known.end()) at = known.emplace(library, opened(library)).first;
  return at->second;
}

/// The problem as Ipopt holds it; null where it refuses it.
std::unique_ptr<IpoptProblemInfo, decltype(Ipopt::free)> problem_of(const Ipopt& ipopt, std::size_t n,
                                                                    std::size_t m) {
  std::vector<Number> lower(n, 0.0), upper(n, 1.0), c_lower(m, kNoBound), c_upper(m, 0.0);
  const auto variables = static_cast<Index>(n), limits = static_cast<Index>(m);
  return {ipopt.create(variables, lower.data(), upper.data(), limits, c_lower.data(), c_upper.data(),
                       variables * limits, 0, kCountFrom0, &Bridge::objective, &Bridge::constraints,
                       &Bridge::gradient, &Bridge::jacobian, &Bridge::hessian),
          ipopt.free};
}

tl::unexpected<Diagnostic> no_run(const std::string& why) { return fail("OPT-IPOPT", "Ipopt " + why); }

}  // namespace

Result<std::vector<double>> solve_with_ipopt(Evaluator& evaluator, const Attempt& attempt) {
  return solve_with_ipopt_of(CAPSTAN_IPOPT_LIBRARY, evaluator, attempt);
}

Result<std::vector<double>> solve_with_ipopt_of(const std::string& library, Evaluator& evaluator,
                                                const Attempt& attempt) {
  const std::lock_guard lock(one_at_a_time());
  const Result<Ipopt>& ipopt = ipopt_of(library);
  if (!ipopt) {
    return fail(Diagnostic{.code = "OPT-BACKEND-ABSENT",
                           .message = "Ipopt is not there: " + ipopt.error().message,
                           .hint = "install it (Debian: coinor-libipopt1v5); a server that runs (capstan "
                                   "serve) looks for it once: start it again"});
  }
  Bridge bridge(evaluator);
  std::vector<double> u = attempt.start;
  bool began = false;
  std::optional<ApplicationReturnStatus> end;
  try {
    const auto problem = problem_of(*ipopt, evaluator.variables(), evaluator.constraints());
    if (!problem) return no_run("refused the problem");
    if (!set_options(*ipopt, problem.get(), attempt) ||
        ipopt->ask_between(problem.get(), &Bridge::between) == FALSE)
      return no_run("refused its options");
    began = true;
    end = ipopt->solve(problem.get(), u.data(), nullptr, nullptr, nullptr, nullptr, nullptr, &bridge);
  } catch (...) {
    // An Ipopt fault, which is of its own types. Inside a run: the point reached is judged like any other.
    if (!began) return no_run("failed as it was prepared");
  }
  bridge.rethrow();
  const char* const why = never_ran(end, bridge.asked());
  if (why != nullptr) return no_run(why + (end ? " (status " + std::to_string(*end) + ")" : std::string()));
  // max_iter follows the points that are allowed, and an iteration may need none that is new.
  if (end == Maximum_Iterations_Exceeded) tell_budget_spent();
  return u;
}

}  // namespace capstan::optimise

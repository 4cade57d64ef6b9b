#include "planner/making/optimise/solver/backend.h"

#include <IpStdCInterface.h>

#include <algorithm>
#include <exception>
#include <memory>
#include <mutex>

#include "planner/ground/base/loading/library.h"

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

Result<Ipopt> opened() {
  const auto library = Library::open(CAPSTAN_IPOPT_LIBRARY);
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

  void rethrow() const {
    if (thrown_) std::rethrow_exception(thrown_);
  }

 private:
  static Bridge& of(UserDataPtr bridge) { return *static_cast<Bridge*>(bridge); }

  const Evaluation* at(Index n, const Number* u, bool want_slopes) {
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
};

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

}  // namespace

Result<std::vector<double>> solve_with_ipopt(Evaluator& evaluator, const Attempt& attempt) {
  const std::lock_guard lock(one_at_a_time());
  static const Result<Ipopt> ipopt = opened();
  if (!ipopt) {
    return fail(Diagnostic{.code = "OPT-BACKEND-ABSENT",
                           .message = "Ipopt is not there: " + ipopt.error().message,
                           .hint = "install it (Debian: coinor-libipopt1v5)"});
  }
  const std::size_t n = evaluator.variables(), m = evaluator.constraints();
  std::vector<Number> lower(n, 0.0), upper(n, 1.0), c_lower(m, kNoBound), c_upper(m, 0.0);
  const auto variables = static_cast<Index>(n), limits = static_cast<Index>(m);
  const IpoptProblem problem =
      ipopt->create(variables, lower.data(), upper.data(), limits, c_lower.data(), c_upper.data(),
                    variables * limits, 0, kCountFrom0, &Bridge::objective, &Bridge::constraints,
                    &Bridge::gradient, &Bridge::jacobian, &Bridge::hessian);
  if (problem == nullptr) return fail("OPT-IPOPT", "Ipopt refused the problem");
  const std::unique_ptr<IpoptProblemInfo, decltype(ipopt->free)> owned(problem, ipopt->free);
  if (!set_options(*ipopt, problem, attempt) || ipopt->ask_between(problem, &Bridge::between) == FALSE)
    return fail("OPT-IPOPT", "Ipopt refused its options");
  Bridge bridge(evaluator);
  std::vector<double> u = attempt.start;
  try {
    // The status is not looked at: what the point is worth is measured by the caller.
    static_cast<void>(ipopt->solve(problem, u.data(), nullptr, nullptr, nullptr, nullptr, nullptr, &bridge));
  } catch (...) {
    // An Ipopt fault inside a run, which is of its own types: the point reached is judged like any other.
  }
  bridge.rethrow();
  return u;
}

}  // namespace capstan::optimise

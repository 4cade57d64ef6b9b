#include "planner/making/optimise/solver/backend.h"

#include <IpIpoptApplication.hpp>
#include <IpTNLP.hpp>
#include <algorithm>
#include <exception>
#include <mutex>

namespace capstan::optimise {
namespace {

using Ipopt::Index;
using Ipopt::Number;

constexpr Number kNoBound = -2e19;  // Ipopt reads below -1e19 as minus infinity

/// The evaluator as Ipopt's problem: dense Jacobian, no Hessian. Exceptions are kept, never passed
/// through Ipopt.
class Bridge : public Ipopt::TNLP {
 public:
  Bridge(Evaluator& evaluator, std::vector<double> start) : evaluator_(evaluator), u_(std::move(start)) {}

  bool get_nlp_info(Index& n, Index& m, Index& nnz_jacobian, Index& nnz_hessian,
                    IndexStyleEnum& style) override {
    n = static_cast<Index>(evaluator_.variables());
    m = static_cast<Index>(evaluator_.constraints());
    nnz_jacobian = n * m;
    nnz_hessian = 0;
    style = C_STYLE;
    return true;
  }

  bool get_bounds_info(Index n, Number* lower, Number* upper, Index m, Number* c_lower,
                       Number* c_upper) override {
    std::fill(lower, lower + n, 0.0);
    std::fill(upper, upper + n, 1.0);
    std::fill(c_lower, c_lower + m, kNoBound);
    std::fill(c_upper, c_upper + m, 0.0);
    return true;
  }

  bool get_starting_point(Index, bool, Number* u, bool, Number*, Number*, Index, bool, Number*) override {
    std::copy(u_.begin(), u_.end(), u);
    return true;
  }

  bool eval_f(Index n, const Number* u, bool, Number& value) override {
    const Evaluation* e = at(n, u, false);
    if (e != nullptr) value = e->objective;
    return e != nullptr;
  }

  bool eval_grad_f(Index n, const Number* u, bool, Number* gradient) override {
    const Evaluation* e = at(n, u, true);
    if (e != nullptr) std::copy(e->gradient.begin(), e->gradient.end(), gradient);
    return e != nullptr;
  }

  bool eval_g(Index n, const Number* u, bool, Index, Number* c) override {
    const Evaluation* e = at(n, u, false);
    if (e != nullptr) std::copy(e->constraints.begin(), e->constraints.end(), c);
    return e != nullptr;
  }

  bool eval_jac_g(Index n, const Number* u, bool, Index m, Index, Index* row, Index* column,
                  Number* values) override {
    if (values == nullptr) {
      for (Index i = 0; i < m; ++i) {
        for (Index j = 0; j < n; ++j) {
          row[i * n + j] = i;
          column[i * n + j] = j;
        }
      }
      return true;
    }
    const Evaluation* e = at(n, u, true);
    if (e != nullptr) std::copy(e->jacobian.begin(), e->jacobian.end(), values);
    return e != nullptr;
  }

  bool intermediate_callback(Ipopt::AlgorithmMode, Index, Number, Number, Number, Number, Number, Number,
                             Number, Number, Index, const Ipopt::IpoptData*,
                             Ipopt::IpoptCalculatedQuantities*) override {
    return !thrown_ && !evaluator_.exhausted();
  }

  void finalize_solution(Ipopt::SolverReturn, Index n, const Number* u, const Number*, const Number*, Index,
                         const Number*, const Number*, Number, const Ipopt::IpoptData*,
                         Ipopt::IpoptCalculatedQuantities*) override {
    u_.assign(u, u + n);
  }

  [[nodiscard]] const std::vector<double>& point() const { return u_; }
  void rethrow() const {
    if (thrown_) std::rethrow_exception(thrown_);
  }

 private:
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
  std::vector<double> u_;
  std::exception_ptr thrown_;
};

std::mutex& one_at_a_time() {
  static std::mutex mutex;
  return mutex;
}

}  // namespace

Result<std::vector<double>> solve_with_ipopt(Evaluator& evaluator, const Attempt& attempt) {
  const std::lock_guard lock(one_at_a_time());
  // Reference-counted by Ipopt: a bare new is its own idiom.
  const Ipopt::SmartPtr<Bridge> bridge = new Bridge(evaluator, attempt.start);
  try {
    const Ipopt::SmartPtr<Ipopt::IpoptApplication> app = new Ipopt::IpoptApplication(false);
    const auto options = app->Options();
    options->SetStringValue("option_file_name", "");
    options->SetIntegerValue("print_level", 0);
    options->SetStringValue("sb", "yes");
    options->SetStringValue("hessian_approximation", "limited-memory");
    options->SetNumericValue("bound_relax_factor", 0.0);
    options->SetNumericValue("tol", std::max(attempt.relative_tolerance, 1e-9));
    options->SetIntegerValue("max_iter",
                             static_cast<Index>(std::min<std::uint32_t>(attempt.max_evaluations, 500)));
    if (app->Initialize("") != Ipopt::Solve_Succeeded) {
      return fail("OPT-IPOPT", "Ipopt refused its options");
    }
    // The status is not looked at: what the point is worth is measured by the caller.
    static_cast<void>(app->OptimizeTNLP(GetRawPtr(bridge)));
  } catch (const std::exception&) {
    // An Ipopt fault inside a run: the point reached is judged like any other.
  } catch (const Ipopt::IpoptException&) {
  }
  bridge->rethrow();
  return bridge->point();
}

}  // namespace capstan::optimise

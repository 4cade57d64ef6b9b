#include "planner/making/optimise/solver/backend.h"
#include "planner/making/optimise/solver/ipopt/library.h"

namespace capstan::optimise {

Result<std::vector<double>> solve_with_ipopt(Evaluator& evaluator, const Attempt& attempt) {
  return solve_with_ipopt_of("", evaluator, attempt);
}

Result<std::vector<double>> solve_with_ipopt_of(const std::string&, Evaluator&, const Attempt&) {
  return fail(Diagnostic{.code = "OPT-BACKEND-ABSENT",
                         .message = "this build has no Ipopt",
                         .hint = "build with -DCAPSTAN_WITH_IPOPT=ON (Debian: coinor-libipopt-dev)"});
}

}  // namespace capstan::optimise

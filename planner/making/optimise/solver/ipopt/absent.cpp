#include "planner/making/optimise/solver/backend.h"

namespace capstan::optimise {

Result<std::vector<double>> solve_with_ipopt(Evaluator&, const Attempt&) {
  return fail(Diagnostic{.code = "OPT-BACKEND-ABSENT",
                         .message = "this build has no Ipopt",
                         .hint = "build with -DCAPSTAN_WITH_IPOPT=ON (Debian: coinor-libipopt-dev)"});
}

}  // namespace capstan::optimise

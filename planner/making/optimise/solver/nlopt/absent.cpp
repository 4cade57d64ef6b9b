#include "planner/making/optimise/solver/backend.h"

namespace capstan::optimise {

Result<std::vector<double>> solve_with_nlopt(Evaluator&, const Attempt&) {
  return fail(Diagnostic{.code = "OPT-BACKEND-ABSENT",
                         .message = "this build has no NLopt",
                         .hint = "build with -DCAPSTAN_WITH_NLOPT=ON (Debian: libnlopt-cxx-dev)"});
}

}  // namespace capstan::optimise

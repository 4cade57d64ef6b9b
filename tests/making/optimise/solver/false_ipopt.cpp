// Those functions of Ipopt's C interface that the backend takes, which fail as they are told.

#include "tests/making/optimise/solver/false_ipopt.h"

#include <IpStdCInterface.h>

using capstan::optimise::FalseIpopt;
using Fault = FalseIpopt::Fault;

struct IpoptProblemInfo {
  Index variables;
  Eval_F_CB objective;
};

#define CAPSTAN_FALSE extern "C" [[gnu::visibility("default")]]

CAPSTAN_FALSE FalseIpopt capstan_false_ipopt;
FalseIpopt capstan_false_ipopt;

namespace {

bool told(Fault fault) { return capstan_false_ipopt.fault == fault; }

Bool option() {
  if (told(Fault::kThrowsAtOption)) throw 1;
  return told(Fault::kNoOption) ? FALSE : TRUE;
}

}  // namespace

CAPSTAN_FALSE IpoptProblem CreateIpoptProblem(Index n, Number*, Number*, Index, Number*, Number*, Index,
                                              Index, Index, Eval_F_CB objective, Eval_G_CB, Eval_Grad_F_CB,
                                              Eval_Jac_G_CB, Eval_H_CB) {
  if (told(Fault::kThrowsAtProblem)) throw 1;
  return told(Fault::kNoProblem) ? nullptr : new IpoptProblemInfo{n, objective};
}
CAPSTAN_FALSE void FreeIpoptProblem(IpoptProblem problem) { delete problem; }
CAPSTAN_FALSE Bool AddIpoptStrOption(IpoptProblem, char*, char*) { return option(); }
CAPSTAN_FALSE Bool AddIpoptNumOption(IpoptProblem, char*, Number) { return option(); }
CAPSTAN_FALSE Bool AddIpoptIntOption(IpoptProblem, char*, Int) { return option(); }
CAPSTAN_FALSE Bool SetIntermediateCallback(IpoptProblem, Intermediate_CB) {
  return told(Fault::kNoCallback) ? FALSE : TRUE;
}
CAPSTAN_FALSE enum ApplicationReturnStatus IpoptSolve(IpoptProblem problem, Number* u, Number*, Number*,
                                                      Number*, Number*, Number*, UserDataPtr data) {
  Number value = 0.0;
  if (capstan_false_ipopt.asks) problem->objective(problem->variables, u, TRUE, &value, data);
  if (told(Fault::kThrowsAtSolving)) throw 1;
  return static_cast<ApplicationReturnStatus>(capstan_false_ipopt.status);
}

#include "planner/door/app/command/cases/shared.h"
#include "planner/ground/base/number.h"

namespace capstan::app {

int run_cases_export(Session& s) {
  const auto base = casebase::CaseBase::open(*s.options.inputs.cases, s.job);
  if (!base) return s.end(base.error(), kUnreadable);
  const std::vector<casebase::Case> cases = base->cases();
  report_faults(s, *base);
  s.summary = "exported " + counted(cases.size(), "case", "cases");
  return print(s.options.json ? cases_json(cases) : casebase::to_csv(cases)) ? kDone : kImpossible;
}

}  // namespace capstan::app

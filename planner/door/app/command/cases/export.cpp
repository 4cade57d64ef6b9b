#include "planner/door/app/command/cases/shared.h"
#include "planner/ground/base/number.h"

namespace capstan::app {

int run_cases_export(Session& s) {
  const auto base = casebase::CaseBase::open(*s.options.inputs.cases, s.job);
  if (!base) return s.end(base.error(), kUnreadable);
  const std::vector<casebase::Case> cases = base->cases();
  const bool whole = report_faults(s, *base);
  s.summary = "exported " + counted(cases.size(), "case", "cases");
  if (!whole) {
    s.job.report({.code = "CASE-LOST",
                  .severity = Severity::kWarning,
                  .message = "what is exported is not all that was stored: cases were altered or are gone",
                  .file = casebase::name_of(*s.options.inputs.cases),
                  .hint = "restore the base from a copy; keep no copy of it by this export"});
  }
  if (!print(s.options.json ? cases_json(cases) : casebase::to_csv(cases))) return kImpossible;
  return whole ? kDone : kFindings;
}

}  // namespace capstan::app

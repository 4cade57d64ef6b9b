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
    s.job.report(
        {.code = "CASE-LOST",
         .severity = Severity::kWarning,
         .message = "what is exported is not all that was stored: cases are altered or gone, or could not be "
                    "read now (see above)",
         .file = casebase::name_of(*s.options.inputs.cases),
         .hint = "keep no copy of the base by this export; export again where reading failed, else restore "
                 "the base from a copy"});
  }
  if (!print(s.options.json ? cases_json(cases) : casebase::to_csv(cases))) return kImpossible;
  return whole ? kDone : kFindings;
}

}  // namespace capstan::app

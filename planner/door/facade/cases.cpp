#include "capstan/capstan.h"
#include "planner/door/facade/messages.h"
#include "planner/door/service/logs/import_logs.h"

namespace capstan {

CaseImportOutput import_cases(const CaseImport& what) {
  CaseImportOutput out;
  Job job;
  const auto done = service::import_logs(what.cases, what.logs,
                                         {.format = what.format,
                                          .plan = what.plan,
                                          .program = what.program,
                                          .inspection = what.inspection,
                                          .parts = what.parts,
                                          .machine = what.serial,
                                          .unit = what.unit,
                                          .triggers = what.triggers,
                                          .columns = what.columns,
                                          .period_s = what.period_s},
                                         job);
  if (done) {
    out.imported = true;
    out.cases = done->cases;
    out.added = done->added;
    out.held = done->held;
  } else {
    job.report(done.error().what);
  }
  facade::tell(job, out.diagnostics);
  return out;
}

}  // namespace capstan

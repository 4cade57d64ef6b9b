#include "planner/door/app/command/session.h"
#include "planner/door/service/logs/import_logs.h"
#include "planner/ground/base/number.h"

// `capstan cases import`: logs of machines as cases. All cases of all logs are kept, or none.

namespace capstan::app {

int run_cases_import(Session& s) {
  const auto done = service::import_logs(*s.options.inputs.cases, s.options.files, s.options.log, s.job);
  if (!done) return s.end(done.error());
  s.summary = counted(s.options.files.size(), "log", "logs") + ": " + counted(done->cases, "case", "cases") +
              ", " + std::to_string(done->added) + " of them new; the base holds " +
              counted(done->held, "case", "cases");
  return kDone;
}

}  // namespace capstan::app

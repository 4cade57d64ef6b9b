#include <utility>

#include "casebase/casebase.h"
#include "planner/door/app/command/cases/shared.h"
#include "planner/door/app/command/session.h"
#include "planner/door/service/reading.h"
#include "planner/ground/base/file.h"
#include "planner/ground/base/number.h"

namespace capstan::app {

namespace {

/// Cases from a CSV file, or from a plan's steps. A step that makes no case is reported and skipped.
Result<std::vector<casebase::Case>> cases_of(const std::string& path, Job& job) {
  if (path.find("://") != std::string::npos) {  // it may hold a password, so that it is not repeated
    return fail(Diagnostic{.code = "CASE-URI",
                           .message = "'" + casebase::name_of(path) + "' is no file of cases",
                           .hint = "the case base stands first"});
  }
  auto bytes = read_file(path);
  if (!bytes) return tl::unexpected(bytes.error());
  const service::Content content = service::content_of(*bytes);
  if (content != service::Content::kPlanJson && content != service::Content::kPart)
    return casebase::from_csv(*bytes, path);
  const auto plan = service::read_plan(*std::move(bytes), path, job);
  if (!plan) return tl::unexpected(plan.error());
  return casebase::cases_of(*plan, job);
}

}  // namespace

int run_cases_add(Session& s) {
  std::vector<casebase::Case> cases;
  for (const std::string& path : s.options.files) {
    auto more = cases_of(path, s.job);
    if (!more) return s.end(more.error(), kUnreadable);
    cases.insert(cases.end(), more->begin(), more->end());
  }
  auto base = casebase::CaseBase::open_or_create(*s.options.inputs.cases, s.job);
  if (!base) return s.end(base.error(), kUnreadable);
  const std::size_t before = base->size();
  if (auto ok = base->add(cases); !ok) return s.end(ok.error(), kImpossible);
  report_faults(s, *base);
  s.summary = "read " + counted(cases.size(), "case", "cases") + ", " +
              std::to_string(base->size() - before) + " of them new; the base holds " +
              counted(base->size(), "case", "cases");
  return kDone;
}

}  // namespace capstan::app

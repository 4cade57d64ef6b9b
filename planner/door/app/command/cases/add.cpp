#include <algorithm>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "casebase/casebase.h"
#include "casebase/intake.h"
#include "planner/door/app/command/cases/category_words.h"
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
                           .hint = "name the case base first"});
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

/// Cases that are there already with another verdict, which adding does not change: by id, with both
/// verdicts. A case that says nothing contradicts nothing.
std::vector<std::string> judged_otherwise(const casebase::CaseBase& base,
                                          const std::vector<casebase::Case>& cases) {
  std::vector<std::string> out;
  for (const casebase::Case& c : cases) {
    if (c.observed.verdict == casebase::Verdict::kUnknown) continue;
    const auto there = base.get(casebase::id_of(c));
    if (!there || there->observed.verdict == c.observed.verdict) continue;
    out.push_back(there->id.substr(0, 12) + " (" + std::string(to_text(there->observed.verdict)) + ", now " +
                  std::string(to_text(c.observed.verdict)) + ')');
  }
  return out;
}

void tell_judged_otherwise(const std::vector<std::string>& ids, const std::string& base, Job& job) {
  constexpr std::size_t kNamed = 5;
  if (ids.empty()) return;
  std::string text;
  for (std::size_t i = 0; i < std::min(kNamed, ids.size()); ++i) text += (i == 0 ? "" : ", ") + ids[i];
  if (ids.size() > kNamed) text += " and " + std::to_string(ids.size() - kNamed) + " more";
  job.report({.code = "CASE-VERDICT",
              .severity = Severity::kWarning,
              .message = counted(ids.size(), "case is", "cases are") +
                         " there already with another verdict, which stays: " + text,
              .file = base,
              .hint = "give another verdict by capstan cases judge"});
}

}  // namespace

int run_cases_add(Session& s) {
  std::vector<casebase::Case> cases;
  for (const std::string& path : s.options.files) {
    auto more = cases_of(path, s.job);
    if (!more) return s.end(more.error(), kUnreadable);
    cases.insert(cases.end(), more->begin(), more->end());
  }
  std::vector<std::string_view> times;
  for (const casebase::Case& c : cases) times.push_back(c.from.time_utc);
  if (auto later = of_the_future(times, "case is", "cases are")) s.job.report(*std::move(later));
  for (Diagnostic& d : unplanned_words(cases)) s.job.report(std::move(d));
  const auto tell = [&](std::size_t added, std::size_t held) {
    s.summary = "read " + counted(cases.size(), "case", "cases") + ", " + std::to_string(added) +
                " of them new; the base holds " + counted(held, "case", "cases");
  };
  auto intake = casebase::Intake::open_or_create(*s.options.inputs.cases, s.job);
  if (!intake) return s.end(intake.error(), kUnreadable);
  const auto added = intake->add(cases);
  if (!added) return s.end(added.error(), kImpossible);
  if (*added) {
    for (Diagnostic& d : intake->take_faults()) s.job.report(std::move(d));
    tell((*added)->added, (*added)->held);
    return kDone;
  }
  auto base = intake->read(s.job);
  if (!base) return s.end(base.error(), kUnreadable);
  const std::vector<std::string> otherwise = judged_otherwise(*base, cases);
  const std::size_t before = base->size();
  if (auto ok = base->add(cases); !ok) return s.end(ok.error(), kImpossible);
  report_faults(s, *base);
  tell_judged_otherwise(otherwise, casebase::name_of(*s.options.inputs.cases), s.job);
  tell(base->size() - before, base->size());
  return kDone;
}

}  // namespace capstan::app

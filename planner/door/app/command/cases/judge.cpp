#include "planner/door/app/command/cases/shared.h"
#include "planner/ground/base/number.h"

namespace capstan::app {

namespace {

/// Finds the cases that were named and does `say` to all of them at once.
template <class Say>
int said(Session& s, const Say& say, const std::string& done) {
  auto base = casebase::CaseBase::open(*s.options.inputs.cases, s.job);
  if (!base) return s.end(base.error(), kUnreadable);
  std::vector<std::string> ids;
  for (const std::string& word : s.options.words) {
    auto id = base->find(word);
    if (!id) return s.end(id.error(), kUsage);
    ids.push_back(*std::move(id));
  }
  const CaseJudgement& j = s.options.judgement;
  const Status status = say(*base, ids, casebase::Remark{j.by, j.time_utc, j.reason});
  if (!status) return s.end(status.error(), kImpossible);
  s.summary = counted(ids.size(), "case", "cases") + ' ' + done + "; the base holds " +
              counted(base->size(), "case", "cases");
  return kDone;
}

}  // namespace

int run_cases_judge(Session& s) {
  const auto verdict =
      casebase::verdict_of(s.options.judgement.verdict).value_or(casebase::Verdict::kUnknown);
  return said(
      s, [&](auto& base, const auto& ids, const auto& remark) { return base.judge(ids, verdict, remark); },
      "judged " + s.options.judgement.verdict);
}

int run_cases_remove(Session& s) {
  return said(
      s, [](auto& base, const auto& ids, const auto& remark) { return base.remove(ids, remark); }, "removed");
}

}  // namespace capstan::app

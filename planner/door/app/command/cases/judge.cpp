#include <algorithm>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "planner/door/app/command/cases/shared.h"
#include "planner/ground/base/number.h"

namespace capstan::app {

namespace {

/// Who removed a case, when and why; nothing where nobody did.
std::optional<Diagnostic> removed(const casebase::CaseBase& base, const std::string& id) {
  for (const auto& said : base.later_verdicts(id)) {
    if (said.verdict) continue;
    return Diagnostic{.code = "CASE-REMOVED",
                      .severity = Severity::kNote,
                      .message = "case " + id.substr(0, 12) + " was removed already, " + said.time_utc +
                                 (said.time_utc.empty() ? "by " : " by ") + said.by + ": " + said.reason};
  }
  return std::nullopt;
}

enum class OfRemoved : std::uint8_t { kSkipped, kRefused };

/// Finds the cases that were named, each once, and does `say` to all of them at once.
template <class Say>
int said(Session& s, const Say& say, const std::string& done, OfRemoved of_removed) {
  auto base = casebase::CaseBase::open(*s.options.inputs.cases, s.job);
  if (!base) return s.end(base.error(), kUnreadable);
  std::vector<std::string> ids;
  for (const std::string& word : s.options.words) {
    auto id = base->find(word);
    if (!id) return s.end(id.error(), kUsage);
    if (std::find(ids.begin(), ids.end(), *id) == ids.end()) ids.push_back(*std::move(id));
  }
  std::vector<std::string> there;
  for (const std::string& id : ids) {
    auto gone = removed(*base, id);
    if (!gone) {
      there.push_back(id);
      continue;
    }
    gone->file = casebase::name_of(*s.options.inputs.cases);
    if (of_removed == OfRemoved::kRefused) {
      gone->message += "; a verdict of it would count for nothing, and no case is judged";
      return s.end(*gone, kUsage);
    }
    s.job.report(*std::move(gone));
  }
  ids = std::move(there);
  const CaseJudgement& j = s.options.judgement;
  const casebase::Remark remark{j.by, j.time_utc, j.reason};
  if (const auto fault = casebase::fault_of(remark)) {
    return s.end(Diagnostic{.code = "CASE-REMARK",
                            .message = *fault,
                            .file = casebase::name_of(*s.options.inputs.cases),
                            .expected = "who says it, why, and a time such as 2026-03-01T08:00:00Z"},
                 kUsage);
  }
  if (auto later = of_the_future({j.time_utc}, "time is", "times are")) s.job.report(*std::move(later));
  if (!ids.empty()) {
    const Status status = say(*base, ids, remark);
    if (!status) return s.end(status.error(), kImpossible);
  }
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
      "judged " + s.options.judgement.verdict, OfRemoved::kRefused);
}

int run_cases_remove(Session& s) {
  return said(
      s, [](auto& base, const auto& ids, const auto& remark) { return base.remove(ids, remark); }, "removed",
      OfRemoved::kSkipped);
}

}  // namespace capstan::app

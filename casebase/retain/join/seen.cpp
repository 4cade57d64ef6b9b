#include "casebase/retain/join/seen.h"

#include <map>
#include <string>
#include <utility>
#include <vector>

#include "casebase/recall/evidence.h"
#include "planner/ground/base/number.h"

namespace capstan::casebase::retain {
namespace {

// Of one question alone: what rounding leaves of a distance of nothing.
constexpr double kNoDistance = 1e-9;

/// What a log told of a case; empty: too little. A case whose part was measured later is the same cut.
std::string told_of(Case c) {
  c.observed.size_deviation_mm = c.observed.depth_deviation_mm = c.observed.position_deviation_mm = {};
  c.observed.surface_ra_um = {};
  c.observed.verdict = Verdict::kUnknown;
  const std::string told = evidence_of(c, 0.0, 0.0).told;
  return told.empty() ? told : told + '\n' + c.from.workingstep;
}

/// Cases of one question by what was told of them.
struct OfQuestion {
  Question asked;
  std::multimap<std::string, std::pair<std::string, std::string>> by_told;  // id and time
};

OfQuestion& of(const Question& q, const CaseBase& base, std::vector<OfQuestion>& all) {
  for (OfQuestion& o : all) {
    if (o.asked == q) return o;
  }
  all.push_back({q, {}});
  if (const auto there = base.within(q, kNoDistance)) {
    for (const Neighbour& n : *there)
      all.back().by_told.emplace(told_of(n.found), std::pair(n.found.id, n.found.from.time_utc));
  }
  return all.back();
}

}  // namespace

std::optional<Diagnostic> seen_before(const CaseBase& base, std::span<const Case> cases) {
  constexpr std::size_t kNamed = 5;
  std::vector<OfQuestion> all;
  std::size_t n = 0;
  std::string text;
  for (const Case& c : cases) {
    const std::string told = told_of(c);
    if (told.empty() || base.get(c.id)) continue;
    OfQuestion& known = of(c.asked, base, all);
    const auto [first, last] = known.by_told.equal_range(told);
    for (auto at = first; at != last; ++at) {
      const auto& [id, time] = at->second;
      const bool another_time = !time.empty() && !c.from.time_utc.empty() && time != c.from.time_utc;
      if (id == c.id || another_time) continue;
      if (n++ < kNamed) text += (text.empty() ? "" : ", ") + c.id.substr(0, 12) + " as " + id.substr(0, 12);
      break;
    }
    known.by_told.emplace(told, std::pair(c.id, c.from.time_utc));
  }
  if (n == 0) return std::nullopt;
  if (n > kNamed) text += " and " + std::to_string(n - kNamed) + " more";
  return Diagnostic{.code = "CASE-SAME",
                    .severity = Severity::kNote,
                    .message = counted(n, "new case has", "new cases have") +
                               " the same time and readings as another: " + text,
                    .hint =
                        "where it is one log by another name or part, remove one of them "
                        "(capstan cases remove): together they weigh as one cut"};
}

}  // namespace capstan::casebase::retain

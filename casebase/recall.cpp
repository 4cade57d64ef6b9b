#include "casebase/recall.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "planner/ground/base/number.h"

namespace capstan::casebase {
namespace {

constexpr double kOutlierFactor = 2.0;   // from the median. Default, unsourced
constexpr std::size_t kMedianNeeds = 3;  // below, nobody can tell which one is off

constexpr std::array kByTrust = {Origin::kMeasured, Origin::kEntered, Origin::kSimulated};

std::ptrdiff_t rank(const Case& c) {
  return std::find(kByTrust.begin(), kByTrust.end(), c.origin) - kByTrust.begin();
}

bool may_lead(const Case& c) {
  const Verdict verdict = c.observed.verdict;
  return verdict == Verdict::kGood || (verdict == Verdict::kUnknown && c.origin == Origin::kSimulated);
}

/// Whether `bad` speaks against `c`: it failed although it was cut no harder. An unknown depth or width
/// (zero) of the bad one counts as no harder: it cannot clear `c`.
bool speaks_against(const Case& bad_case, const Case& found) {
  const Bound &bad = bad_case.bound, &c = found.bound;
  const auto no_harder = [](double theirs, double ours) { return ours == 0.0 || theirs <= ours; };
  return bad_case.observed.verdict == Verdict::kBad && rank(bad_case) <= rank(found) &&
         bad.vc_m_min <= c.vc_m_min && bad.fz_mm <= c.fz_mm && no_harder(bad.ap_mm, c.ap_mm) &&
         no_harder(bad.ae_mm, c.ae_mm);
}

/// The lower of the two in the middle where their number is even: the gentler one.
double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>((values.size() - 1) / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/// Leaves out cases whose speed or feed is far from what the others around did.
void leave_out_outliers(std::vector<Near>& group) {
  if (group.size() < kMedianNeeds) return;
  for (double Bound::*const field : {&Bound::vc_m_min, &Bound::fz_mm}) {
    std::vector<double> values;
    for (const Near& n : group) values.push_back(n.found->bound.*field);
    const double m = median(values);
    std::erase_if(group, [&](const Near& n) {
      const double v = n.found->bound.*field;
      return v > kOutlierFactor * m || v * kOutlierFactor < m;
    });
  }
}

model::Precedent precedent_of(const Near& n, std::size_t neighbours) {
  const Case& c = *n.found;
  return {.case_id = c.id,
          .distance = n.distance,
          .neighbours = static_cast<int>(neighbours),
          .provenance = std::string(to_text(c.origin)),
          .vc_m_min = c.bound.vc_m_min,
          .fz_mm = c.bound.fz_mm,
          .ap_mm = c.bound.ap_mm,
          .ae_mm = c.bound.ae_mm};
}

}  // namespace

Answer choose(const std::vector<Near>& near) {
  if (near.empty()) {
    return {std::nullopt, "no case within a distance of " + shortest(kPrecedentDistance)};
  }
  std::vector<const Case*> bad;
  for (const Near& n : near) {
    if (n.found->observed.verdict == Verdict::kBad) bad.push_back(n.found);
  }
  for (const Origin origin : kByTrust) {
    std::vector<Near> group;
    for (const Near& n : near) {
      if (n.found->origin == origin && may_lead(*n.found)) group.push_back(n);
    }
    leave_out_outliers(group);
    const std::size_t neighbours = group.size();
    std::erase_if(group, [&](const Near& n) {
      return std::any_of(bad.begin(), bad.end(), [&](const Case* b) { return speaks_against(*b, *n.found); });
    });
    if (group.empty()) continue;
    const Near& lead = group.front();
    return {precedent_of(lead, neighbours),
            fmt::format("case {} ({}), {} away, one of {} {} near", lead.found->id, to_text(origin),
                        trimmed(lead.distance, 3), neighbours, neighbours == 1 ? "case" : "cases")};
  }
  return {std::nullopt,
          fmt::format("{} near, but none that went well and was not contradicted",
                      near.size() == 1 ? "one case is" : std::to_string(near.size()) + " cases are")};
}

}  // namespace capstan::casebase

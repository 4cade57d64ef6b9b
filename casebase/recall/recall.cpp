#include "casebase/recall/recall.h"

#include <cstddef>
#include <utility>

namespace capstan::casebase {
namespace {

/// Most cases that are looked at: beyond, copies of one case hide what else is near. Default, unsourced.
constexpr std::size_t kMostLookedAt = 1U << 14U;

}  // namespace

Result<std::vector<Neighbour>> cases_near(const CaseBase& base, const Question& question) {
  std::vector<Neighbour> out;
  for (std::size_t k = kNearAsked; k <= kMostLookedAt; k *= 4) {
    auto near = base.nearest(question, k);
    if (!near) return tl::unexpected(near.error());
    bool all = near->size() < k;
    out.clear();
    for (Neighbour& n : *near) {
      if (n.distance > kPrecedentDistance) {
        all = true;
        break;
      }
      out.push_back(std::move(n));
    }
    if (all || cuts_told(evidence_of(out, question)) >= kNearAsked) break;
  }
  return out;
}

std::vector<Evidence> evidence_of(const std::vector<Neighbour>& near, const Question& question) {
  std::vector<Evidence> out;
  out.reserve(near.size());
  for (const Neighbour& n : near)
    out.push_back(evidence_of(n.found, n.distance, question.cutter_diameter_mm));
  return out;
}

Result<std::vector<Evidence>> evidence_near(const CaseBase& base, const Question& question) {
  return cases_near(base, question).map([&](const std::vector<Neighbour>& near) {
    return evidence_of(near, question);
  });
}

}  // namespace capstan::casebase

#include "casebase/recall/recall.h"

#include <cstddef>
#include <utility>

namespace capstan::casebase {
namespace {

/// Most cases that are looked at: beyond, copies of one case hide what else is near. Default, unsourced.
constexpr std::size_t kMostLookedAt = 1U << 14U;

}  // namespace

Result<NearCases> cases_near(const CaseBase& base, const Question& question) {
  NearCases out;
  out.whole = base.whole();
  for (std::size_t k = kNearAsked; k <= kMostLookedAt; k *= 4) {
    auto near = base.look(question, k);
    if (!near) return tl::unexpected(near.error());
    const bool all = near->found.size() + near->lost.size() < k;
    const auto beyond = [](const auto& n) { return n.distance > kPrecedentDistance; };
    const std::size_t left = std::erase_if(near->found, beyond) + std::erase_if(near->lost, beyond);
    out.found = std::move(near->found);
    out.lost = std::move(near->lost);
    if (all || left > 0 || cuts_told(evidence_of(out.found, question)) >= kNearAsked) break;
  }
  return out;
}

std::vector<Evidence> evidence_of(const NearCases& near, const Question& question) {
  std::vector<Evidence> out = evidence_of(near.found, question);
  if (near.whole && near.lost.empty()) return out;
  for (Evidence& e : out) e.raises = false;
  for (const CaseBase::Lost& l : near.lost) {
    if (l.verdict != Verdict::kBad) continue;
    Evidence e;
    e.id = l.id;
    e.run = "lost " + l.id;
    e.origin = l.origin;
    e.verdict = l.verdict;
    e.blame = {.speed = true, .feed = true, .depth = false};
    e.distance = l.distance;
    e.raises = false;
    e.lost = true;
    out.push_back(std::move(e));
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
  return cases_near(base, question).map([&](const NearCases& near) { return evidence_of(near, question); });
}

}  // namespace capstan::casebase

#include "casebase/recall/recall.h"

#include <cstddef>

namespace capstan::casebase {
namespace {

/// Most cases that are looked at: beyond, copies of one case hide what else is near. Default, unsourced.
constexpr std::size_t kMostLookedAt = 1U << 14U;

}  // namespace

Result<std::vector<Evidence>> evidence_near(const CaseBase& base, const Question& question) {
  std::vector<Evidence> out;
  for (std::size_t k = kNearAsked; k <= kMostLookedAt; k *= 4) {
    const auto near = base.nearest(question, k);
    if (!near) return tl::unexpected(near.error());
    out.clear();
    bool all = near->size() < k;
    for (const Neighbour& n : *near) {
      if (n.distance > kPrecedentDistance) {
        all = true;
        break;
      }
      out.push_back(evidence_of(n.found, n.distance, question.cutter_diameter_mm));
    }
    if (all || cuts_told(out) >= kNearAsked) break;
  }
  return out;
}

}  // namespace capstan::casebase

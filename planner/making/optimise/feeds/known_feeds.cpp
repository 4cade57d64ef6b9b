#include "planner/making/optimise/feeds/known_feeds.h"

#include <algorithm>
#include <bit>
#include <utility>

namespace capstan::optimise {
namespace {

// What is kept is some 300 bytes a class, and of the last question its ready cuts; a path has a few hundred
// classes. Defaults, unsourced.
constexpr std::size_t kMostQuestions = 16;
constexpr std::size_t kMostClasses = 4096;

}  // namespace

struct KnownFeeds::Shelf {
  CutQuestion question;
  double feed_mm_min = 0.0;
  Classes classes;
};

KnownFeeds::KnownFeeds() : shelves_(std::make_shared<std::vector<Shelf>>()) {}

KnownFeeds::Classes& KnownFeeds::of(const CutQuestion& question, double feed_mm_min) {
  std::vector<Shelf>& all = *shelves_;
  auto at = std::find_if(all.begin(), all.end(), [&](const Shelf& s) {
    return s.feed_mm_min == feed_mm_min && s.question == question;
  });
  if (!all.empty() && at != all.begin()) all.front().classes.forget_ready();
  if (at == all.end()) {
    if (all.size() == kMostQuestions) all.pop_back();
    all.push_back({question, feed_mm_min, {}});
    at = all.end() - 1;
  }
  std::rotate(all.begin(), at, at + 1);
  return all.front().classes;
}

KnownFeeds::Classes::Exactly KnownFeeds::Classes::key_of(const feed::CutClass& c, double n_rpm) {
  const auto bits = [](double v) { return std::bit_cast<std::uint64_t>(v); };
  return {bits(n_rpm),          bits(c.cut.ap_mm),     bits(c.cut.entry_rad),
          bits(c.cut.exit_rad), bits(c.gain),          bits(c.cut.csa_mm2),
          bits(c.cut.band_mm),  bits(c.cut.front_sin), c.cut.chip_measured ? 1U : 0U};
}

const feed::CutClass* KnownFeeds::Classes::find(const feed::CutClass& like, double n_rpm) const {
  const auto it = classes_.find(key_of(like, n_rpm));
  return it == classes_.end() ? nullptr : &it->second;
}

void KnownFeeds::Classes::forget_ready() {
  for (auto& [key, kind] : classes_) kind.ready.reset();
}

void KnownFeeds::Classes::keep(const feed::CutClass& filled, double n_rpm) {
  if (classes_.size() >= kMostClasses) classes_.clear();
  classes_.emplace(key_of(filled, n_rpm), filled);
}

}  // namespace capstan::optimise

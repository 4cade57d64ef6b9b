#include "casebase/search.h"

#include <algorithm>
#include <functional>
#include <limits>
#include <mutex>

#include "casebase/index/index.h"
#include "casebase/key/normalisation.h"

namespace capstan::casebase {
namespace {

/// The tail may be this part of a bucket before its index is made again; and no less than the other, which is
/// looked at in some microseconds. Defaults, unsourced.
constexpr std::size_t kTailPart = 8, kTailLeast = 512;

/// Cases of equal categories that know the same numbers.
struct Bucket {
  std::vector<std::uint32_t> members;  // entries that are not removed; the first `indexed` by id
  std::size_t indexed = 0;
  std::unique_ptr<Index> index;
  std::vector<Point> tail;  // points of the members behind `indexed`
};

}  // namespace

struct Search::Impl {
  const Log* log = nullptr;
  Metric metric;
  /// By categories and what is known.
  mutable std::map<std::pair<std::uint32_t, std::uint16_t>, Bucket> buckets;
  mutable std::mutex making;
  std::size_t seen = 0, notes_seen = 0;

  const Entry& entry(std::uint32_t i) const { return log->entries()[i]; }

  /// Puts the members in order and makes their index.
  void make(Bucket& bucket) const {
    std::vector<std::uint32_t>& members = bucket.members;
    std::sort(members.begin(), members.end(),
              [&](std::uint32_t a, std::uint32_t b) { return entry(a).id < entry(b).id; });
    Points points;
    points.dimensions = kDimensions;
    points.values.reserve(members.size() * kDimensions);
    for (const std::uint32_t m : members) {
      const Point p = point_of(entry(m).key);
      points.values.insert(points.values.end(), p.begin(), p.end());
    }
    bucket.index = make_index(std::move(points));
    bucket.indexed = members.size();
    bucket.tail.clear();
  }

  /// Makes the index where there is none, or where the tail is long.
  void ready(Bucket& bucket) const {
    const std::lock_guard lock(making);
    const std::size_t waiting = bucket.members.size() - bucket.indexed;
    if (!bucket.index || waiting > std::max(kTailLeast, bucket.members.size() / kTailPart)) {
      make(bucket);
      return;
    }
    while (bucket.tail.size() < waiting)
      bucket.tail.push_back(point_of(entry(bucket.members[bucket.indexed + bucket.tail.size()]).key));
  }

  using Look = std::function<std::vector<Hit>(const Index&, const Place&, double added2)>;
  /// Everything that `look` finds in an index, and everything in the tails to `limit2`, in order.
  std::vector<Found> all(const Question& q, const Look& look, double limit2) const {
    const Key key = key_of(q);
    const Point at = point_of(key);
    std::vector<Found> out;
    const auto number = category(q);
    if (!number) return out;
    const auto first = buckets.lower_bound({*number, 0});
    for (auto it = first; it != buckets.end() && it->first.first == *number; ++it) {
      const Comparison c = comparison(key.known, it->first.second);
      if (!c.comparable) continue;
      ready(it->second);
      Point weight{};
      for (std::size_t i = 0; i < kDimensions; ++i)
        weight[i] = (c.counted >> i & 1U) != 0 ? metric.weight[i] : 0.0;
      const Bucket& b = it->second;
      for (const Hit& hit : look(*b.index, {at, weight}, c.added2))
        out.push_back({b.members[hit.row], hit.distance2 + c.added2});
      for (std::size_t i = 0; i < b.tail.size(); ++i) {
        const double d2 = distance2(at.data(), b.tail[i].data(), weight.data(), kDimensions) + c.added2;
        if (d2 <= limit2) out.push_back({b.members[b.indexed + i], d2});
      }
    }
    std::sort(out.begin(), out.end(), [&](const Found& a, const Found& b) {
      return a.distance2 != b.distance2 ? a.distance2 < b.distance2 : entry(a.entry).id < entry(b.entry).id;
    });
    return out;
  }

  std::optional<std::uint32_t> category(const Question& q) const { return log->category(categories_of(q)); }
};

Search::Search(const Log& log) : impl_(std::make_unique<Impl>()) {
  impl_->log = &log;
  update();
}
Search::Search(Search&&) noexcept = default;
Search& Search::operator=(Search&&) noexcept = default;
Search::~Search() = default;

void Search::weigh(const Metric& metric) { impl_->metric = metric; }
const Metric& Search::metric() const { return impl_->metric; }

void Search::update() {
  const std::vector<Entry>& entries = impl_->log->entries();
  for (; impl_->seen < entries.size(); ++impl_->seen) {
    const Entry& e = entries[impl_->seen];
    if (!e.removed)
      impl_->buckets[{e.categories, e.key.known}].members.push_back(static_cast<std::uint32_t>(impl_->seen));
  }
  const std::vector<Note>& notes = impl_->log->notes();
  for (; impl_->notes_seen < notes.size(); ++impl_->notes_seen) {
    const Note& note = notes[impl_->notes_seen];
    if (note.kind != RowKind::kRemoval) continue;
    const Entry& e = entries[note.entry];
    const auto at = impl_->buckets.find({e.categories, e.key.known});
    if (at == impl_->buckets.end() || std::erase(at->second.members, note.entry) == 0) continue;
    at->second.index.reset();
    at->second.indexed = 0;
    at->second.tail.clear();
  }
}

bool Search::any(const Question& q) const {
  const auto number = impl_->category(q);
  if (!number) return false;
  const std::uint16_t known = key_of(q).known;
  for (auto it = impl_->buckets.lower_bound({*number, 0});
       it != impl_->buckets.end() && it->first.first == *number; ++it) {
    if (!it->second.members.empty() && comparison(known, it->first.second).comparable) return true;
  }
  return false;
}

std::vector<Found> Search::nearest(const Question& q, std::size_t k) const {
  const auto look = [&](const Index& index, const Place& place, double) { return index.nearest(place, k); };
  std::vector<Found> found = impl_->all(q, look, std::numeric_limits<double>::infinity());
  found.resize(std::min(k, found.size()));
  return found;
}

std::vector<Found> Search::within(const Question& q, double limit2) const {
  const auto look = [&](const Index& index, const Place& place, double added2) {
    // The difference and the sum round apart: a hit at the limit counts by its sum.
    constexpr double kRounding = 1e-12;
    std::vector<Hit> hits = index.within(place, limit2 - added2 + kRounding * (1.0 + limit2));
    std::erase_if(hits, [&](const Hit& h) { return h.distance2 + added2 > limit2; });
    return hits;
  };
  return impl_->all(q, look, limit2);
}

}  // namespace capstan::casebase

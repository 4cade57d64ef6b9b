#include "planner/making/optimise/feeds/cut_classes.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>

#include "planner/ground/base/stopping.h"
#include "planner/making/optimise/feeds/known_feeds.h"

namespace capstan::optimise::feed {
namespace {

using std::numbers::pi;

constexpr double kDepthStep = 0.0025;  // of the logarithm
constexpr double kSweepStep = 0.01;
/// Along a corner the edge is integrated at four points: a heavier class may come out lighter, by 0.23 % at
/// most in random sections. More than that is added.
constexpr double kCornerGrid = 1.01;
constexpr double kGainStep = 0.1;
constexpr double kFrontStep = 1.0 / 128.0;
constexpr long kNoArea = std::numeric_limits<long>::min();
/// Cuts that stay ready for their peak loads, some 3 kB each by measured coefficients. Of a path whose
/// sections all differ the others are made ready once more. Default, unsourced.
constexpr std::size_t kMostReady = 4096;
constexpr int kPoints = 7;  // feeds at which loads of a class are computed, from above the ceiling down

struct Point {
  double feed = 0.0;
  Column load{};
};

/// Where a load reaches a limit between two feeds, on the chord of the logarithms. Loads are a + b f^p with
/// a >= 0: convex there, so the chord overstates them and the feed stays on the safe side.
double crossing(const Point& lo, const Point& hi, std::size_t i, double limit) {
  const double l0 = lo.load[i];
  const double l1 = hi.load[i];
  if (!(l0 > 0.0) || !(l1 > l0)) return lo.feed;
  const double t = std::log(limit / l0) / std::log(l1 / l0);
  return lo.feed * std::pow(hi.feed / lo.feed, std::clamp(t, 0.0, 1.0));
}

/// `points` by falling feed.
double feed_at(const std::vector<Point>& points, std::size_t i, double limit) {
  if (points.front().load[i] <= limit) return std::numeric_limits<double>::infinity();
  for (std::size_t k = 1; k < points.size(); ++k) {
    if (points[k].load[i] <= limit) return crossing(points[k], points[k - 1], i, limit);
  }
  return 0.0;
}

/// Loads of a class, of a corner's no less than any of the class has.
std::optional<Column> loads_at(const CutLoads& loads, const ReadyCut* cut, double feed) {
  const auto s = cut != nullptr ? loads.at(*cut, feed) : std::nullopt;
  if (!s) return std::nullopt;
  Column load = s->load;
  if (cut->cut.csa_mm2 > 0.0) {
    for (double& v : load) v *= kCornerGrid;
  }
  return load;
}

bool within(const Column& load, const Column& limits) { return ratio(load, limits) <= 1.0; }

}  // namespace

const CutLoads& CutClasses::loads(double n_rpm) {
  const auto it = loads_.find(n_rpm);
  if (it != loads_.end()) return it->second;
  return loads_.emplace(n_rpm, CutLoads(q_.cut, q_.feed_mm_min, n_rpm)).first->second;
}

CutClass& CutClasses::class_of(const Cut& cut, double n_rpm) {
  tick();
  const long depth = static_cast<long>(std::ceil(std::log(cut.ap_mm) / kDepthStep - 1e-9));
  const double sweep = std::max(cut.exit_rad - cut.entry_rad, 1e-4);
  // One step more than needed, so that the class still covers the arc after its entry is rounded down.
  const long sweep_class = static_cast<long>(std::ceil(std::log(sweep) / kSweepStep - 1e-9)) + 1;
  const double swept = std::exp(kSweepStep * static_cast<double>(sweep_class));
  const double entry_step = swept * (1.0 - std::exp(-kSweepStep));
  const long entry_class = static_cast<long>(std::floor(cut.entry_rad / entry_step + 1e-9));
  const long area =
      cut.csa_mm2 > 0.0 ? static_cast<long>(std::ceil(std::log(cut.csa_mm2) / kDepthStep - 1e-9)) : kNoArea;
  const long gain = static_cast<long>(std::ceil(std::log(std::max(cut.gain, 1.0)) / kGainStep - 1e-9));
  const long band =
      cut.band_mm > 0.0 ? static_cast<long>(std::ceil(std::log(cut.band_mm) / kDepthStep - 1e-9)) : kNoArea;
  const long share = static_cast<long>(std::ceil(cut.front_sin / kFrontStep - 1e-9));
  const long front = cut.chip_measured ? -share : share;
  const Key key{n_rpm, depth, sweep_class, entry_class, area, gain, band, front};
  if (last_ != nullptr && key == last_key_) return *last_;
  auto it = classes_.find(key);
  if (it == classes_.end()) {
    CutClass p;
    p.cut.ap_mm = std::exp(kDepthStep * static_cast<double>(depth));
    if (area != kNoArea) p.cut.csa_mm2 = std::exp(kDepthStep * static_cast<double>(area));
    if (band != kNoArea) p.cut.band_mm = std::exp(kDepthStep * static_cast<double>(band));
    p.gain = std::exp(kGainStep * static_cast<double>(gain));
    p.cut.front_sin = std::min(1.0, kFrontStep * static_cast<double>(share));
    p.cut.chip_measured = cut.chip_measured;
    p.cut.entry_rad = std::min(static_cast<double>(entry_class) * entry_step, cut.entry_rad);
    p.cut.exit_rad = std::min(p.cut.entry_rad + swept, std::max(pi, cut.exit_rad));
    if (const CutClass* same = known_ != nullptr ? known_->find(p, n_rpm) : nullptr) {
      p = *same;
    } else {
      fill(p, loads(n_rpm));
      if (p.ready != nullptr && ++ready_ > kMostReady) p.ready.reset();
      if (known_ != nullptr) known_->keep(p, n_rpm);
    }
    it = classes_.emplace(key, p).first;
  }
  last_key_ = key;
  last_ = &it->second;
  return *last_;
}

const CutClass& CutClasses::plunge(double area_mm2, double n_rpm) {
  const long area =
      area_mm2 > 0.0 ? static_cast<long>(std::ceil(std::log(area_mm2) / kDepthStep - 1e-9)) : kNoArea;
  const auto key = std::pair(n_rpm, area);
  const auto it = plunges_.find(key);
  if (it != plunges_.end()) return it->second;
  const CutLoads& j = loads(n_rpm);
  CutClass p;
  if (area != kNoArea) p.cut.csa_mm2 = std::exp(kDepthStep * static_cast<double>(area));
  double lo = j.floor_mm_min();
  double hi = std::max(lo, kPlungeFraction * q_.feed_mm_min);
  const auto ok = [&](double feed) {
    const auto s = j.plunging(p.cut.csa_mm2, feed);
    return s && within(s->load, j.limits());
  };
  if (ok(hi)) {
    lo = hi;
  } else {
    for (int i = 0; i < 40; ++i) {
      const double mid = std::sqrt(lo * hi);
      (ok(mid) ? lo : hi) = mid;
    }
  }
  p.feed_mm_min = lo;
  return plunges_.emplace(key, p).first->second;
}

void CutClasses::fill(CutClass& kind, const CutLoads& loads) const {
  const double top = kMoreOfALimit * loads.ceiling_mm_min() * kind.gain;
  const double bottom = loads.floor_mm_min();
  const Column& limits = loads.limits();
  if (auto ready = loads.ready(kind.cut)) kind.ready = std::make_shared<const ReadyCut>(*std::move(ready));
  const ReadyCut* const cut = kind.ready.get();
  std::vector<Point> points;
  points.reserve(kPoints);
  const double step = std::pow(bottom / top, 1.0 / (kPoints - 1));
  for (int k = 0; k < kPoints; ++k) {
    const double feed = k + 1 == kPoints ? bottom : top * std::pow(step, k);
    const auto load = loads_at(loads, cut, feed);
    if (!load) {
      kind.known = false;
      return;
    }
    points.push_back({feed, *load});
    if (within(*load, limits)) break;
  }
  for (std::size_t i = 0; i < kLimits; ++i) {
    kind.at_limit[i] = feed_at(points, i, limits[i]);
    kind.at_more[i] = feed_at(points, i, kMoreOfALimit * limits[i]);
  }
  const double first = *std::min_element(kind.at_limit.begin(), kind.at_limit.end());
  if (points.size() == 1 || !within(points.back().load, limits)) {
    kind.feed_mm_min = points.size() == 1 ? first : 0.0;
    return;
  }
  // Chords of chords: what holds and what does not draw near each other.
  Point good = points.back();
  Point bad = points[points.size() - 2];
  constexpr double kNear = 1e-3;
  double guess = first;
  for (int i = 0; i < 6 && bad.feed > good.feed * (1.0 + kNear); ++i) {
    guess = std::clamp(guess, good.feed * (1.0 + 0.1 * kNear), bad.feed / (1.0 + 0.1 * kNear));
    const auto load = loads_at(loads, cut, guess);
    if (!load) break;
    const Point p{guess, *load};
    const double r = ratio(p.load, limits);
    (r <= 1.0 ? good : bad) = p;
    if (r <= 1.0 && r > 1.0 - kNear) break;
    guess = bad.feed;
    for (std::size_t k = 0; k < kLimits; ++k) {
      if (bad.load[k] > limits[k]) guess = std::min(guess, crossing(good, bad, k, limits[k]));
    }
  }
  kind.feed_mm_min = good.feed;
  // The limit that holds is the one whose own feed lies lowest; its own feed is the one found.
  const auto lowest = std::min_element(kind.at_limit.begin(), kind.at_limit.end());
  const double up = good.feed / std::max(*lowest, 1e-9);
  for (std::size_t k = 0; k < kLimits; ++k) {
    kind.at_limit[k] = std::max(kind.at_limit[k], good.feed);
    kind.at_more[k] = std::max(kind.at_more[k] * (up > 1.0 ? up : 1.0), kind.at_limit[k]);
  }
  kind.at_limit[static_cast<std::size_t>(lowest - kind.at_limit.begin())] = good.feed;
}

}  // namespace capstan::optimise::feed

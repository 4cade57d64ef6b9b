#include "rules/facts/passage.h"

#include <algorithm>

namespace capstan::rules {
namespace {

constexpr double kCorner = 0.69;    // of r^2: what a corner of 60 degrees keeps from a cutter of radius r
constexpr double kReached = 0.01;   // of r^2: what counts as nothing, the chords of arcs included
constexpr double kAccuracy = 0.01;  // of the widest

// Whether a cutter of that radius leaves no piece larger than `share` of r^2.
bool reaches(const geometry::Region& area, double radius_mm, double share, double arc_mm) {
  if (!(radius_mm > 0.0)) return true;
  const auto centres = geometry::offset(area, -radius_mm, arc_mm);
  if (centres.empty()) return false;
  const auto left = geometry::subtract(area, geometry::offset(centres, radius_mm + 2.0 * arc_mm, arc_mm));
  for (const auto& piece : geometry::pieces(left)) {
    if (geometry::area(piece) > share * radius_mm * radius_mm) return false;
  }
  return true;
}

// The largest radius below `hi` (known or assumed too large) for which `fits` holds, from below.
template <class F>
double largest(double hi, double accuracy, const F& fits) {
  double lo = 0.0;
  while (hi - lo > accuracy) {
    const double mid = 0.5 * (lo + hi);
    (fits(mid) ? lo : hi) = mid;
  }
  return lo;
}

}  // namespace

Passage passage_of(const geometry::Region& area) {
  if (area.empty()) return {};
  const auto box = geometry::bounds(area);
  const double half = 0.5 * std::min(box.hi.x - box.lo.x, box.hi.y - box.lo.y);
  if (!(half > 0.0)) return {};
  const double arc = std::max(1e-3, 2e-3 * half);
  const auto fits = [&](double r) { return !geometry::offset(area, -r, arc).empty(); };
  // Often the box itself says it: then no search is needed.
  double widest =
      fits(half * (1.0 - kAccuracy)) ? half * (1.0 - kAccuracy) : largest(half, kAccuracy * half, fits);
  if (!(widest > 0.0)) return {};
  const double start = widest * (1.0 - kAccuracy);
  const double accuracy = kAccuracy * widest;
  const auto all = [&](double share, double hi) {
    if (reaches(area, hi, share, arc)) return hi;
    return largest(hi, accuracy, [&](double r) { return reaches(area, r, share, arc); });
  };
  const double narrowest = all(kCorner, start);
  double exact = all(kReached, narrowest);
  if (exact < 5.0 * accuracy) exact = 0.0;  // nothing but the search's own step
  return {2.0 * widest, 2.0 * narrowest, 2.0 * exact};
}

}  // namespace capstan::rules

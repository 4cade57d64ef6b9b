#include "rules/facts/passage.h"

#include <algorithm>
#include <cmath>

namespace capstan::rules {
namespace {

constexpr double kCorner = 0.69;    // of r^2: what a corner of 60 degrees keeps from a cutter of radius r
constexpr double kReached = 0.005;  // of r^2: what counts as nothing, the chords of arcs included
constexpr double kAccuracy = 0.01;  // of the widest
constexpr double kStep = 1.25;  // from one radius to the next while looking for the first that does not pass
constexpr double kSmallestMm = 0.2;  // radius; narrower cutters are not looked for

// True if a cutter of that radius leaves no piece larger than `share` of r^2; arcs to `arc` of r.
bool reaches(const geometry::Region& area, double radius_mm, double share, double arc) {
  if (!(radius_mm > 0.0)) return true;
  const double arc_mm = std::max(1e-4, arc * radius_mm);
  const auto centres = geometry::offset(area, -radius_mm, arc_mm);
  if (centres.empty()) return false;
  const auto left = geometry::subtract(area, geometry::offset(centres, radius_mm + 2.0 * arc_mm, arc_mm));
  const double limit = share * radius_mm * radius_mm;
  const bool any_large = std::any_of(left.loops.begin(), left.loops.end(), [&](const geometry::Loop& l) {
    return geometry::signed_area(l) > limit;
  });
  if (!any_large) return true;
  const auto parts = geometry::pieces(left);  // a large outline may be a thin ring
  return std::none_of(parts.begin(), parts.end(),
                      [&](const geometry::Region& part) { return geometry::area(part) > limit; });
}

// The largest radius between lo, which fits, and hi, which does not, from below.
template <class F>
double between(double lo, double hi, double accuracy, const F& fits) {
  while (hi - lo > accuracy) {
    const double mid = 0.5 * (lo + hi);
    (fits(mid) ? lo : hi) = mid;
  }
  return lo;
}

bool convex(const geometry::Region& area) {
  if (area.loops.size() != 1) return false;
  const geometry::Loop& l = area.loops.front();
  for (std::size_t i = 0, n = l.size(); i < n; ++i) {
    const auto a = l[(i + 1) % n] - l[i];
    const auto b = l[(i + 2) % n] - l[(i + 1) % n];
    if (cross(a, b) < -1e-5 * norm(a) * norm(b)) return false;
  }
  return true;
}

// Only a cutter little wider than a finger distinguishes it from a corner, so radii are tried from below.
double narrowest(const geometry::Region& area, double top, double accuracy) {
  constexpr double kArc = 0.01;
  const auto fits = [&](double r) { return reaches(area, r, kCorner, kArc); };
  if (convex(area) && fits(top)) return top;
  double lo = 0.0;
  for (double r = std::min(kSmallestMm, top);; r = std::min(r * kStep, top)) {
    if (!fits(r)) return between(lo, r, std::min(accuracy, 0.05 * r), fits);
    if (r >= top) return top;
    lo = r;
  }
}

// Drops points within the tolerance of the chord over them: fine arcs cost time without changing the result.
geometry::Region thinned(const geometry::Region& area, double tolerance_mm) {
  constexpr std::size_t kSpan = 16;  // points under one chord at most, so that the cost stays linear
  std::vector<geometry::Loop> loops;
  for (const geometry::Loop& l : area.loops) {
    const auto near = [&](std::size_t from, std::size_t to) {
      const auto d = l[to % l.size()] - l[from];
      for (std::size_t k = from + 1; k < to; ++k) {
        if (std::abs(cross(d, l[k] - l[from])) > tolerance_mm * norm(d)) return false;
      }
      return true;
    };
    geometry::Loop out;
    for (std::size_t at = 0; at < l.size();) {
      out.push_back(l[at]);
      std::size_t to = at + 1;
      while (to + 1 <= l.size() && to - at < kSpan && near(at, to + 1)) ++to;
      at = to;
    }
    if (out.size() >= 3) loops.push_back(std::move(out));
  }
  return geometry::clean(loops);
}

}  // namespace

Passage passage_of(const geometry::Region& given, bool corners) {
  if (given.empty()) return {};
  const auto box = geometry::bounds(given);
  const double half = 0.5 * std::min(box.hi.x - box.lo.x, box.hi.y - box.lo.y);
  if (!(half > 0.0)) return {};
  const geometry::Region area = thinned(given, 5e-4 * half);
  const double arc_mm = std::max(1e-3, 2e-3 * half);
  const auto enters = [&](double r) { return !geometry::offset(area, -r, arc_mm).empty(); };
  // Often the box itself says it: then no search is needed.
  const double guess = half * (1.0 - kAccuracy);
  const double widest = enters(guess) ? guess : between(0.0, guess, kAccuracy * half, enters);
  if (!(widest > 0.0)) return {};
  const double accuracy = kAccuracy * widest;
  const double passes = narrowest(area, widest - accuracy, accuracy);
  constexpr double kFineArc = 0.002;
  const auto cleans = [&](double r) { return reaches(area, r, kReached, kFineArc); };
  // Sharp corners are common: one try at a radius that any real fillet has detects them.
  double exact = 0.0;
  if (corners && cleans(5.0 * accuracy))
    exact = cleans(passes) ? passes : between(5.0 * accuracy, passes, 2.0 * accuracy, cleans);
  return {2.0 * widest, 2.0 * passes, 2.0 * exact};
}

}  // namespace capstan::rules

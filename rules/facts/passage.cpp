#include "rules/facts/passage.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace capstan::rules {
namespace {

constexpr double kWidePoint = std::numbers::pi / 3.0;   // what is left in a corner of it is a corner
constexpr double kSharpPoint = std::numbers::pi / 6.0;  // sharper: a passage. Default, unsourced
constexpr double kOfArc = 0.26;  // two chords of an arc turn less (15 degrees). Default, unsourced
constexpr double kNear = 0.01;   // of r: a corner of the area belongs to a piece this near
constexpr double kRounding = 1.01;
constexpr double kReached = 0.005;  // of r^2: what counts as nothing, the chords of arcs included
constexpr double kAccuracy = 0.01;  // of the widest
constexpr double kStep = 1.25;  // from one radius to the next while looking for the first that does not pass
constexpr double kSmallestMm = 0.2;  // radius; narrower cutters are not looked for

// Of r^2: what a corner of that angle keeps from a cutter of radius r, between its sides and the arc.
double kept(double angle) { return 1.0 / std::tan(0.5 * angle) - 0.5 * (std::numbers::pi - angle); }

// Of r^2: what the corners of the area in a piece may keep. Where it is one sharp corner, what that keeps.
double corner_share(const geometry::Region& piece, const geometry::Region& area, double radius_mm) {
  double angle = std::numbers::pi;
  int corners = 0;
  for (const geometry::Loop& l : area.loops) {
    for (std::size_t i = 0, n = l.size(); i < n; ++i) {
      const auto a = l[(i + 1) % n] - l[i];
      const auto b = l[(i + 2) % n] - l[(i + 1) % n];
      const double turn = std::atan2(cross(a, b), dot(a, b));
      const geometry::Vec2 at = l[(i + 1) % n];
      if (turn < kOfArc ||
          (!geometry::contains(piece, at) && geometry::distance_to_boundary(piece, at) > kNear * radius_mm))
        continue;
      ++corners;
      angle = std::min(angle, std::numbers::pi - turn);
    }
  }
  return corners == 1 && angle >= kSharpPoint && angle < kWidePoint ? kRounding * kept(angle)
                                                                    : kRounding * kept(kWidePoint);
}

// True if a cutter of that radius leaves no piece larger than `share` of r^2, or, where corners may stay,
// than what they keep, of `wanted` (empty: of all of the area); arcs to `arc` of r.
bool reaches(const geometry::Region& area, const geometry::Region& wanted, double radius_mm, double share,
             double arc, bool corners_stay) {
  if (!(radius_mm > 0.0)) return true;
  const double arc_mm = std::max(1e-4, arc * radius_mm);
  const auto centres = geometry::offset(area, -radius_mm, arc_mm);
  if (centres.empty()) return false;
  const auto made = geometry::offset(centres, radius_mm + 2.0 * arc_mm, arc_mm);
  const auto left = geometry::subtract(wanted.empty() ? area : wanted, made);
  const double limit = share * radius_mm * radius_mm;
  const bool any_large = std::any_of(left.loops.begin(), left.loops.end(), [&](const geometry::Loop& l) {
    return geometry::signed_area(l) > limit;
  });
  if (!any_large) return true;
  const auto parts = geometry::pieces(left);  // a large outline may be a thin ring
  return std::none_of(parts.begin(), parts.end(), [&](const geometry::Region& part) {
    const double mm2 = geometry::area(part);
    if (!(mm2 > limit)) return false;
    return !corners_stay || mm2 > corner_share(part, area, radius_mm) * radius_mm * radius_mm;
  });
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
double narrowest(const geometry::Region& area, const geometry::Region& wanted, double top, double accuracy) {
  constexpr double kArc = 0.01;
  const double corner = kRounding * kept(kWidePoint);
  const auto fits = [&](double r) { return reaches(area, wanted, r, corner, kArc, true); };
  if (convex(area) && fits(top)) return top;
  double lo = 0.0;
  for (double r = std::min(kSmallestMm, top);; r = std::min(r * kStep, top)) {
    if (!fits(r)) return between(lo, r, std::min(accuracy, 0.05 * r), fits);
    if (r >= top) return top;
    lo = r;
  }
}

// Half the shorter side of the box around an area.
double half_width(const geometry::Region& area) {
  const auto box = geometry::bounds(area);
  return 0.5 * std::min(box.hi.x - box.lo.x, box.hi.y - box.lo.y);
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

Passage passage_of(const geometry::Region& given, bool corners, const geometry::Region& asked_for) {
  if (given.empty()) return {};
  const double half = half_width(given);
  if (!(half > 0.0)) return {};
  const geometry::Region area = thinned(given, 5e-4 * half);
  // What thinning took away is not asked for.
  const geometry::Region wanted =
      asked_for.empty() ? geometry::Region{} : geometry::intersect(asked_for, area);
  const double arc_mm = std::max(1e-3, 2e-3 * half);
  const auto enters = [&](double r) { return !geometry::offset(area, -r, arc_mm).empty(); };
  // Often the box itself says it: then no search is needed.
  const double guess = half * (1.0 - kAccuracy);
  const double widest = enters(guess) ? guess : between(0.0, guess, kAccuracy * half, enters);
  if (!(widest > 0.0)) return {};
  const double accuracy = kAccuracy * widest;
  const double passes = narrowest(area, wanted, widest - accuracy, accuracy);
  constexpr double kFineArc = 0.002;
  const auto cleans = [&](double r) { return reaches(area, wanted, r, kReached, kFineArc, false); };
  // Sharp corners are common: one try at a radius that any real fillet has detects them.
  double exact = 0.0;
  const double fine = wanted.empty() ? accuracy : std::min(accuracy, kAccuracy * half_width(wanted));
  if (corners && passes > 5.0 * fine && cleans(5.0 * fine))
    exact = cleans(passes) ? passes : between(5.0 * fine, passes, 2.0 * fine, cleans);
  return {2.0 * widest, 2.0 * passes, 2.0 * exact};
}

}  // namespace capstan::rules

// Where a cutter that moves is lowest over a point. On a line the height over the point is that of the way
// plus that of the outline at the distance sqrt(d^2 + v^2), v from the foot of the point; on a helix plus
// that at the distance given by the law of cosines. Downhill of the foot the way falls and the outline rises:
// the least of each piece of the outline stands where the two slopes are equal. Derived here.
#include "planner/proof/verify/sweep/grid/outline.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "planner/ground/base/stopping.h"
#include "planner/ground/vocabulary/unit_factors.h"

namespace capstan::verify {

using geometry::CutterProfile;
using geometry::ProfilePiece;

namespace {

/// Where f is least between two places, by golden section: 16 steps leave 1/2000 of the way between them.
template <class F>
double least_between(double lo, double hi, const F& f) {
  constexpr double kGolden = 0.6180339887498949;
  double a = hi - kGolden * (hi - lo), b = lo + kGolden * (hi - lo);
  double fa = f(a), fb = f(b);
  for (int i = 0; i < 16; ++i) {
    if (fa < fb) {
      hi = std::exchange(b, a);
      fb = fa;
      a = hi - kGolden * (hi - lo);
      fa = f(a);
    } else {
      lo = std::exchange(a, b);
      fa = fb;
      b = lo + kGolden * (hi - lo);
      fb = f(b);
    }
  }
  return fa < fb ? a : b;
}

/// Where along the way, `v` >= 0 mm past the point and downhill, a piece of the outline is lowest over a
/// point `d` beside the way: the zero of  -fall + dh/dv,  h(sqrt(d^2 + v^2)) the piece's height. Cones and
/// spheres have it in closed form; a torus is searched between `lo` and `hi`, an error of 1/2000 of the piece
/// squared over its radius.
double lowest_of(const ProfilePiece& p, const CutterOutline& o, double fall, double d, double lo, double hi) {
  if (p.radius_mm <= 0.0) return p.slope > fall ? fall * d / std::sqrt(p.slope * p.slope - fall * fall) : hi;
  if (p.rc_mm == 0.0)
    return fall * std::sqrt(std::max(0.0, p.radius_mm * p.radius_mm - d * d) / (1.0 + fall * fall));
  return least_between(lo, hi, [&](double v) { return o.height(std::sqrt(d * d + v * v)) - fall * v; });
}

}  // namespace

CutterOutline::CutterOutline(CutterProfile profile) : profile_(std::move(profile)) {
  const auto& p = profile_.pieces;
  ball_ = p.size() == 1 && p[0].radius_mm > 0.0 && p[0].rc_mm == 0.0;
  sphere_ = ball_ && p[0].r1_mm >= profile_.radius_mm;
  if (!p.empty() && p.front().radius_mm == 0.0 && p.front().slope == 0.0) flat_ = p.front().r1_mm;
  if (!p.empty() && p.back().r1_mm == profile_.radius_mm) top_ = profile_.height(profile_.radius_mm);
  // A bin's least height is that of its inner edge, for heights do not fall; less what rounding of the square
  // may shift.
  constexpr double kRounding = 1e-9;
  const double r2 = profile_.radius_mm * profile_.radius_mm;
  bins_per_square_ = r2 > 0.0 ? static_cast<double>(kBins) / r2 : 0.0;
  for (std::size_t i = 0; i < floor_.size(); ++i) {
    const double square = r2 * static_cast<double>(i) / static_cast<double>(kBins);
    floor_[i] = height(std::sqrt(square) * (1.0 - kRounding)) - kRounding;
  }
  // As steep as the outline rises up to half of the radius, and from 0.71 to 0.94 of it. Default, unsourced.
  constexpr std::size_t kInner = kBins / 4, kRim = kBins / 2;
  const auto rise = [&](std::size_t from, std::size_t to) {
    return r2 > 0.0
               ? std::max(0.0, (floor_[to] - floor_[from]) / (r2 * static_cast<double>(to - from) / kBins))
               : 0.0;
  };
  floors_ = {floor_of(rise(0, kInner)), floor_of(rise(kRim, kBins - kInner / 2))};
}

CutterOutline::Floor CutterOutline::floor_of(double per_square) const {
  // In a bin the outline is no lower than the bin's floor, and the line highest at its end.
  Floor out{1e300, per_square};
  for (std::size_t i = 0; i <= kBins; ++i) {
    const double end = bins_per_square_ > 0.0 ? static_cast<double>(i + 1) / bins_per_square_ : 0.0;
    out.at_0 = std::min(out.at_0, floor_[i] - per_square * end);
  }
  return out;
}

double CutterOutline::middle() const {
  constexpr double kMiddle = 0.3;
  const auto& p = profile_.pieces;
  const bool cone = flat_ > 0.0 && p.size() > 1 && p[1].radius_mm == 0.0 && p[1].slope > 0.0;
  return kMiddle * (cone ? flat_ : radius());
}

double lowest_on_line(const CutterOutline& o, double z0, double dz, double foot, double d, double length) {
  const double reach = std::sqrt(std::max(0.0, o.radius() * o.radius() - d * d));
  const double from = std::clamp(foot - reach, 0.0, length), to = std::clamp(foot + reach, 0.0, length);
  const double fall = std::abs(dz) / length;
  // Downhill from the foot: before it the surface over the point only sinks.
  const double begin = dz < 0.0 ? from - foot : foot - to, end = dz < 0.0 ? to - foot : foot - from;
  const double z_foot = z0 + foot / length * dz;
  if (o.flat()) return z_foot - fall * end;  // lowest where it was last over the point
  const double square = d * d;
  const auto f = [&](double v) { return z_foot - fall * v + o.height(std::sqrt(square + v * v)); };
  if (end <= 0.0) return f(end);
  const double first = std::max(begin, 0.0);
  double best = f(end);
  for (const ProfilePiece& p : o.profile().pieces) {
    const double lo = std::max(first, std::sqrt(std::max(0.0, p.r0_mm * p.r0_mm - d * d)));
    const double hi = std::min(end, std::sqrt(std::max(0.0, p.r1_mm * p.r1_mm - d * d)));
    if (p.r1_mm < d || lo > hi) continue;
    best = std::min(best, f(std::clamp(lowest_of(p, o, fall, d, lo, hi), lo, hi)));
  }
  return best;
}

double lowest_on_helix(const CutterOutline& o, double z0, double dz, double radius, double sweep, double away,
                       double ahead) {
  tick();
  const double sum = away * away + radius * radius, twice = 2.0 * away * radius;
  const double r = o.radius();
  // The turn to either side of the point within which it lies under the cutter's end.
  const auto turn_at = [&](double distance) {
    const double c = sum - distance * distance;
    if (c > twice) return -1.0;
    return c <= -twice ? 0.5 * kRadPerTurn : std::acos(std::min(1.0, c / twice));
  };
  double best = std::numeric_limits<double>::infinity();
  const double within = turn_at(r);
  if (within < 0.0) return best;
  // Downhill is counted positive from the point's own turn; where the way rises, from its end backwards.
  const bool falls = dz < 0.0;
  const double fall = std::abs(dz) / sweep;  // mm per rad
  const auto height_at = [&](double turn) {
    return o.height(std::min(r, std::sqrt(std::max(0.0, sum - twice * std::cos(turn)))));
  };
  for (const double round : {-kRadPerTurn, 0.0, kRadPerTurn}) {
    const double foot = ahead + round;  // the point's turn, from the start of the way
    const double z_foot = z0 + foot / sweep * dz;
    const double from = std::max(foot - within, 0.0), to = std::min(foot + within, sweep);
    if (from > to) continue;
    const double begin = falls ? from - foot : foot - to, end = falls ? to - foot : foot - from;
    const auto f = [&](double turn) { return z_foot - fall * turn + height_at(turn); };
    if (o.flat()) {  // lowest where it was last over the point
      best = std::min(best, z_foot - fall * end);
      continue;
    }
    best = std::min(best, f(end));
    if (end <= 0.0) continue;
    const double first = std::max(begin, 0.0);
    best = std::min(best, f(first));
    // The distance grows fastest where the way is square to the point: before it the height over a piece is
    // convex in the turn, and after it least at an end.
    const double steepest = twice > 0.0 ? std::acos(std::min(away, radius) / std::max(away, radius)) : 0.0;
    for (const ProfilePiece& p : o.profile().pieces) {
      const double lo = std::max(first, std::max(0.0, turn_at(p.r0_mm)));
      const double past = std::min(end, turn_at(p.r1_mm));
      if (past < lo) continue;
      best = std::min(best, f(past));
      const double hi = p.radius_mm > 0.0 ? past : std::min(past, steepest);
      if (hi > lo && (p.slope > 0.0 || p.radius_mm > 0.0)) best = std::min(best, f(least_between(lo, hi, f)));
    }
  }
  return best;
}

}  // namespace capstan::verify

#include <algorithm>
#include <cmath>
#include <numbers>

#include "planner/ground/base/number.h"
#include "planner/model/features/shape/build.h"

// Inside corners that a stated radius rounds.
//
// The drawn area is shrunk by the radius and grown again: a mill of that radius covers what comes out. What
// it does not cover are the corners, and, where the area is narrower than the mill, all of a passage. The
// drawn corners in each piece that is not covered tell which of the two it is. One corner is rounded when the
// circle touches both of its sides, that is, when either side is as long as radius x tan(turn / 2); or when
// no more is lost than in a square corner. Several corners together are one corner drawn with a chamfer or a
// smaller arc: they turn no more than kTurnOfOne and lose no more than a square corner does. Anything else is
// a passage.

namespace capstan::model::shape {

using geometry::Region;
using geometry::Vec2;

namespace {

constexpr double kHairMm = 0.003;  // thinner pieces are the rounding of arcs; default, unsourced
constexpr double kNearMm = 0.05;   // a drawn corner belongs to a piece this near; default, unsourced
constexpr double kArcRad = 0.26;   // two chords of a drawn arc turn less (15 degrees); default, unsourced
constexpr double kTurnOfOne = 2.0 * std::numbers::pi / 3.0 + 0.01;  // default, unsourced
constexpr double kSlack = 1.05;                                     // default, unsourced

double turn_at(const geometry::Loop& loop, std::size_t i) {
  const std::size_t n = loop.size();
  const Vec2 a = loop[(i + n - 1) % n], b = loop[i], c = loop[(i + 1) % n];
  return std::atan2(cross(b - a, c - b), dot(b - a, c - b));
}

/// Length of the side that leaves a corner forwards or backwards; the chords of an arc are one side.
double side_from(const geometry::Loop& loop, std::size_t i, bool forwards) {
  const std::size_t n = loop.size();
  double out = 0.0;
  for (std::size_t k = 0; k < n; ++k) {
    const std::size_t next = forwards ? (i + 1) % n : (i + n - 1) % n;
    out += norm(loop[next] - loop[i]);
    i = next;
    if (std::abs(turn_at(loop, i)) > kArcRad) break;
  }
  return out;
}

bool is_corner(const Region& piece, const Region& drawn, const Region& covered, double radius) {
  double turns = 0.0, most = 0.0, lost = 0.0, tangent = 0.0, side = 0.0;
  for (const auto& loop : drawn.loops) {
    for (std::size_t i = 0; i < loop.size(); ++i) {
      const double turn = turn_at(loop, i);
      const bool in =
          geometry::contains(piece, loop[i]) || geometry::distance_to_boundary(piece, loop[i]) < kNearMm;
      if (!in || turn <= 0.0) continue;
      turns += turn;
      if (!geometry::contains(covered, loop[i]))
        lost = std::max(lost, geometry::distance_to_boundary(covered, loop[i]));
      if (turn <= most) continue;
      most = turn;
      tangent = radius * std::tan(0.5 * turn);
      side = std::min(side_from(loop, i, true), side_from(loop, i, false));
    }
  }
  if (!(turns > 0.0)) return false;  // a neck between two areas
  const bool small = lost <= kSlack * radius * (std::numbers::sqrt2 - 1.0);
  if (most >= 0.9 * turns) return small || tangent <= kSlack * side;
  return small && turns <= kTurnOfOne;
}

Region opened(const Region& a, double r) { return geometry::offset(geometry::offset(a, -r), r); }

/// The first piece that is no corner; empty when all are.
Region passage(const Region& drawn, const Region& covered, double radius) {
  const Region missing = geometry::subtract(drawn, covered);
  const Region thick = geometry::offset(geometry::offset(missing, -kHairMm), kHairMm);
  for (const Region& piece : geometry::pieces(thick)) {
    if (!is_corner(piece, drawn, covered, radius)) return piece;
  }
  return {};
}

}  // namespace

Result<Region> rounded_corners(const Model& m, AnyRef feature, const Region& drawn, double radius_mm) {
  // A passage just as wide as the mill is no narrower: chords and grid make it seem so.
  Region piece;
  for (const double r : {radius_mm, radius_mm - 5.0 * kAreaTolerance}) {
    if (!(r > 0.0)) break;
    Region covered = opened(drawn, r);
    piece = passage(drawn, covered, radius_mm);
    if (piece.empty()) return covered;
  }
  // The widest circle in it, and where that is.
  double fits = 0.0, too_wide = radius_mm;
  while (too_wide - fits > 1e-4) {
    const double r = 0.5 * (fits + too_wide);
    (geometry::offset(piece, -r).empty() ? too_wide : fits) = r;
  }
  const Region middle = geometry::offset(piece, -0.999 * fits);
  const auto box = geometry::bounds(middle.empty() ? piece : middle);
  const Vec2 at = 0.5 * (box.lo + box.hi);
  return unsupported(m, feature,
                     "its corner radius of " + trimmed(radius_mm, 3) + " mm does not fit the passage of " +
                         trimmed(2.0 * fits, 2) + " mm at (" + trimmed(at.x, 1) + ", " + trimmed(at.y, 1) +
                         ") of the feature's frame: state a radius of no more than half its width, or draw "
                         "the passage at least " +
                         trimmed(2.0 * radius_mm, 3) + " mm wide");
}

}  // namespace capstan::model::shape

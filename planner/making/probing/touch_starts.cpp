#include "planner/making/probing/touch_starts.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "planner/ground/base/number.h"

namespace capstan::probing {
namespace {

using geometry::Loop;
using geometry::Region;
using geometry::Vec2;
using geometry::Vec3;
using model::FeatureShape;
using model::ShapeKind;

// mm; defaults, unsourced: from where an outside or a level is approached, room around the ball, and how far
// into a wall it is looked whether the wall is there.
constexpr double kApproach = 10.0;
constexpr double kRoom = 0.5;
constexpr double kInto = 0.2;
constexpr double kFar = 1000.0;       // mm: beyond every piece
constexpr double kFacing = 0.999;     // cosine of the angle between a wall's normal and the move
constexpr double kSlack = 0.005;      // mm: arcs of areas are polygons
constexpr std::size_t kSamples = 24;  // along a move

/// Where a ray meets an outline: how far, and whether the outline faces it.
struct Hit {
  double t = 0.0;
  bool facing = false;
};

/// Where the ray meets the circle that an edge is a chord of, when its neighbours are chords of the same one:
/// a wall that is measured to micrometres is not where the chord is, up to one of them nearer.
std::optional<Hit> on_circle(const Loop& loop, std::size_t edge, Vec2 from, Vec2 along, double t) {
  constexpr double kChord = 1.5e-3;  // mm: no outline's chord is farther from its circle
  constexpr double kSame = 5e-5;     // mm: of two sagittas; vertices lie on a grid of 1e-6
  const std::size_t n = loop.size();
  if (n < 4) return std::nullopt;
  const Vec2 a = loop[edge], b = loop[(edge + 1) % n];
  const double length = norm(b - a);
  const Vec2 u = (1.0 / length) * (b - a), v{-u.y, u.x}, middle = 0.5 * (a + b);
  // Circle through a, b and q: its middle is h along v from the chord's.
  const auto height = [&](Vec2 q) -> std::optional<double> {
    const double x = dot(q - middle, u), y = dot(q - middle, v);
    if (std::abs(y) < 1e-9) return std::nullopt;
    return (x * x + y * y - 0.25 * length * length) / (2.0 * y);
  };
  const auto before = height(loop[(edge + n - 1) % n]), after = height(loop[(edge + 2) % n]);
  if (!before || !after || (*before > 0.0) != (*after > 0.0)) return std::nullopt;
  const auto sagitta = [&](double h) { return std::hypot(h, 0.5 * length) - std::abs(h); };
  if (sagitta(*before) > kChord || std::abs(sagitta(*before) - sagitta(*after)) > kSame) return std::nullopt;
  const double h = 0.5 * (*before + *after), radius = std::hypot(h, 0.5 * length);
  const Vec2 centre = middle + h * v, w = from - centre;
  const double p = dot(w, along), under = p * p - dot(w, w) + radius * radius;
  if (under < 0.0) return std::nullopt;
  const double root = std::sqrt(under);
  const double at = std::abs(-p + root - t) < std::abs(-p - root - t) ? -p + root : -p - root;
  return Hit{at, std::abs(dot(w + at * along, along)) / radius > kFacing};
}

std::vector<Hit> hits(const Region& area, Vec2 from, Vec2 along) {
  std::vector<Hit> out;
  for (const Loop& loop : area.loops) {
    for (std::size_t i = 0; i < loop.size(); ++i) {
      const Vec2 a = loop[i], e = loop[(i + 1) % loop.size()] - a;
      const double n = norm(e), over = cross(along, e);
      if (n < 1e-9 || std::abs(over) < 1e-9 * n) continue;
      const double t = cross(a - from, e) / over, k = cross(a - from, along) / over;
      if (!(t > 0.0 && k >= -1e-9 && k <= 1.0 + 1e-9)) continue;
      out.push_back(on_circle(loop, i, from, along, t).value_or(Hit{t, std::abs(over) / n > kFacing}));
    }
  }
  std::sort(out.begin(), out.end(), [](const Hit& a, const Hit& b) { return a.t < b.t; });
  return out;
}

/// The area that a shape removes at its bottom, in its frame.
Region removed(const FeatureShape& s) {
  if (s.kind == ShapeKind::kHole) return geometry::disc({0.0, 0.0}, 0.5 * s.diameter.middle());
  Region out = s.area;
  for (const auto& island : s.islands) out = geometry::subtract(out, island.area);
  return out;
}

/// Whether another feature takes away what is at this point of the workpiece.
bool cut_away(const Piece& w, const FeatureShape& own, Vec3 p) {
  return std::any_of(w.shapes.begin(), w.shapes.end(), [&](const FeatureShape& s) {
    if (s.feature == own.feature && s.member == own.member) return false;
    const Vec3 q = s.frame.to_local(p);
    if (q.z > 0.0 || (q.z < -s.depth_mm && !s.through)) return false;
    if (s.kind == ShapeKind::kHole)
      return norm(geometry::xy(q)) < 0.5 * std::max(s.diameter.nominal_mm, s.bottom_diameter_mm);
    if (!geometry::contains(s.area, geometry::xy(q))) return false;
    return std::none_of(s.islands.begin(), s.islands.end(), [&](const auto& i) {
      return geometry::contains(i.area, geometry::xy(q)) && q.z < i.top_z_mm;
    });
  });
}

/// True if material of another outside is nearer than `room`.
bool stands(const Piece& w, const FeatureShape& own, Vec3 p, double room) {
  return std::any_of(w.shapes.begin(), w.shapes.end(), [&](const FeatureShape& s) {
    if (s.kind != ShapeKind::kOutside || (s.feature == own.feature && s.member == own.member)) return false;
    const Vec3 q = s.frame.to_local(p);
    return std::any_of(s.islands.begin(), s.islands.end(), [&](const auto& i) {
      return q.z < i.top_z_mm + room && (geometry::contains(i.area, geometry::xy(q)) ||
                                         geometry::distance_to_boundary(i.area, geometry::xy(q)) < room);
    });
  });
}

bool within(const geometry::Box3& b, Vec3 p) {
  return p.x > b.lo.x && p.x < b.hi.x && p.y > b.lo.y && p.y < b.hi.y && p.z > b.lo.z && p.z < b.hi.z;
}

/// Heights of the ball's middle that are tried, frame: below the top, above the floor.
std::vector<double> heights(const FeatureShape& s, double left_bottom, double ball) {
  const double floor =
      -s.depth_mm + (s.through ? 0.0 : left_bottom + model::largest_fillet_mm(s) + ball + kRoom);
  std::vector<double> out;
  for (const double part : {0.5, 0.25, 0.75}) {
    const double z = std::max(-part * s.depth_mm, floor);
    if (z <= -kRoom) out.push_back(z);
  }
  return out;
}

struct Asked {
  const Piece& w;
  const FeatureShape& s;
  Left left;
  double ball = 0.0;
  Region walls;  ///< whose outline is touched
  Region space;  ///< where the ball's middle may be
  Vec2 middle;
  bool inside = true;  ///< the walls are around the middle
};

/// The touch along `d`, at the first height where it can be made.
std::optional<Touch> touch(const Asked& a, Vec2 d, double z) {
  const auto met = a.s.kind == ShapeKind::kHole ? std::vector<Hit>{{0.5 * a.s.diameter.middle(), true}}
                                                : hits(a.walls, a.middle, d);
  if (met.empty()) return std::nullopt;
  const Hit wall = a.inside ? met.front() : met.back();
  if (!wall.facing) return std::nullopt;
  const double off = a.left.side_mm + a.ball;
  const double end = a.inside ? wall.t - off : wall.t + off;
  const double begin = a.inside ? 0.0 : end + kApproach;
  if (a.inside && end < kRoom) return std::nullopt;
  for (std::size_t i = 0; i <= kSamples; ++i) {
    const double t = begin + (end - begin) * static_cast<double>(i) / static_cast<double>(kSamples);
    const Vec2 p = a.middle + t * d;
    if (!geometry::contains(a.space, p)) return std::nullopt;
    if (!a.inside && stands(a.w, a.s, a.s.frame.to_parent({p.x, p.y, z}), a.ball + kRoom))
      return std::nullopt;
  }
  // There is no wall behind an open side.
  const Vec2 behind = a.middle + (wall.t + (a.inside ? kInto : -kInto)) * d;
  if (a.s.kind != ShapeKind::kHole && geometry::contains(a.s.reach, behind)) return std::nullopt;
  const Vec3 wall_point = a.s.frame.to_parent({behind.x, behind.y, z});
  if (!within(a.w.raw, wall_point) || cut_away(a.w, a.s, wall_point)) return std::nullopt;
  Touch out;
  const Vec2 from = a.middle + begin * d;
  out.start = a.s.frame.to_parent({from.x, from.y, z});
  const double sign = a.inside ? 1.0 : -1.0;
  out.direction = a.s.frame.direction_to_parent({sign * d.x, sign * d.y, 0.0});
  out.reference = a.s.frame.z;
  out.distance_mm = std::abs(end - begin);
  return out;
}

/// The measuring device in words; without a probe the machine measures by hand.
std::string ball_text(double radius_mm) {
  return radius_mm > 0.0 ? "a ball of " + trimmed(2.0 * radius_mm, 3) + " mm" : "a gauge";
}

Touches across(const Asked& a, const std::vector<std::pair<Vec2, std::string>>& axes, bool all) {
  Touches out;
  std::string missing;
  for (const auto& [d, name] : axes) {
    bool found = false;
    for (const double z : heights(a.s, a.left.bottom_mm, a.ball)) {
      auto plus = touch(a, d, z), minus = touch(a, -1.0 * d, z);
      if (!plus || !minus) continue;
      plus->side = (a.inside ? "+" : "-") + name;
      minus->side = (a.inside ? "-" : "+") + name;
      out.touches.push_back(*plus);
      out.touches.push_back(*minus);
      found = true;
      break;
    }
    if (!found) missing += (missing.empty() ? "" : " and ") + name;
  }
  if (out.touches.empty() || (all && !missing.empty())) {
    out.touches.clear();
    out.why_not = "along " + missing + " there are no two walls facing each other that " + ball_text(a.ball) +
                  " is known to reach freely";
  }
  return out;
}

/// The level of a face, in its middle.
Touches level(const Piece& w, const FeatureShape& s, Left left, double ball) {
  const auto box = geometry::bounds(s.area);
  const Vec2 middle = 0.5 * (box.lo + box.hi);
  const Vec3 below = s.frame.to_parent({middle.x, middle.y, -s.depth_mm - kInto});
  if (s.area.empty() || !geometry::contains(geometry::offset(removed(s), -ball), middle) ||
      cut_away(w, s, below))
    return {{}, "in the middle of the face nothing is known to stand"};
  Touch out;
  out.start = s.frame.to_parent({middle.x, middle.y, -s.depth_mm + left.bottom_mm + ball + kApproach});
  out.direction = -1.0 * s.frame.z;
  out.reference = s.frame.x;
  out.distance_mm = kApproach;
  out.side = "-z";
  return {{out}, {}};
}

/// The flank of a cone, at the middle of its height, along x and y. A ball of radius b that touches the flank
/// there has its middle at r + (h - d / 2) tan a - b / cos a from the axis, when that is h = d / 2 - b sin a
/// deep; r is the cone's radius at its top, d its depth, a half its angle.
Touches flank(const Piece& w, const FeatureShape& s, Left left, double ball) {
  const double lean = 0.5 * (s.diameter.nominal_mm - s.bottom_diameter_mm) / s.depth_mm;
  const double sine = lean / std::hypot(1.0, lean), cosine = 1.0 / std::hypot(1.0, lean);
  const double z = -0.5 * s.depth_mm + ball * sine;
  const double end = 0.5 * s.diameter.middle() + z * lean - ball / cosine - left.side_mm;
  if (end < kRoom || !within(w.raw, s.frame.to_parent({0.0, 0.0, -0.5 * s.depth_mm})))
    return {{}, ball_text(ball) + " does not touch the flank of its cone freely"};
  Touches out;
  for (const auto& [d, side] : {std::pair(Vec2{1.0, 0.0}, "+x"), std::pair(Vec2{-1.0, 0.0}, "-x"),
                                std::pair(Vec2{0.0, 1.0}, "+y"), std::pair(Vec2{0.0, -1.0}, "-y")}) {
    Touch t;
    t.start = s.frame.to_parent({0.0, 0.0, z});
    t.direction = s.frame.direction_to_parent({d.x, d.y, 0.0});
    t.reference = s.frame.z;
    t.distance_mm = end;
    t.side = side;
    out.touches.push_back(t);
  }
  return out;
}

}  // namespace

Touches touches_of(const Piece& w, const FeatureShape& s, Left left, double ball) {
  // Of a step the floor is touched if it is still to be cut: its one wall has no opposite.
  if (s.kind == ShapeKind::kFace || (s.kind == ShapeKind::kStep && left.bottom_mm > 0.0))
    return level(w, s, left, ball);
  if (s.kind == ShapeKind::kHole && s.bottom_diameter_mm > 0.0 &&
      s.bottom_diameter_mm < s.diameter.nominal_mm - 1e-6)
    return flank(w, s, left, ball);
  if (std::abs(s.slope_rad) > 1e-6 || !s.slot_profile.empty()) return {{}, "its walls are not upright"};
  Asked a{w, s, left, ball, removed(s), {}, {}, true};
  const double off = left.side_mm + ball - kSlack;
  std::vector<std::pair<Vec2, std::string>> axes{{{1.0, 0.0}, "x"}, {{0.0, 1.0}, "y"}};
  bool all = true;
  if (s.kind == ShapeKind::kHole) {
    if (s.bottom_diameter_mm > 0.0 && std::abs(s.bottom_diameter_mm - s.diameter.nominal_mm) > 1e-6)
      return {{}, "its walls are not upright"};
  } else if (s.kind == ShapeKind::kPocket) {
    const auto box = geometry::bounds(s.area);
    a.middle = 0.5 * (box.lo + box.hi);
    all = !s.open;
  } else if (s.kind == ShapeKind::kSlot) {
    if (s.spine.size() != 2 || norm(s.spine[1] - s.spine[0]) < 1e-6)
      return {{}, "only straight slots are measured across"};
    const Vec2 e = s.spine[1] - s.spine[0];
    a.middle = 0.5 * (s.spine[0] + s.spine[1]);
    axes = {{(1.0 / norm(e)) * Vec2{-e.y, e.x}, "its width"}};
  } else if (s.kind == ShapeKind::kOutside && s.islands.size() == 1) {
    a.walls = s.islands.front().area;
    a.inside = false;
    const auto box = geometry::bounds(a.walls);
    a.middle = 0.5 * (box.lo + box.hi);
    const auto raw = transformed(w.raw, inverse(s.frame));
    const Region beside = geometry::subtract(geometry::rectangle({-kFar, -kFar}, {kFar, kFar}),
                                             geometry::rectangle(geometry::xy(raw.lo), geometry::xy(raw.hi)));
    a.space = geometry::offset(geometry::subtract(geometry::unite(removed(s), beside), a.walls), -off);
  } else {
    return {{}, "it has no two walls that face each other"};
  }
  if (a.inside) a.space = geometry::offset(a.walls, -off);
  return across(a, axes, all);
}

}  // namespace capstan::probing

#include "planner/files/from_cad/solid/shadow.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>
#include <tuple>

// A shadow is the union of the triangles that look up. All turn the same way in plan, so that a side of one
// and the same side of its neighbour, run through the other way, cancel: what is left bounds loops that go
// round each place as often as the triangles cover it. Regions unite only these. Thousands of triangles at
// once took them nearly all of the time of a large part.
//
// Source  derived: winding numbers add up over closed loops, and sides that are run through both ways add
// nothing.

namespace capstan::from_cad {
namespace {

using geometry::Loop;
using geometry::Region;

/// Twice the area of a triangle in plan that is still a surface, mm2: below it is a wall, or rounding.
constexpr double kNoAreaMm2 = 1e-9;
/// Points nearer than this are one: far above the rounding of regions, far below what is machined.
constexpr double kSamePointMm = 1e-4;
/// A point that lies on the raw piece's boundary, but for rounding.
constexpr double kOnRawMm = 2e-3;
/// A corner of a mesh lies so near to the carrier of its face.
constexpr double kOnWallMm = 5e-3;

/// Of a side on a flat wall each point lies so near to it: the rounding of regions is below it.
constexpr double kOnFlatMm = 1e-3;

/// The part of a triangle above a height, in plan.
Loop clipped(const std::array<Vec3, 3>& t, double height) {
  Loop out;
  for (std::size_t i = 0; i < 3; ++i) {
    const Vec3 a = t[i];
    const Vec3 b = t[(i + 1) % 3];
    if (a.z >= height) out.push_back(xy(a));
    if ((a.z >= height) != (b.z >= height)) {
      // From the lower to the higher corner, so that neighbours find the same point.
      const Vec3 lo = a.z < b.z ? a : b;
      const Vec3 hi = a.z < b.z ? b : a;
      const double s = (height - lo.z) / (hi.z - lo.z);
      out.push_back(xy(lo + s * (hi - lo)));
    }
  }
  return out;
}

struct TriangleSide {
  Vec2 from, to;
};

bool before(Vec2 a, Vec2 b) { return std::tie(a.x, a.y) < std::tie(b.x, b.y); }

/// A side whichever way it is run through.
struct EitherWay {
  Vec2 low, high;
  std::ptrdiff_t up = 0;  ///< how often from low to high, less how often back
};

/// Without those that are run through both ways.
std::vector<TriangleSide> not_cancelled(std::vector<EitherWay> sides) {
  std::sort(sides.begin(), sides.end(), [](const EitherWay& a, const EitherWay& b) {
    return std::tie(a.low.x, a.low.y, a.high.x, a.high.y) < std::tie(b.low.x, b.low.y, b.high.x, b.high.y);
  });
  std::vector<TriangleSide> out;
  for (std::size_t i = 0; i < sides.size();) {
    const auto [low, high, none] = sides[i];
    std::ptrdiff_t up = 0;
    for (; i < sides.size() && sides[i].low == low && sides[i].high == high; ++i) up += sides[i].up;
    out.insert(out.end(), static_cast<std::size_t>(std::abs(up)),
               up > 0 ? TriangleSide{low, high} : TriangleSide{high, low});
  }
  return out;
}

/// Closed loops of all sides. As many end at each point as begin there, so that a way along them ends where
/// it began.
std::vector<Loop> chained(std::vector<TriangleSide> sides) {
  std::sort(sides.begin(), sides.end(), [](const TriangleSide& a, const TriangleSide& b) {
    return std::tie(a.from.x, a.from.y, a.to.x, a.to.y) < std::tie(b.from.x, b.from.y, b.to.x, b.to.y);
  });
  std::vector<bool> taken(sides.size(), false);
  const auto next_from = [&](Vec2 p) {
    auto i = static_cast<std::size_t>(
        std::lower_bound(sides.begin(), sides.end(), p,
                         [](const TriangleSide& s, Vec2 at) { return before(s.from, at); }) -
        sides.begin());
    while (taken[i]) ++i;
    return i;
  };
  std::vector<Loop> out;
  for (std::size_t first = 0; first < sides.size(); ++first) {
    if (taken[first]) continue;
    Loop loop;
    for (std::size_t i = first;;) {
      taken[i] = true;
      loop.push_back(sides[i].from);
      if (sides[i].to == sides[first].from) break;
      i = next_from(sides[i].to);
    }
    out.push_back(std::move(loop));
  }
  return out;
}

Loop without_doubles(const Loop& loop) {
  Loop out;
  for (const Vec2 p : loop) {
    if (out.empty() || norm(p - out.back()) > kSamePointMm) out.push_back(p);
  }
  while (out.size() > 1 && norm(out.front() - out.back()) <= kSamePointMm) out.pop_back();
  return out;
}

/// Drops points that lie on the line between their neighbours.
Loop straightened(Loop loop) {
  for (bool changed = true; changed && loop.size() > 3;) {
    changed = false;
    Loop out;
    const std::size_t n = loop.size();
    for (std::size_t i = 0; i < n; ++i) {
      const Vec2 a = out.empty() ? loop[n - 1] : out.back();
      const Vec2 b = loop[i];
      const Vec2 c = loop[(i + 1) % n];
      const double off = std::abs(cross(b - a, c - a)) / std::max(norm(c - a), kSamePointMm);
      if (off < kSamePointMm && dot(b - a, c - b) > 0.0) {
        changed = true;
        continue;
      }
      out.push_back(b);
    }
    loop = std::move(out);
  }
  return loop;
}

/// Whether a side of a polygon lies on a flat wall.
bool on_flat(Vec2 a, Vec2 b, const std::vector<FlatWall>& flats) {
  const Vec2 middle = 0.5 * (a + b);
  return std::any_of(flats.begin(), flats.end(), [&](const FlatWall& w) {
    const double length = norm(w.to - w.from);
    if (length < kSamePointMm) return false;
    const Vec2 d = (1.0 / length) * (w.to - w.from);
    const double along = dot(middle - w.from, d);
    const auto off = [&](Vec2 p) { return std::abs(cross(p - w.from, d)); };
    return along > 0.0 && along < length && std::max({off(a), off(middle), off(b)}) < kOnFlatMm;
  });
}

/// Which round wall a side of a polygon is a chord of.
std::optional<std::size_t> wall_of(Vec2 a, Vec2 b, const std::vector<RoundWall>& walls, double chord_mm) {
  const double half = 0.5 * norm(b - a);
  for (std::size_t i = 0; i < walls.size(); ++i) {
    const RoundWall& w = walls[i];
    if (half > w.radius_mm + kOnWallMm) continue;
    if (std::abs(norm(a - w.centre) - w.radius_mm) > kOnWallMm) continue;
    if (std::abs(norm(b - w.centre) - w.radius_mm) > kOnWallMm) continue;
    const double short_of = w.radius_mm - std::sqrt(std::max(0.0, w.radius_mm * w.radius_mm - half * half));
    if (short_of <= chord_mm) return i;
  }
  return std::nullopt;
}

double turn(Vec2 centre, Vec2 a, Vec2 b) {
  return std::atan2(cross(a - centre, b - centre), dot(a - centre, b - centre));
}

}  // namespace

Region shadow_above(const geometry::Mesh& mesh, const std::vector<bool>& leave_out,
                    const geometry::Placement& frame, double height_mm) {
  std::vector<EitherWay> sides;
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    if (!leave_out.empty() && leave_out[i]) continue;
    std::array<Vec3, 3> t;
    for (std::size_t k = 0; k < 3; ++k) t[k] = frame.to_local(mesh.vertices[mesh.triangles[i][k]]);
    if (cross(xy(t[1]) - xy(t[0]), xy(t[2]) - xy(t[0])) < kNoAreaMm2) continue;
    if (std::max({t[0].z, t[1].z, t[2].z}) <= height_mm) continue;
    const Loop loop = clipped(t, height_mm);
    if (loop.size() < 3 || !(geometry::signed_area(loop) > 0.5 * kNoAreaMm2)) continue;
    for (std::size_t k = 0; k < loop.size(); ++k) {
      const Vec2 from = loop[k], to = loop[(k + 1) % loop.size()];
      if (from == to) continue;
      sides.push_back(before(from, to) ? EitherWay{from, to, 1} : EitherWay{to, from, -1});
    }
  }
  const std::vector<Loop> loops = chained(not_cancelled(std::move(sides)));
  return loops.empty() ? Region{} : geometry::clean(loops);
}

geometry::Mesh mesh_of(const geometry::Box3& box) {
  geometry::Mesh out;
  for (int i = 0; i < 8; ++i) {
    out.vertices.push_back({(i & 1) != 0 ? box.hi.x : box.lo.x, (i & 2) != 0 ? box.hi.y : box.lo.y,
                            (i & 4) != 0 ? box.hi.z : box.lo.z});
  }
  out.triangles = {{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
                   {2, 6, 7}, {2, 7, 3}, {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
  return out;
}

std::vector<Piece> pieces_of(const Loop& loop, const Region& raw, const std::vector<RoundWall>& walls,
                             double chord_mm, const std::vector<FlatWall>& flats) {
  const Loop points = straightened(without_doubles(loop));
  const std::size_t n = points.size();
  if (n < 3) return {};
  struct Side {
    Vec2 from, to;
    std::optional<std::size_t> wall;
    bool open = false;
  };
  std::vector<Side> sides;
  for (std::size_t i = 0; i < n; ++i) {
    Side s{points[i], points[(i + 1) % n], {}, false};
    const Vec2 middle = 0.5 * (s.from + s.to);
    s.open = true;
    for (const Vec2 p : {s.from, middle, s.to})
      s.open = s.open && geometry::distance_to_boundary(raw, p) < kOnRawMm;
    if (!s.open && !on_flat(s.from, s.to, flats)) s.wall = wall_of(s.from, s.to, walls, chord_mm);
    sides.push_back(s);
  }
  // Begins where one piece ends, so that none is cut in two.
  const auto goes_on = [&](std::size_t i) {
    const Side& a = sides[(i + n - 1) % n];
    const Side& b = sides[i % n];
    return a.wall && b.wall && *a.wall == *b.wall;
  };
  std::size_t first = 0;
  while (first < n && goes_on(first)) ++first;
  if (first == n) {
    const RoundWall& w = walls[*sides.front().wall];
    const double sign = geometry::signed_area(points) > 0.0 ? 1.0 : -1.0;
    Piece whole{points.front(), points.front(), w.centre, w.radius_mm, sign * 2.0 * std::numbers::pi, false};
    return {whole};
  }
  std::vector<Piece> out;
  for (std::size_t k = 0; k < n;) {
    const std::size_t i = (first + k) % n;
    Piece p{sides[i].from, sides[i].to, {}, 0.0, 0.0, sides[i].open};
    ++k;
    if (sides[i].wall) {
      const RoundWall& w = walls[*sides[i].wall];
      p.centre = w.centre;
      p.radius_mm = w.radius_mm;
      p.sweep_rad = turn(w.centre, p.from, p.to);
      for (; k < n && goes_on(first + k); ++k) {
        const Side& next = sides[(first + k) % n];
        p.sweep_rad += turn(w.centre, next.from, next.to);
        p.to = next.to;
      }
    }
    out.push_back(p);
  }
  return out;
}

}  // namespace capstan::from_cad

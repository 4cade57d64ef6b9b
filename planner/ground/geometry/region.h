#pragma once

#include <vector>

#include "planner/ground/geometry/vec.h"

namespace capstan::geometry {

/// A closed polygon: the last point joins the first, which is not repeated.
using Loop = std::vector<Vec2>;

/// A plane area with holes, mm. Outer loops run counter-clockwise, holes clockwise; loops do not cross.
/// What the functions below return always keeps that; `clean` makes it so from any loops (non-zero rule).
struct Region {
  std::vector<Loop> loops;
  [[nodiscard]] bool empty() const { return loops.empty(); }
};

/// Clipper works on integers: coordinates are rounded to this grid, mm.
inline constexpr double kRegionGrid = 1e-6;
/// Largest coordinate a region may have, mm (keeps Clipper within its range).
inline constexpr double kRegionLimit = 1e6;

[[nodiscard]] Region clean(const std::vector<Loop>& loops);
[[nodiscard]] Region unite(const Region& a, const Region& b);
[[nodiscard]] Region intersect(const Region& a, const Region& b);
[[nodiscard]] Region subtract(const Region& a, const Region& b);
/// Grown (delta > 0) or shrunk by delta with round corners; no point of the result is nearer to the old
/// boundary than |delta| - kRegionGrid (ten of it from 500 vertices on): arcs are approximated on the side
/// away from it by up to arc_tolerance_mm; of 500 vertices and more, in steps and by up to 1.5 times that
/// (offset/raw_offset.h).
[[nodiscard]] Region offset(const Region& a, double delta_mm, double arc_tolerance_mm = 0.001);
/// As `offset`, with the corners kept sharp (mitred) that the boundary would go round: outer corners when
/// growing, inner ones when shrinking; not beyond kMitreLimit times delta from a vertex.
[[nodiscard]] Region offset_sharp(const Region& a, double delta_mm);
inline constexpr double kMitreLimit = 2.0;
/// The separate pieces: one outer loop with its holes each, ordered by (area descending, position).
[[nodiscard]] std::vector<Region> pieces(const Region& a);

[[nodiscard]] double signed_area(const Loop& loop);    ///< positive: counter-clockwise; mm2
[[nodiscard]] double area(const Region& a);            ///< holes subtracted; mm2
[[nodiscard]] bool contains(const Region& a, Vec2 p);  ///< boundary counts as inside
/// Distance from p to the nearest boundary point, mm; 1e300 for an empty region.
[[nodiscard]] double distance_to_boundary(const Region& a, Vec2 p);
/// How far the boundary would have to be moved with sharp corners (`offset_sharp`) to come to p, which is
/// beside the area: the distance to a side, and about a corner to the farther one of its two sides' lines.
[[nodiscard]] double mitred_distance(const Loop& loop, Vec2 p);
[[nodiscard]] double mitred_distance(const Region& a, Vec2 p);
/// Whether the boundary turns away from the area somewhere by more than what chords of an arc do: a corner
/// that `offset` goes round when it shrinks the area.
[[nodiscard]] bool has_sharp_inner_corner(const Region& a);
struct Box2 {
  Vec2 lo{1e300, 1e300};
  Vec2 hi{-1e300, -1e300};
};
[[nodiscard]] Box2 bounds(const Region& a);

[[nodiscard]] Region rectangle(Vec2 lo, Vec2 hi);
/// Corners rounded by `corner_radius_mm` (0: sharp).
[[nodiscard]] Region rounded_rectangle(Vec2 lo, Vec2 hi, double corner_radius_mm,
                                       double tolerance_mm = 0.001);
[[nodiscard]] Region disc(Vec2 centre, double radius_mm, double tolerance_mm = 0.001);
/// Points of the arc from `start` around `centre` by `sweep_rad` (positive counter-clockwise), start
/// excluded, end included, chord error at most tolerance.
void append_arc(Loop& out, Vec2 centre, Vec2 start, double sweep_rad, double tolerance_mm);
/// The band of width 2 r around an open polyline.
[[nodiscard]] Region stroke(const std::vector<Vec2>& line, double half_width_mm, bool round_ends,
                            double arc_tolerance_mm = 0.001);

}  // namespace capstan::geometry

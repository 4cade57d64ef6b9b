#include <cmath>
#include <numbers>

#include "planner/ground/base/file.h"
#include "tests/removal/parts.h"
#include "tests/support/corpus.h"

namespace capstan::testing::removal {
namespace {

constexpr double kOver = 2.0;

// A drilled hole whose full diameter reaches to z0, below it a cone of this full angle.
Depth drilled(double x, double y, double diameter, double z0, double angle_deg, double top = kOver) {
  const double r = 0.5 * diameter;
  const double tip = r / std::tan(0.5 * angle_deg * std::numbers::pi / 180.0);
  return either({cylinder(x, y, r, z0, top), cone(x, y, z0 - tip, 0, z0 + 0.01, r * (1 + 0.01 / tip))});
}

}  // namespace

// 56 x 20 mm: a drilled hole of 6 mm, full to 8 mm; a flat one of 10 mm, 6 mm deep; one of 8 mm that ends in
// a half sphere 9 mm deep; one of 5 mm through.
Part single_holes() {
  const Box b = block(56, 20, 16);
  Drawing d("SINGLE HOLES", b);
  d.hole("DRILLED", d.placement({8, 10, 0}), 8, 6, d.conical_bottom(118));
  d.hole("FLAT", d.placement({21, 10, 0}), 6, 10, d.flat_bottom());
  d.hole("SPHERICAL", d.placement({36, 10, 0}), 9, 8, d.spherical_bottom(4));
  d.hole("THROUGH", d.placement({49, 10, 0}), 16, 5, d.through_bottom());
  Target t(body(b));
  t.cut(drilled(8, 10, 6, -8, kBluntestDeg), drilled(8, 10, 6, -8, 118));
  t.cut(cylinder(21, 10, 5, -6, kOver));
  t.cut(either({cylinder(36, 10, 4, -5, kOver), sphere({36, 10, -5}, 4)}));
  t.cut(cylinder(49, 10, 2.5, -18, kOver));
  return {"single_holes", d.text(), b, t};
}

// 50 x 36 mm: compounds placed away from the origin, their elements relative to them. A counterbored hole (11
// mm, 6 mm deep, on 6.6 mm through), a countersunk one (9 mm to 5 mm at 90 degrees on 5 mm through), and a
// stepped one.
Part compound_holes() {
  const Box b = block(50, 36, 16);
  Drawing d("COMPOUND HOLES", b);
  const auto origin = d.placement({0, 0, 0});
  const auto bore = d.hole("BORE", origin, 6, 11, d.flat_bottom());
  const auto core = d.hole("CORE", d.placement({0, 0, -6}), 10, 6.6, d.through_bottom());
  d.compound("SCREW", d.placement({10, 10, 0}), {bore, core}, "COUNTERBORE_HOLE");
  const auto plain = d.hole("PLAIN", origin, 16, 5, d.through_bottom());
  const auto sink = d.hole("SINK", origin, 2, 9, d.through_bottom(), d.angle_taper(45));
  d.compound("SUNK", d.placement({38, 10, 0}), {plain, sink}, "COUNTERSUNK_HOLE");
  const auto wide = d.hole("WIDE", origin, 3, 14, d.flat_bottom());
  const auto middle = d.hole("MIDDLE", d.placement({0, 0, -3}), 4, 10, d.flat_bottom());
  const auto deep = d.hole("DEEP", d.placement({0, 0, -7}), 5, 4, d.conical_bottom(118));
  d.compound("STEPPED", d.placement({24, 25, 0}), {deep, wide, middle});
  Target t(body(b));
  t.cut(cylinder(10, 10, 5.5, -6, kOver));
  t.cut(cylinder(10, 10, 3.3, -18, kOver));
  t.cut(cylinder(38, 10, 2.5, -18, kOver));
  t.cut(cone(38, 10, -2, 2.5, 0.2, 4.7));
  t.cut(cylinder(24, 25, 7, -3, kOver));
  t.cut(cylinder(24, 25, 5, -7, kOver));
  t.cut(drilled(24, 25, 4, -12, kBluntestDeg), drilled(24, 25, 4, -12, 118));
  return {"compound_holes", d.text(), b, t};
}

// 24 x 24 mm: M6, its core of 5 mm full to 17 mm, the thread 12 mm deep; in front of it nothing else.
Part threaded_hole() {
  const Box b = block(24, 24, 24);
  Drawing d("THREADED HOLE", b);
  const auto at = d.placement({12, 12, 0});
  const auto core = d.hole_of("CORE", at, 17, d.length(5, 0.15, 0.05), d.conical_bottom(118));
  d.thread("M6", at, 12, core, 6, 1);
  Target t(body(b));
  // The flanks lie anywhere between core and 6 mm; a tap runs on by its chamfer.
  t.cut(drilled(12, 12, 5, -17, kBluntestDeg),
        either({drilled(12, 12, 5.1, -17, 118), cylinder(12, 12, 3.05, -16, kOver)}));
  return {"threaded_hole", d.text(), b, t};
}

// 60 x 40 mm: four holes of 4 mm on a circle of 20 mm about (15, 20); 3 x 2 holes of 3 mm, 6 and 8 mm apart,
// from (32, 6); and a counterbored hole, 8 mm wide and 3 mm deep on 4.5 mm through, at (34, 32), copied to
// the right by 16 mm.
Part hole_patterns() {
  const Box b = block(60, 40, 10);
  Drawing d("HOLE PATTERNS", b);
  const auto through = d.through_bottom();
  const auto on_circle = d.hole("ON CIRCLE", d.placement({10, 0, 0}), 10, 4, through);
  d.circular_pattern("CIRCLE", d.placement({15, 20, 0}), on_circle, 90, 4, 20);
  const auto in_row = d.hole("IN ROW", d.placement({0, 0, 0}), 10, 3, through);
  d.rectangular_pattern("ROWS", d.placement({32, 6, 0}), in_row, 6, {1, 0, 0}, 3, 2, 8, {0, 1, 0});
  const auto bore = d.hole("BORE", d.placement({0, 0, 0}), 3, 8, d.flat_bottom());
  const auto core = d.hole("CORE", d.placement({0, 0, -3}), 7, 4.5, through);
  const auto screw = d.compound("SCREW", d.placement({0, 0, 0}), {bore, core}, "COUNTERBORE_HOLE");
  d.general_pattern("SCREWS", d.placement({34, 32, 0}), screw, {d.placement({16, 0, 0})});
  Target t(body(b));
  for (const auto& [x, y] : {std::pair{25.0, 20.0}, {15.0, 30.0}, {5.0, 20.0}, {15.0, 10.0}})
    t.cut(cylinder(x, y, 2, -12, kOver));
  for (const double x : {32.0, 38.0, 44.0}) {
    for (const double y : {6.0, 14.0}) t.cut(cylinder(x, y, 1.5, -12, kOver));
  }
  for (const double x : {34.0, 50.0}) {
    t.cut(cylinder(x, 32, 4, -3, kOver));
    t.cut(cylinder(x, 32, 2.25, -12, kOver));
  }
  return {"hole_patterns", d.text(), b, t};
}

// 60 x 40 mm: a pocket of 30 x 24 mm, R4, 10 mm deep; in its floor, 4 mm from a wall, a hole of 5 mm, 8 mm
// deep; on the land 4 mm beside the pocket another one.
Part holes_near_walls() {
  const Box b = block(60, 40, 26);
  Drawing d("HOLES NEAR WALLS", b);
  d.closed_pocket("POCKET", d.placement({22, 20, 0}), 10, d.rectangle(30, 24), 4);
  d.hole("IN FLOOR", d.placement({33, 20, -10}), 8, 5, d.conical_bottom(118));
  d.hole("ON LAND", d.placement({41, 20, 0}), 12, 5, d.conical_bottom(118));
  Target t(body(b));
  t.cut(prism(rounded_rectangle(7, 8, 37, 32, 4), -10, kOver));
  t.cut(drilled(33, 20, 5, -18, kBluntestDeg, -9), drilled(33, 20, 5, -18, 118, -9));
  t.cut(drilled(41, 20, 5, -12, kBluntestDeg), drilled(41, 20, 5, -12, 118));
  return {"holes_near_walls", d.text(), b, t};
}

// The shipped example, 90 x 60 x 30 mm, cut from both sides.
Part turned_over() {
  const Box b = block(90, 60, 30);
  Target t(body(b));
  t.cut(prism(rounded_rectangle(25, 16, 65, 40, 6), -10, kOver));
  t.cut(box({-kOver, 46, -5}, {92, 54, kOver}));
  t.cut(prism(rounded_rectangle(30, 18, 60, 38, 5), -32, -24));
  for (const double x : {12.0, 78.0}) {
    t.cut(cylinder(x, 30, 3.3, -32, kOver));
    t.cut(cylinder(x, 30, 5.5, -32, -23.5));
  }
  Part p{"turned_over", read_file(capstan::testing::source_dir() + "/examples/two_setups.p21").value_or(""),
         b, t};
  p.grid = {0.5, 0.2, 0.15};
  return p;
}

// 24 x 24 mm, 17 deep: a core of 3 mm whose edge is a cone of 5 mm. Of countersinks of 90 degrees only those
// up to 12.4 mm have a flat tip that goes into the core.
Part small_countersink() {
  const Box b = block(24, 24, 17);
  Drawing d("SMALL COUNTERSINK", b);
  const auto origin = d.placement({0, 0, 0});
  const auto core = d.hole("CORE", origin, 17, 3, d.through_bottom());
  const auto sink = d.hole("SINK", origin, 1, 5, d.through_bottom(), d.angle_taper(45));
  d.compound("SUNK", d.placement({12, 12, 0}), {core, sink}, "COUNTERSUNK_HOLE");
  Target t(body(b));
  t.cut(cylinder(12, 12, 1.45, -19, 2), cylinder(12, 12, 1.55, -19, 2));
  t.cut(cone(12, 12, -1, 1.5, 0.2, 2.7));
  return {"small_countersink", d.text(), b, t};
}

}  // namespace capstan::testing::removal

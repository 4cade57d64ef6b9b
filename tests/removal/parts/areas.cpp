#include <numbers>

#include "tests/removal/parts.h"

// Faces, pockets, steps and outsides.

namespace capstan::testing::removal {
namespace {

constexpr double kOver = 2.0;  // mm that a hollow stands out of the block, where it is open

}  // namespace

// 50 x 40 mm: 1 mm of face, a pocket of 36 x 26 mm with corners R4, 6 mm deep, in it an island of 10 mm.
Part island_pocket() {
  const Box b = block(50, 40, 12, 1);
  Drawing d("ISLAND POCKET", b);
  d.face("TOP", 0, 0, 50, 40, 1, 1);
  const auto island = d.boss("ISLAND", d.placement({32, 20, 0}), 6, d.circle(10));
  d.closed_pocket("POCKET", d.placement({25, 20, 0}), 6, d.rectangle(36, 26), 4, {island});
  Target t(body(b));
  t.cut(prism(without(rounded_rectangle(7, 7, 43, 33, 4), disc(32, 20, 5)), -6, kOver));
  return {"island_pocket", d.text(), b, t};
}

// 60 x 40 mm: 5 mm are faced off around a boss of 14 x 20 mm, R3; beside it a pocket of 22 x 20 mm, 6 mm
// deep.
Part boss_beside_pocket() {
  const Box b = block(60, 40, 14, 5);
  Drawing d("BOSS BESIDE POCKET", b);
  std::vector<Drawing::Id> outline;
  const auto side = [&](Point from, Point to) { outline.push_back(d.polyline({from, to})); };
  const auto corner = [&](Point c, double from) { outline.push_back(d.arc(c, 3, from, from + 90, true)); };
  side({-4, -10, 0}, {4, -10, 0});
  corner({4, -7, 0}, 270);
  side({7, -7, 0}, {7, 7, 0});
  corner({4, 7, 0}, 0);
  side({4, 10, 0}, {-4, 10, 0});
  corner({-4, 7, 0}, 90);
  side({-7, 7, 0}, {-7, -7, 0});
  corner({-4, -7, 0}, 180);
  std::vector<std::pair<Drawing::Id, bool>> segments;
  for (const auto id : outline) segments.emplace_back(id, true);
  const auto boss = d.boss("BOSS", d.placement({12, 20, 5}), 5, d.closed(d.composite(segments)));
  d.face("TOP", 0, 0, 60, 40, 5, 5, {boss});
  d.closed_pocket("POCKET", d.placement({40, 20, 0}), 6, d.rectangle(22, 20), 4);
  Target t(either({body(b), prism(rounded_rectangle(5, 10, 19, 30, 3), -1, 5)}));
  t.cut(prism(rounded_rectangle(29, 10, 51, 30, 4), -6, kOver));
  return {"boss_beside_pocket", d.text(), b, t};
}

// 50 x 40 mm: a pocket that opens at the front, 30 wide, 22 long, corners R6, 5 mm deep.
Part open_pocket() {
  const Box b = block(50, 40, 12);
  Drawing d("OPEN POCKET", b);
  const auto curve = d.composite({{d.polyline({{0, 0, 0}, {0, 16, 0}}), true},
                                  {d.arc({6, 16, 0}, 6, 180, 90, false), true},
                                  {d.polyline({{6, 22, 0}, {24, 22, 0}}), true},
                                  {d.arc({24, 16, 0}, 6, 90, 0, false), true},
                                  {d.polyline({{30, 16, 0}, {30, 0, 0}}), true}});
  d.open_pocket("POCKET", d.placement({10, 0, 0}), 5, d.open(curve), 6);
  Target t(body(b));
  t.cut(prism(both(rounded_rectangle(10, -20, 40, 22, 6), rectangle(0, -kOver, 50, 40)), -5, kOver));
  return {"open_pocket", d.text(), b, t};
}

// 50 x 40 mm: the right side is taken down by 6 mm over x = 38 to 50, but from y = 8 to 32 only. Its inner
// corners are drawn sharp: up to R6 may stay in them, a quarter of the length.
Part short_step() {
  const Box b = block(50, 40, 14);
  Drawing d("SHORT STEP", b);
  d.step("STEP", d.placement({38, 8, 0}), 6, 24, {0, 1, 0});
  Target t(body(b));
  t.cut(prism(rounded_rectangle(38, 8, 70, 32, 6), -6, kOver), prism(rectangle(38, 8, 52, 32), -6, kOver));
  return {"short_step", d.text(), b, t};
}

// 200 x 40 mm: all that lies beyond x = 30 goes, 6 mm deep: 170 mm.
Part wide_step() {
  const Box b = block(200, 40, 20);
  Drawing d("WIDE STEP", b);
  d.step("STEP", d.placement({30, 0, 0}), 6, 40, {0, 1, 0});
  Target t(body(b));
  t.cut(prism(rectangle(30, -kOver, 202, 42), -6, kOver));
  return {"wide_step", d.text(), b, t};
}

// 60 x 40 mm: a face of 30 mm along x beside one wall (at x = 30), two (at y = 30, too) or three (at x = 10,
// too). Its inner corners are drawn sharp: up to R3 may stay in them, or a sixth of the depth.
Part face_beside_walls(int walls, double height) {
  const Box b = block(60, 40, 12, height);
  Drawing d("FACE BESIDE WALLS " + std::to_string(walls), b);
  const double x0 = walls == 3 ? 10.0 : 0.0, x1 = x0 + 30.0, y1 = walls == 1 ? 40.0 : 30.0;
  d.face("FACE", x0, 0, x1 - x0, y1, height, height);
  Target t(box(b.lo, b.hi));
  const double r = walls == 1 ? 0.0 : std::max(3.0, height / 6.0);
  const double left = walls == 3 ? x0 : -40.0, back = walls == 1 ? 80.0 : y1;
  t.cut(prism(rounded_rectangle(left, -40, x1, back, r), 0, height + kOver),
        prism(rectangle(left, -40, x1, back), 0, height + kOver));
  return {"face_beside_walls", d.text(), b, t};
}

// 60 x 50 mm: a face of 40 mm along x, 5 mm deep, beside a wall at x = 40; it lists a boss of 14 mm at
// (20, 25), which keeps 13 mm to the wall.
Part face_with_boss_beside_wall() {
  const Box b = block(60, 50, 20, 5);
  Drawing d("FACE WITH BOSS BESIDE WALL", b);
  const auto boss = d.boss("BOSS", d.placement({20, 25, 5}), 5, d.circle(14));
  d.face("FACE", 0, 0, 40, 50, 5, 5, {boss});
  Target t(box(b.lo, b.hi));
  t.cut(prism(without(rectangle(-40, -40, 40, 90), disc(20, 25, 7)), 0, 5 + kOver));
  return {"face_with_boss_beside_wall", d.text(), b, t};
}

// 60 x 50 mm: along the left edge a face of 2 mm, 5 mm deep, and at x = 40 to 46 another one, as deep.
Part face_at_the_edge_and_narrow_face() {
  const Box b = block(60, 50, 20, 5);
  Drawing d("FACE AT THE EDGE AND NARROW FACE", b);
  d.face("EDGE", 0, 0, 2, 50, 5, 5);
  d.face("NARROW", 40, 0, 6, 50, 5, 5);
  Target t(box(b.lo, b.hi));
  for (const auto& [x0, x1] : {std::pair(-40, 2), std::pair(40, 46)})
    t.cut(box({static_cast<double>(x0), -40, 0}, {static_cast<double>(x1), 90, 5 + kOver}));
  return {"face_at_the_edge_and_narrow_face", d.text(), b, t};
}

// 60 x 50 mm: a face of 30 mm along x, 5 mm deep, and one from x = 20 on, 2 mm deep, both from the raw top.
Part deeper_face_over_a_shallow_one() {
  const Box b = block(60, 50, 20, 5);
  Drawing d("DEEPER FACE OVER A SHALLOW ONE", b);
  d.face("DEEP", 0, 0, 30, 50, 5, 5);
  d.face("SHALLOW", 20, 0, 40, 50, 5, 2);
  Target t(box(b.lo, {60, 50, 3}));
  t.cut(box({-40, -40, 0}, {30, 90, 5 + kOver}));
  return {"deeper_face_over_a_shallow_one", d.text(), b, t};
}

// 50 x 40 mm: around a contour of 40 x 30 mm, R5, everything is taken away, 5 mm deep.
Part outside_contour() {
  const Box b = block(50, 40, 14);
  Drawing d("OUTSIDE CONTOUR", b);
  const auto curve = d.composite({{d.polyline({{-15, -15, 0}, {15, -15, 0}}), true},
                                  {d.arc({15, -10, 0}, 5, 270, 360, true), true},
                                  {d.polyline({{20, -10, 0}, {20, 10, 0}}), true},
                                  {d.arc({15, 10, 0}, 5, 0, 90, true), true},
                                  {d.polyline({{15, 15, 0}, {-15, 15, 0}}), true},
                                  {d.arc({-15, 10, 0}, 5, 90, 180, true), true},
                                  {d.polyline({{-20, 10, 0}, {-20, -10, 0}}), true},
                                  {d.arc({-15, -10, 0}, 5, 180, 270, true), true}});
  d.outside("OUTSIDE", d.placement({25, 20, 0}), 5, d.closed(curve));
  Target t(body(b));
  t.cut(prism(without(rectangle(-kOver, -kOver, 52, 42), rounded_rectangle(5, 5, 45, 35, 5)), -5, kOver));
  return {"outside_contour", d.text(), b, t};
}

// 50 x 40 mm: a pocket drawn as a composite curve, 30 x 22 mm with corners R5, 5 mm deep; its arc at the
// lower right runs from 270 to 0 degrees, or clockwise from 0 to 270.
Part arcs_across_zero(bool clockwise) {
  const Box b = block(50, 40, 12);
  Drawing d(clockwise ? "ARCS CLOCKWISE" : "ARCS ACROSS ZERO", b);
  std::vector<std::pair<Drawing::Id, bool>> s;
  const auto line = [&](Point from, Point to) {
    s.emplace_back(clockwise ? d.polyline({to, from}) : d.polyline({from, to}), true);
  };
  const auto arc = [&](Point c, double from, double to) {
    s.emplace_back(clockwise ? d.arc(c, 5, to, from, false) : d.arc(c, 5, from, to, true), true);
  };
  line({-10, -11, 0}, {10, -11, 0});
  arc({10, -6, 0}, 270, 0);
  line({15, -6, 0}, {15, 6, 0});
  arc({10, 6, 0}, 0, 90);
  line({10, 11, 0}, {-10, 11, 0});
  arc({-10, 6, 0}, 90, 180);
  line({-15, 6, 0}, {-15, -6, 0});
  arc({-10, -6, 0}, 180, 270);
  if (clockwise) std::reverse(s.begin(), s.end());
  d.closed_pocket("POCKET", d.placement({25, 20, 0}), 5, d.closed(d.composite(s)), 0);
  Target t(body(b));
  t.cut(prism(rounded_rectangle(10, 9, 40, 31, 5), -5, kOver));
  return {clockwise ? "arcs_clockwise" : "arcs_across_zero", d.text(), b, t};
}

// 50 x 40 mm: a pocket of 26 x 20 mm, R5, 6 mm deep, and a hole of 8 mm through; the edges of both are
// chamfered by 1 mm at 45 degrees.
Part chamfered_edges() {
  const Box b = block(50, 40, 12);
  Drawing d("CHAMFERED EDGES", b);
  const auto pocket = d.closed_pocket("POCKET", d.placement({18, 20, 0}), 6, d.rectangle(26, 20), 5);
  const auto hole = d.hole("HOLE", d.placement({41, 20, 0}), 12, 8, d.through_bottom());
  d.chamfer("POCKET EDGE", pocket, pocket, 45, 1);
  d.chamfer("HOLE EDGE", hole, hole, 45, 1);
  Target t(body(b));
  const Depth2 outline = rounded_rectangle(5, 10, 31, 30, 5);
  t.cut(prism(outline, -6, kOver));
  // The outline grows by as much as the chamfer has risen.
  t.cut([outline](const Point& p) {
    const double side = (outline(p.x, p.y) + 1.0 + p.z) / std::numbers::sqrt2;
    return std::min(side, std::min(p.z + 1.0, kOver - p.z));
  });
  t.cut(cylinder(41, 20, 4, -14, kOver));
  t.cut(cone(41, 20, -1, 4, 0.2, 5.2));
  return {"chamfered_edges", d.text(), b, t};
}

}  // namespace capstan::testing::removal

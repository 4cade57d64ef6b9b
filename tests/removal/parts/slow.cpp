#include <cmath>

#include "tests/removal/parts.h"

// Parts that once took minutes to plan: helices looked at in exact sections, holes one in the other, what is
// deeper than its piece, what crosses tiles askew, what hangs over an edge.

namespace capstan::testing::removal {
namespace {

constexpr double kOver = 2.0;  // mm that a hollow stands out of the block, where it is open

}  // namespace

// 30 x 30 x 30 mm: a flat hole of 8 mm H7, 10 mm deep, in the middle.
Part tight_flat_hole() {
  const Box b = block(30, 30, 30);
  Drawing d("TIGHT FLAT HOLE", b);
  d.hole_of("HOLE", d.placement({15, 15, 0}), 10, d.length(8, 0.015, 0.0), d.flat_bottom());
  Target t(body(b));
  t.cut(cylinder(15, 15, 4.0, -10, kOver), cylinder(15, 15, 4.0075, -10, kOver));
  return {"tight_flat_hole", d.text(), b, t};
}

// 40 x 30 mm: two flat holes of 10 mm, 5 mm deep, their axes 4 mm apart.
Part overlapping_flat_holes() {
  const Box b = block(40, 30, 20);
  Drawing d("OVERLAPPING FLAT HOLES", b);
  d.hole("LEFT", d.placement({18, 15, 0}), 5, 10, d.flat_bottom());
  d.hole("RIGHT", d.placement({22, 15, 0}), 5, 10, d.flat_bottom());
  Target t(body(b));
  t.cut(cylinder(18, 15, 5, -5, kOver));
  t.cut(cylinder(22, 15, 5, -5, kOver));
  return {"overlapping_flat_holes", d.text(), b, t};
}

// 100 x 80 x 30 mm: a pocket of 70 x 50 mm, 35 mm deep with a floor.
Part pocket_deeper_than_its_piece() {
  const Box b = block(100, 80, 30);
  Drawing d("TOO DEEP", b);
  d.closed_pocket("POCKET", d.placement({50, 40, 0}), 35, d.rectangle(70, 50), 12);
  return {"pocket_deeper_than_its_piece", d.text(), b, Target(body(b))};
}

// 80 x 60 mm: a slot of 10 mm, 5 mm deep, 60 mm along (0.8, 0.6), round at both ends.
Part tilted_slot() {
  const Box b = block(80, 60, 15);
  Drawing d("TILTED SLOT", b);
  d.slot("SLOT", d.placement({16, 12, 0}), 5, d.linear_path(60, {0.8, 0.6, 0}), d.square_u(10), "radiused",
         "radiused");
  Target t(body(b));
  t.cut(prism(stroke({{16, 12}, {64, 48}}, 10), -5, kOver));
  return {"tilted_slot", d.text(), b, t};
}

// 60 x 60 mm: a flat hole of 10 mm whose axis stands 1 mm outside the left side.
Part hole_over_the_side() {
  const Box b = block(60, 60, 20);
  Drawing d("OVER THE SIDE", b);
  d.hole("HOLE", d.placement({-1, 30, 0}), 6, 10, d.flat_bottom());
  Target t(body(b));
  t.cut(cylinder(-1, 30, 5, -6, kOver));
  return {"hole_over_the_side", d.text(), b, t};
}

// 60 x 50 mm: 4 mm are faced off around a boss of 14 mm; at the front a pocket opens, 20 wide, 18 long.
Part open_pocket_beside_boss() {
  const Box b = block(60, 50, 16, 4);
  Drawing d("OPEN POCKET BESIDE BOSS", b);
  const auto boss = d.boss("BOSS", d.placement({14, 34, 4}), 4, d.circle(14));
  d.face("TOP", 0, 0, 60, 50, 4, 4, {boss});
  const auto curve = d.composite({{d.polyline({{0, 0, 0}, {0, 12, 0}}), true},
                                  {d.arc({6, 12, 0}, 6, 180, 90, false), true},
                                  {d.polyline({{6, 18, 0}, {14, 18, 0}}), true},
                                  {d.arc({14, 12, 0}, 6, 90, 0, false), true},
                                  {d.polyline({{20, 12, 0}, {20, 0, 0}}), true}});
  d.open_pocket("POCKET", d.placement({30, 0, 0}), 5, d.open(curve), 6);
  Target t(either({body(b), cylinder(14, 34, 7, -1, 4)}));
  t.cut(prism(both(rounded_rectangle(30, -20, 50, 18, 6), rectangle(0, -kOver, 60, 50)), -5, kOver));
  return {"open_pocket_beside_boss", d.text(), b, t};
}

}  // namespace capstan::testing::removal

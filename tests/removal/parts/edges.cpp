#include <cmath>

#include "tests/removal/parts.h"

// Features at and over the edges of the raw piece, and above each other.

namespace capstan::testing::removal {
namespace {

constexpr double kOver = 2.0;

}  // namespace

// 50 x 40 mm: a flat hole of 20 mm, 5 mm deep, whose circle runs 4 mm out over the right side.
Part hole_over_an_edge() {
  const Box b = block(50, 40, 14);
  Drawing d("HOLE OVER AN EDGE", b);
  d.hole("HOLE", d.placement({44, 20, 0}), 5, 20, d.flat_bottom());
  Target t(body(b));
  t.cut(cylinder(44, 20, 10, -5, kOver));
  return {"hole_over_an_edge", d.text(), b, t};
}

// 50 x 40 mm: a closed pocket of 24 x 20 mm, R4, 5 mm deep, that runs 8 mm out over the right side.
Part pocket_over_an_edge() {
  const Box b = block(50, 40, 14);
  Drawing d("POCKET OVER AN EDGE", b);
  d.closed_pocket("POCKET", d.placement({46, 20, 0}), 5, d.rectangle(24, 20), 4);
  Target t(body(b));
  t.cut(prism(rounded_rectangle(34, 10, 58, 30, 4), -5, kOver));
  return {"pocket_over_an_edge", d.text(), b, t};
}

// 50 x 40 mm: nothing but a boss, round with 24 mm and 5 mm high, or 24 x 20 mm and 8 mm high.
Part lone_boss(bool round) {
  const Box b = block(50, 40, 14);
  Drawing d(round ? "LONE ROUND BOSS" : "LONE SQUARE BOSS", b);
  const double high = round ? 5 : 8;
  d.boss("BOSS", d.placement({25, 20, 0}), high, round ? d.circle(24) : d.rectangle(24, 20));
  Target t(body(b));
  const Depth2 outline = round ? disc(25, 20, 12) : rectangle(13, 10, 37, 30);
  t.cut(prism(without(rectangle(-kOver, -kOver, 52, 42), outline), -high, kOver));
  return {round ? "lone_round_boss" : "lone_square_boss", d.text(), b, t};
}

// 180 x 40 mm: a boss of 24 mm near one end; 143 mm beside it go, 5 mm deep.
Part boss_at_the_end_of_a_long_block() {
  const Box b = block(180, 40, 14);
  Drawing d("BOSS AT THE END OF A LONG BLOCK", b);
  d.boss("BOSS", d.placement({25, 20, 0}), 5, d.circle(24));
  Target t(body(b));
  t.cut(prism(without(rectangle(-kOver, -kOver, 182, 42), disc(25, 20, 12)), -5, kOver));
  return {"boss_at_the_end_of_a_long_block", d.text(), b, t};
}

// 50 x 40 mm: a pocket of 16 x 14 mm, R3, 5 mm deep, in the floor of one of 32 x 26 mm, R5, 4 mm deep; the
// lower one comes first in the file.
Part pocket_in_a_pocket() {
  const Box b = block(50, 40, 16);
  Drawing d("POCKET IN A POCKET", b);
  d.closed_pocket("LOWER", d.placement({25, 20, -4}), 5, d.rectangle(16, 14), 3);
  d.closed_pocket("UPPER", d.placement({25, 20, 0}), 4, d.rectangle(32, 26), 5);
  Target t(body(b));
  t.cut(prism(rounded_rectangle(9, 7, 41, 33, 5), -4, kOver));
  t.cut(prism(rounded_rectangle(17, 13, 33, 27, 3), -9, 0));
  return {"pocket_in_a_pocket", d.text(), b, t};
}

// 50 x 40 mm: a slot of 10 mm with flat ends, 30 mm long, 4 mm deep; corners of R2 may stay at its ends.
Part flat_ended_slot() {
  const Box b = block(50, 40, 14);
  Drawing d("FLAT ENDED SLOT", b);
  d.slot("SLOT", d.placement({10, 20, 0}), 4, d.linear_path(30, {1, 0, 0}), d.square_u(10), "flat 2",
         "flat 2");
  Target t(body(b));
  t.cut(prism(rounded_rectangle(10, 15, 40, 25, 2), -4, kOver), prism(rectangle(10, 15, 40, 25), -4, kOver));
  return {"flat_ended_slot", d.text(), b, t};
}

// 60 x 50 mm: a pocket of 40 x 30 mm, 16 mm deep, that states corners of R0.5, with one in its floor: `stays`
// is what the mill leaves of them.
Part pocket_with_rest_in_its_corners(double stays) {
  const Box b = block(60, 50, 26);
  Drawing d("REST IN CORNERS", b);
  d.closed_pocket("POCKET", d.placement({30, 25, 0}), 16, d.rectangle(40, 30), 0.5);
  d.closed_pocket("LOWER", d.placement({30, 25, -16}), 4, d.rectangle(24, 20), 5);
  Target t(body(b));
  t.cut(prism(rounded_rectangle(10, 10, 50, 40, stays), -16, kOver));
  t.cut(prism(rounded_rectangle(18, 15, 42, 35, 5), -20, 0));
  return {"pocket_with_rest_in_its_corners", d.text(), b, t};
}

// 50 x 40 mm: a slot of 10 mm with flat ends that state no corners, 30 mm long, 4 mm deep.
Part square_ended_slot(double stays) {
  const Box b = block(50, 40, 14);
  Drawing d("SQUARE ENDED SLOT", b);
  d.slot("SLOT", d.placement({10, 20, 0}), 4, d.linear_path(30, {1, 0, 0}), d.square_u(10), "flat", "flat");
  Target t(body(b));
  t.cut(prism(rounded_rectangle(10, 15, 40, 25, stays), -4, kOver));
  return {"square_ended_slot", d.text(), b, t};
}

// 60 x 40 mm: a slot of 16 mm, 40 mm long, 5 mm deep, with flat ends: corners of R7 at its first, of R4 at
// its last.
Part unequal_flat_ends() {
  const Box b = block(60, 40, 14);
  Drawing d("UNEQUAL FLAT ENDS", b);
  d.slot("SLOT", d.placement({10, 20, 0}), 5, d.linear_path(40, {1, 0, 0}), d.square_u(16), "flat 7",
         "flat 4");
  Target t(body(b));
  t.cut(prism(both(rounded_rectangle(10, 12, 80, 28, 7), rounded_rectangle(-20, 12, 50, 28, 4)), -5, kOver));
  return {"unequal_flat_ends", d.text(), b, t};
}

// 50 x 40 mm: eight holes of 4 mm, 60 degrees apart on a circle of 24 mm: the last two stand where the first
// two do.
Part pattern_that_meets_itself() {
  const Box b = block(50, 40, 10);
  Drawing d("PATTERN THAT MEETS ITSELF", b);
  const auto hole = d.hole("HOLE", d.placement({12, 0, 0}), 10, 4, d.through_bottom());
  d.circular_pattern("CIRCLE", d.placement({25, 20, 0}), hole, 60, 8, 24);
  Target t(body(b));
  for (const auto& [x, y] : {std::pair{12.0, 0.0},
                             {6.0, 10.392305},
                             {-6.0, 10.392305},
                             {-12.0, 0.0},
                             {-6.0, -10.392305},
                             {6.0, -10.392305}})
    t.cut(cylinder(25 + x, 20 + y, 2, -12, kOver));
  return {"pattern_that_meets_itself", d.text(), b, t};
}

// 50 x 40 mm: a hole of 6 mm that goes through, its depth of 10 mm ending in a bore of 10 mm that runs along
// x, 12 mm below the top: it ends there, and the bore's other side stays whole.
Part hole_into_a_cross_bore() {
  const Box b = block(50, 40, 24);
  Drawing d("HOLE INTO A CROSS BORE", b);
  d.hole("HOLE", d.placement({25, 20, 0}), 10, 6, d.through_bottom());
  d.hole("BORE", d.placement({0, 20, -12}, {-1, 0, 0}, {0, 0, 1}), 50, 10, d.through_bottom());
  Target t(body(b));
  t.cut(cylinder(25, 20, 3, -10, kOver));
  t.cut(
      along({-kOver, 20, 0}, {52, 20, 0}, [](double u, double z) { return 5.0 - std::hypot(u, z + 12.0); }));
  return {"hole_into_a_cross_bore", d.text(), b, t};
}

}  // namespace capstan::testing::removal

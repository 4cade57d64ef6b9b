#include <cmath>
#include <numbers>

#include "tests/removal/parts.h"

// Bosses that stand in what others cut: in patterns and compounds, leaning, ill stated.

namespace capstan::testing::removal {
namespace {

constexpr double kOver = 2.0;  // mm that a hollow stands out of the block, where it is open

/// A boss, any of whose attributes may be left out (0) or be given a slope.
Drawing::Id boss(Drawing& d, const std::string& name, Drawing::Id at, double height, Drawing::Id contour,
                 double slope_deg = 0.0) {
  const auto ref = [](Drawing::Id id) { return id == 0 ? std::string("$") : "#" + std::to_string(id); };
  const Drawing::Id bottom = height > 0.0 ? d.depth(height) : 0;
  return d.write("BOSS('" + name + "',#4,()," + ref(at) + "," + ref(bottom) + "," + ref(contour) + "," +
                 (slope_deg == 0.0 ? std::string("$") : std::to_string(slope_deg)) + ")");
}

}  // namespace

// 70 x 44 mm: two bosses of 12 mm at X18 and X52, a row of two, stand 4 mm high; all around them is cut.
Part bosses_in_a_pattern() {
  const Box b = block(70, 44, 12, 4);
  Drawing d("BOSSES IN A PATTERN", b);
  const auto one = d.boss("BOSS", d.placement({0, 0, 0}), 4, d.circle(12));
  d.rectangular_pattern("BOSSES", d.placement({18, 22, 4}), one, 34, {1, 0, 0}, 2, 1, 10, {0, 1, 0});
  Target t(either({body(b), prism(disc(18, 22, 6), -1, 4), prism(disc(52, 22, 6), -1, 4)}));
  return {"bosses_in_a_pattern", d.text(), b, t};
}

// 60 x 44 mm: at (38, 20) a boss of 16 mm with a hole of 6 mm, 8 mm deep, in its middle, both one compound;
// a face that does not list the boss takes 2 mm off around it, the boss's own steps 2 mm more.
Part boss_in_a_compound() {
  const Box b = block(60, 44, 12, 4);
  Drawing d("BOSS IN A COMPOUND", b);
  d.face("TOP", 0, 0, 60, 44, 4, 2);
  const auto one = d.boss("BOSS", d.placement({0, 0, 0}), 4, d.circle(16));
  const auto hole = d.hole("BORE", d.placement({0, 0, 0}), 8, 6, d.flat_bottom());
  d.compound("BOSS WITH BORE", d.placement({38, 20, 4}), {one, hole});
  Target t(either({body(b), prism(disc(38, 20, 8), -1, 4)}));
  t.cut(cylinder(38, 20, 3, -4, 4 + kOver));
  return {"boss_in_a_compound", d.text(), b, t};
}

// 50 x 44 mm: in a pocket of 38 x 32 mm, R4, 6 mm deep, a boss of 10 mm that leans by 10 degrees: at its foot
// it is 5 + 6 tan 10 = 6.058 mm in radius, if its contour is drawn at its top. What lies between is no
// step's.
Part leaning_boss() {
  const Box b = block(50, 44, 12);
  Drawing d("LEANING BOSS", b);
  boss(d, "CONE", d.placement({25, 22, 0}), 6, d.circle(10), 10.0);
  d.closed_pocket("POCKET", d.placement({25, 22, 0}), 6, d.rectangle(38, 32), 4);
  Target t(body(b));
  const Depth2 pocket = rounded_rectangle(6, 6, 44, 38, 4);
  t.cut(
      prism(without(pocket, disc(25, 22, 5.0 + 6.0 * std::tan(10.0 * std::numbers::pi / 180.0))), -6, kOver));
  return {"leaning_boss", d.text(), b, t};
}

// As above, upright, 12 mm; but how high it is the file does not say: it stays to the top of the pocket.
Part boss_without_height() {
  const Box b = block(50, 44, 12);
  Drawing d("BOSS WITHOUT HEIGHT", b);
  boss(d, "ISLAND", d.placement({25, 22, 0}), 0, d.circle(12));
  d.closed_pocket("POCKET", d.placement({25, 22, 0}), 6, d.rectangle(38, 32), 4);
  Target t(body(b));
  t.cut(prism(without(rounded_rectangle(6, 6, 44, 38, 4), disc(25, 22, 6)), -6, kOver));
  return {"boss_without_height", d.text(), b, t};
}

// 70 x 44 mm: a pocket lists a boss that stands beside it; another pocket has nothing to do with it.
Part boss_beside_what_lists_it() {
  const Box b = block(70, 44, 12);
  Drawing d("BOSS BESIDE WHAT LISTS IT", b);
  const auto island = d.boss("ISLAND", d.placement({60, 22, 0}), 6, d.circle(8));
  d.closed_pocket("FIRST", d.placement({18, 22, 0}), 6, d.rectangle(24, 30), 4, {island});
  d.closed_pocket("SECOND", d.placement({43, 22, 0}), 5, d.rectangle(18, 30), 4);
  Target t(body(b));
  t.cut(prism(rounded_rectangle(34, 7, 52, 37, 4), -5, kOver));
  return {"boss_beside_what_lists_it", d.text(), b, t};
}

// As above; but the boss, listed by the first pocket or by none, has no contour. What may cut it stays; the
// hole is drilled.
Part boss_without_contour(bool listed) {
  const Box b = block(70, 44, 12);
  const std::string name = listed ? "LISTED BOSS WITHOUT CONTOUR" : "BOSS WITHOUT CONTOUR";
  Drawing d(name, b);
  const auto island = boss(d, "ISLAND", d.placement({18, 22, 0}), 6, 0);
  std::vector<Drawing::Id> bosses;
  if (listed) bosses.push_back(island);
  d.closed_pocket("FIRST", d.placement({18, 22, 0}), 6, d.rectangle(24, 30), 4, bosses);
  d.closed_pocket("SECOND", d.placement({43, 22, 0}), 5, d.rectangle(18, 30), 4);
  d.hole("HOLE", d.placement({62, 22, 0}), 12, 6, d.through_bottom());
  Target t(body(b));
  t.cut(cylinder(62, 22, 3, -14, kOver));
  return {"boss_without_contour", d.text(), b, t};
}

}  // namespace capstan::testing::removal

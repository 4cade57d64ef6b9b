#include "tests/removal/parts.h"

namespace capstan::testing::removal {

// 60 x 40 mm of grey iron: a seat of 16 +0.025 mm, 8 mm deep, around 10 +0.025 mm through, its edge a cone of
// 17 to 16 mm; and a core of 8.3 +0.025 mm, full to 20 mm above a cone of 120 degrees, with a thread's length
// of the same diameter, its edge a cone of 11 to 10 mm on a shoulder. Elements in no order.
Part tight_holes() {
  const Box b = block(60, 40, 30);
  Drawing d("TIGHT HOLES", b);
  d.material("EN-GJL-200");
  const auto origin = d.placement({0, 0, 0});
  const auto fine = [&](double nominal) { return d.length(nominal, 0.025, 0.0); };
  const auto cone_of_seat = d.hole_of("CONE", origin, 0.5, fine(17), d.flat_bottom(), d.angle_taper(45));
  const auto bore = d.hole_of("BORE", origin, 30, fine(10), d.through_bottom());
  const auto seat = d.hole_of("SEAT", origin, 8, fine(16), d.flat_bottom());
  d.compound("SEATED", d.placement({16, 20, 0}), {cone_of_seat, seat, bore});
  const auto length = d.hole_of("LENGTH", origin, 12, fine(8.3), d.flat_bottom());
  const auto cone_of_core = d.hole_of("CONE", origin, 0.5, fine(11), d.flat_bottom(), d.angle_taper(45));
  const auto core = d.hole_of("CORE", origin, 20, fine(8.3), d.conical_bottom(120));
  d.compound("CORED", d.placement({42, 20, 0}), {length, cone_of_core, core});
  Target t(body(b));
  t.cut(cylinder(16, 20, 8, -8, 2));
  t.cut(cylinder(16, 20, 5, -32, 2));
  t.cut(cone(16, 20, -0.5, 8, 0.2, 8.7));
  t.cut(cone(42, 20, -0.5, 5, 0.2, 5.7));
  t.cut(cylinder(42, 20, 4.15, -20, 2));
  // 120 degrees: 4.15 / tan 60 below the full diameter; 4.15 / tan 70 where the bluntest drill makes it.
  static_assert(kBluntestDeg == 140.0);
  t.cut(cone(42, 20, -20 - 1.51048, 0, -19.99, 4.15 + 0.01 * 2.74748),
        cone(42, 20, -20 - 2.39600, 0, -19.99, 4.15 + 0.01 * 1.73205));
  return {"tight_holes", d.text(), b, t};
}

// 80 x 40 mm, 20 mm thick: holes of 20 and 22 +0.013 mm (IT6), through, and of 16 +0.011 mm, flat, 12 deep.
Part fine_holes() {
  const Box b = block(80, 40, 20);
  Drawing d("FINE HOLES", b);
  d.hole_of("A", d.placement({16, 20, 0}), 20, d.length(20, 0.013, 0.0), d.through_bottom());
  d.hole_of("B", d.placement({42, 20, 0}), 20, d.length(22, 0.013, 0.0), d.through_bottom());
  d.hole_of("C", d.placement({66, 20, 0}), 12, d.length(16, 0.011, 0.0), d.flat_bottom());
  Target t(body(b));
  t.cut(cylinder(16, 20, 10, -22, 2));
  t.cut(cylinder(42, 20, 11, -22, 2));
  t.cut(cylinder(66, 20, 8, -12, 2));
  return {"fine_holes", d.text(), b, t};
}

}  // namespace capstan::testing::removal

#include <cmath>

#include "tests/removal/parts.h"

namespace capstan::testing::removal {
namespace {

constexpr double kOver = 2.0;

}  // namespace

// 60 x 36 mm: along y a square slot of 8 mm, 5 mm deep; one with a round floor, 8 mm wide, 6 mm deep; a vee
// of 90 degrees, its root rounded by 1.5 mm, 4 mm deep; and one of 8 mm along x, closed at both ends by half
// circles, 20 mm from centre to centre.
Part plain_slots() {
  const Box b = block(64, 40, 14);
  Drawing d("PLAIN SLOTS", b);
  const auto path = d.linear_path(40, {0, 1, 0});
  d.slot("SQUARE", d.placement({8, 0, 0}), 5, path, d.square_u(8), "open", "open");
  d.slot("ROUNDED", d.placement({22, 0, 0}), 6, path, d.rounded_u(8), "open", "open");
  d.slot("CLOSED", d.placement({33, 20, 0}), 4, d.linear_path(12, {1, 0, 0}), d.square_u(8), "radiused",
         "radiused");
  d.slot("VEE", d.placement({57, 0, 0}), 4, path, d.vee(90, 45, 1.5), "open", "open");
  Target t(body(b));
  const auto whole = [&](double x, Depth2 section) {
    return along({x, -kOver, 0}, {x, 42, 0}, std::move(section));
  };
  t.cut(whole(8, rectangle(-4, -5, 4, kOver)));
  t.cut(whole(22, [](double u, double z) {
    return z > -2.0 ? std::min(4.0 - std::abs(u), kOver - z) : 4.0 - std::hypot(u, z + 2.0);
  }));
  t.cut(prism(stroke({{33, 20}, {45, 20}}, 8), -4, kOver));
  // The flanks touch a circle of 1.5 mm that stands on the floor; below its touching points the circle
  // bounds.
  t.cut(whole(57, [](double u, double z) {
    const double flank = (z + 2.5 + 1.5 * std::sqrt(2.0) - std::abs(u)) / std::sqrt(2.0);
    const double touch = -2.5 - 1.5 / std::sqrt(2.0);
    return std::min(z > touch ? flank : std::min(flank, 1.5 - std::hypot(u, z + 2.5)), kOver - z);
  }));
  return {"plain_slots", d.text(), b, t};
}

// 90 x 40 mm: a T-slot of 12 mm with a bar of 21 x 9 mm, 21 mm deep in all; a dovetail of 14 mm at its mouth
// and 26 mm at its floor, 6 mm deep.
Part undercut_slots() {
  const Box b = block(90, 40, 30);
  Drawing d("UNDERCUT SLOTS", b);
  const auto path = d.linear_path(40, {0, 1, 0});
  d.slot("TEE", d.placement({70, 0, 0}), 21, path, d.tee(21, 9, 12), "open", "open");
  const auto section = d.open(d.polyline({{7, 6, 0}, {13, 0, 0}, {-13, 0, 0}, {-7, 6, 0}}));
  d.slot("DOVETAIL", d.placement({28, 0, 0}), 6, path, section, "open", "open");
  Target t(body(b));
  t.cut(along({70, -kOver, 0}, {70, 42, 0}, rectangle(-6, -21, 6, kOver)));
  t.cut(along({70, -kOver, 0}, {70, 42, 0}, rectangle(-10.5, -21, 10.5, -12)));
  t.cut(
      along({28, -kOver, 0}, {28, 42, 0}, polygon({{-13, -6}, {13, -6}, {7, 0}, {7, 2}, {-7, 2}, {-7, 0}})));
  Part p{"undercut_slots", d.text(), b, t};
  p.grid = {0.5, 0.2, 0.15};
  return p;
}

}  // namespace capstan::testing::removal

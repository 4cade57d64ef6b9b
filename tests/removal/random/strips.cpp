#include <cmath>
#include <numbers>

#include "tests/removal/random/maker.h"

// What runs along y from side to side.

namespace capstan::testing::removal {

// What runs along y from side to side, 18 mm at the right of the block.
void Maker::strip(double x0) {
  const double w = block_.hi.y, deep = whole(2, 6);
  const auto space = [&](const std::string& name) { keep(name, {x0 - 2, 0, block_.lo.z}, block_.hi); };
  const auto whole_length = [&](double x, Depth2 s) {
    return along({x, -kOver, 0}, {x, w + kOver, 0}, std::move(s));
  };
  const double x = x0 + 9;
  const auto path = [&] { return drawing_.linear_path(w, {0, 1, 0}); };
  switch (whole(0, 4)) {
    case 0: {
      drawing_.step("STEP", drawing_.placement({x, 0, 0}), deep, w, {0, 1, 0});
      target_.cut(box({x, -kOver, -deep}, {block_.hi.x + kOver, w + kOver, kOver}));
      return space("STEP");
    }
    case 1: {
      const double wide = whole(5, 10);
      drawing_.slot("SLOT", drawing_.placement({x, 0, 0}), deep, path(), drawing_.square_u(wide), "open",
                    "open");
      target_.cut(whole_length(x, rectangle(-wide / 2, -deep, wide / 2, kOver)));
      return space("SLOT");
    }
    case 2: {
      static const double kWidths[] = {6, 8, 10};
      const double wide = kWidths[whole(0, 2)], r = wide / 2, low = r + whole(0, 2);
      drawing_.slot("ROUND SLOT", drawing_.placement({x, 0, 0}), low, path(), drawing_.rounded_u(wide),
                    "open", "open");
      target_.cut(whole_length(x, [r, low](double u, double z) {
        return z > r - low ? std::min(r - std::abs(u), kOver - z) : r - std::hypot(u, z + low - r);
      }));
      return space("ROUND SLOT");
    }
    case 3: {
      // 90 degrees; the flanks touch a circle that stands on the floor, below it the circle bounds.
      const double r = 1.5, low = whole(3, 5), up = r - low;
      drawing_.slot("VEE", drawing_.placement({x, 0, 0}), low, path(), drawing_.vee(90, 45, r), "open",
                    "open");
      target_.cut(whole_length(x, [r, up](double u, double z) {
        const double flank = (z - up + r * std::sqrt(2.0) - std::abs(u)) / std::sqrt(2.0);
        const double touch = up - r / std::sqrt(2.0);
        return std::min(z > touch ? flank : std::min(flank, r - std::hypot(u, z - up)), kOver - z);
      }));
      return space("VEE");
    }
    default: {
      const double wide = half(10, 16), l = 14, r = half(3, 5);
      const double a = wide / 2;
      // Opens at the front.
      const auto curve = drawing_.composite({{drawing_.polyline({{-a, 0, 0}, {-a, l - r, 0}}), true},
                                             {drawing_.arc({-a + r, l - r, 0}, r, 180, 90, false), true},
                                             {drawing_.polyline({{-a + r, l, 0}, {a - r, l, 0}}), true},
                                             {drawing_.arc({a - r, l - r, 0}, r, 90, 0, false), true},
                                             {drawing_.polyline({{a, l - r, 0}, {a, 0, 0}}), true}});
      drawing_.open_pocket("OPEN POCKET", drawing_.placement({x, 0, 0}), deep, drawing_.open(curve), r);
      target_.cut(
          prism(both(rounded_rectangle(x - a, -20, x + a, l, r), rectangle(x - 20, -kOver, x + 20, l)), -deep,
                kOver));
      return space("OPEN POCKET");
    }
  }
}

// A T-slot of 12 mm to DIN 650, or a dovetail of 45 degrees, in 34 mm.
void Maker::undercut(double x0) {
  const double w = block_.hi.y, x = x0 + 17;
  const auto path = drawing_.linear_path(w, {0, 1, 0});
  const auto place = drawing_.placement({x, 0, 0});
  const auto whole_length = [&](Depth2 s) { return along({x, -kOver, 0}, {x, w + kOver, 0}, std::move(s)); };
  if (chance(0.5)) {
    drawing_.slot("TEE", place, 21, path, drawing_.tee(21, 9, 12), "open", "open");
    target_.cut(whole_length(rectangle(-6, -21, 6, kOver)));
    target_.cut(whole_length(rectangle(-10.5, -21, 10.5, -12)));
    return keep("TEE", {x0 - 2, 0, block_.lo.z}, block_.hi);
  }
  const auto section = drawing_.open(drawing_.polyline({{7, 6, 0}, {13, 0, 0}, {-13, 0, 0}, {-7, 6, 0}}));
  drawing_.slot("DOVETAIL", place, 6, path, section, "open", "open");
  target_.cut(whole_length(polygon({{-13, -6}, {13, -6}, {7, 0}, {7, 2}, {-7, 2}, {-7, 0}})));
  keep("DOVETAIL", {x0 - 2, 0, block_.lo.z}, block_.hi);
}

}  // namespace capstan::testing::removal

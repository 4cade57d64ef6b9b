#include <cmath>
#include <numbers>

#include "tests/removal/random/maker.h"

// Pockets of every outline.

namespace capstan::testing::removal {

void Maker::pocket(const std::string& name) {
  const double l = half(12, 18), w = half(12, 18), r = half(2.5, 5), deep = whole(2, 8);
  const double turn = chance(0.3) ? whole(1, 3) * 15.0 : 0.0;
  const double c = std::cos(turn * kDeg), s = std::sin(turn * kDeg);
  const auto place = drawing_.placement({x_, y_, 0}, {0, 0, 1}, {c, s, 0});
  const Depth hollow =
      prism(rounded_rectangle(x_ - l / 2, y_ - w / 2, x_ + l / 2, y_ + w / 2, r), -deep, kOver);
  std::vector<Drawing::Id> bosses;
  const double island = chance(0.25) && std::min(l, w) >= 17 ? 4.0 : 0.0;
  if (island > 0.0) bosses.push_back(drawing_.boss(name + " ISLAND", at(), deep, drawing_.circle(island)));
  const auto made = drawing_.closed_pocket(name, place, deep, drawing_.rectangle(l, w), r, bosses);
  Depth cut = rotated(hollow, x_, y_, turn * kDeg);
  if (island > 0.0) cut = without(cut, cylinder(x_, y_, island / 2, -deep - 1, kOver));
  target_.cut(cut);
  keep_field(name);
  if (island == 0.0 && chance(0.3)) {
    const double dx = half(-2, 2);
    const std::string in = name + " FLOOR HOLE";
    drawing_.hole(in, at(dx, 0, -deep), height_ - deep, 4, drawing_.through_bottom());
    target_.cut(cylinder(x_ + dx, y_, 2, -height_ - kOver, -deep + 1));
    keep_field(in);
  }
  if (island == 0.0 && chance(0.2)) {
    // Over an outline that is turned the chamfer turns, too.
    const Depth2 outline = rounded_rectangle(x_ - l / 2, y_ - w / 2, x_ + l / 2, y_ + w / 2, r);
    drawing_.chamfer(name + " EDGE", made, made, 45, 0.5);
    target_.cut(rotated(
        [outline](const Point& p) {
          return std::min((outline(p.x, p.y) + 0.5 + p.z) / std::numbers::sqrt2,
                          std::min(p.z + 0.5, kOver - p.z));
        },
        x_, y_, turn * kDeg));
    keep_field(name + " EDGE");
  }
}

void Maker::round_pocket(const std::string& name) {
  const double d = half(12, 19), deep = whole(2, 8);
  drawing_.closed_pocket(name, at(), deep, drawing_.circle(d), 0);
  target_.cut(cylinder(x_, y_, d / 2, -deep, kOver));
  keep_field(name);
}

// A rectangle with round corners as a composite curve, either way round, its arcs with 0 or 360 degrees.
void Maker::drawn_pocket(const std::string& name) {
  const double l = half(12, 18), w = half(12, 18), r = half(3, 5), deep = whole(2, 6);
  const bool clockwise = chance(0.5);
  const double last = chance(0.5) ? 0.0 : 360.0;
  std::vector<std::pair<Drawing::Id, bool>> s;
  const auto line = [&](Point a, Point b) {
    s.emplace_back(clockwise ? drawing_.polyline({b, a}) : drawing_.polyline({a, b}), true);
  };
  const auto arc = [&](double cx, double cy, double from, double to) {
    const Point c{cx, cy, 0};
    s.emplace_back(clockwise ? drawing_.arc(c, r, to, from, false) : drawing_.arc(c, r, from, to, true),
                   true);
  };
  const double a = l / 2, b = w / 2;
  line({-a + r, -b, 0}, {a - r, -b, 0});
  arc(a - r, -b + r, 270, last);
  line({a, -b + r, 0}, {a, b - r, 0});
  arc(a - r, b - r, 0, 90);
  line({a - r, b, 0}, {-a + r, b, 0});
  arc(-a + r, b - r, 90, 180);
  line({-a, b - r, 0}, {-a, -b + r, 0});
  arc(-a + r, -b + r, 180, 270);
  if (clockwise) std::reverse(s.begin(), s.end());
  drawing_.closed_pocket(name, at(), deep, drawing_.closed(drawing_.composite(s)), 0);
  target_.cut(prism(rounded_rectangle(x_ - a, y_ - b, x_ + a, y_ + b, r), -deep, kOver));
  keep_field(name);
}

void Maker::closed_slot(const std::string& name) {
  const double w = whole(4, 10), l = half(4, 8), deep = whole(2, 5);
  const Point way = one_of<Point>({{0, 1, 0}, {1, 0, 0}, {0.8, 0.6, 0}, {-0.6, 0.8, 0}});
  const double dx = -way.x * l / 2, dy = -way.y * l / 2;
  drawing_.slot(name, at(dx, dy), deep, drawing_.linear_path(l, way), drawing_.square_u(w), "radiused",
                "radiused");
  target_.cut(prism(stroke({{x_ + dx, y_ + dy}, {x_ - dx, y_ - dy}}, w), -deep, kOver));
  keep_field(name);
}

// A pocket in a pocket's floor, perhaps a hole in that one's; drawn in any order.
void Maker::stacked(const std::string& name) {
  const double l = half(15, 19), w = half(15, 19), r = half(3, 5), a = whole(2, 3);
  const double il = half(8, 11), iw = half(8, 11), ir = half(2.5, 3.5), b = whole(2, 4);
  const double dx = half(-1, 1), dy = half(-1, 1), d = half(3, 4);
  const bool with_hole = chance(0.5), inside_first = chance(0.5);
  const auto inner = [&] {
    drawing_.closed_pocket(name + " INNER", at(dx, dy, -a), b, drawing_.rectangle(il, iw), ir);
    if (with_hole)
      drawing_.hole(name + " HOLE", at(dx, dy, -a - b), height_ - a - b, d, drawing_.through_bottom());
  };
  if (inside_first) inner();
  drawing_.closed_pocket(name, at(), a, drawing_.rectangle(l, w), r);
  if (!inside_first) inner();
  target_.cut(prism(rounded_rectangle(x_ - l / 2, y_ - w / 2, x_ + l / 2, y_ + w / 2, r), -a, kOver));
  const double ix = x_ + dx, iy = y_ + dy;
  target_.cut(
      prism(rounded_rectangle(ix - il / 2, iy - iw / 2, ix + il / 2, iy + iw / 2, ir), -a - b, kOver));
  keep_field(name);
  keep_field(name + " INNER");
  if (!with_hole) return;
  bored(ix, iy, d, -height_ - kOver, kOver, 0.1);
  keep_field(name + " HOLE");
}

// A slot through a pocket that is deeper or less deep, and ends beyond it on both sides.
void Maker::crossing(const std::string& name) {
  const double l = half(7, 10), w = half(9, 14), r = half(2.5, 3.5), deep = whole(2, 5);
  const double length = half(14, 15), wide = half(4, 6), low = whole(2, 5);
  drawing_.closed_pocket(name + " POCKET", at(), deep, drawing_.rectangle(l, w), r);
  drawing_.slot(name + " SLOT", at(-length / 2), low, drawing_.linear_path(length, {1, 0, 0}),
                drawing_.square_u(wide), "radiused", "radiused");
  target_.cut(prism(rounded_rectangle(x_ - l / 2, y_ - w / 2, x_ + l / 2, y_ + w / 2, r), -deep, kOver));
  target_.cut(prism(stroke({{x_ - length / 2, y_}, {x_ + length / 2, y_}}, wide), -low, kOver));
  keep_field(name + " POCKET");
  keep_field(name + " SLOT");
}

// All around it goes away; what stays stands in the middle of the block, perhaps with a hole in it.
void Maker::outside(const std::string& name) {
  const double l = half(14, 18), w = half(14, 18), deep = whole(2, 5);
  Depth2 stays;
  if (chance(0.5)) {
    drawing_.outside(name, at(), deep, drawing_.circle(l));
    stays = disc(x_, y_, l / 2);
  } else {
    drawing_.outside(name, at(), deep, drawing_.closed(rounded(l, w, half(2, 4), stays)));
  }
  const double far = kField / 2 + kOver;
  target_.cut(prism(without(rectangle(x_ - far, y_ - far, x_ + far, y_ + far), stays), -deep, kOver));
  keep_field(name);
  if (chance(0.5)) {
    const double d = half(3, 6);
    drawing_.hole(name + " BORE", at(), height_, d, drawing_.through_bottom());
    bored(x_, y_, d, -height_ - kOver, kOver, 0.1);
    keep_field(name + " BORE");
  }
}

// From below: a pocket, or a blind hole, and nothing above it.
void Maker::beneath(const std::string& name) {
  const double dx = half(-2, 2), dy = half(-2, 2), deep = whole(3, 6);
  const auto place = drawing_.placement({x_ + dx, y_ + dy, -height_}, {0, 0, -1}, {1, 0, 0});
  if (chance(0.5)) {
    const double l = half(10, 15), w = half(10, 15), r = half(2.5, 4);
    drawing_.closed_pocket(name, place, deep, drawing_.rectangle(l, w), r);
    target_.cut(
        prism(rounded_rectangle(x_ + dx - l / 2, y_ + dy - w / 2, x_ + dx + l / 2, y_ + dy + w / 2, r),
              -height_ - kOver, -height_ + deep));
  } else {
    const double d = half(4, 8);
    drawing_.hole(name, place, deep, d, drawing_.flat_bottom());
    bored(x_ + dx, y_ + dy, d, -height_ - kOver, -height_ + deep, 0.1);
  }
  keep_field(name);
}

// The raw top goes off; a boss in the first field stays.
void Maker::top_face(bool with_boss) {
  std::vector<Drawing::Id> bosses;
  if (with_boss) {
    const double l = half(7, 12), w = half(7, 12), r = half(1, 3);
    Depth2 stays = disc(x_, y_, l / 2);
    const auto profile = chance(0.5) ? drawing_.circle(l) : drawing_.closed(rounded(l, w, r, stays));
    bosses.push_back(drawing_.boss("BOSS", at(0, 0, raw_), raw_, profile));
    boss_ = prism(stays, -1, raw_);
    keep("BOSS", block_.lo, block_.hi);
  }
  drawing_.face("TOP", 0, 0, block_.hi.x, block_.hi.y, raw_, raw_, bosses);
  keep("TOP", block_.lo, block_.hi);
}

// A rectangle with round corners about a placement, counter-clockwise; `inside` is what it encloses about the
// field's middle.
Drawing::Id Maker::rounded(double l, double w, double r, Depth2& inside) {
  const double a = l / 2, b = w / 2;
  std::vector<std::pair<Drawing::Id, bool>> s;
  const auto side = [&](Point from, Point to) { s.emplace_back(drawing_.polyline({from, to}), true); };
  const auto corner = [&](double x, double y, double from) {
    s.emplace_back(drawing_.arc({x, y, 0}, r, from, from + 90, true), true);
  };
  side({-a + r, -b, 0}, {a - r, -b, 0});
  corner(a - r, -b + r, 270);
  side({a, -b + r, 0}, {a, b - r, 0});
  corner(a - r, b - r, 0);
  side({a - r, b, 0}, {-a + r, b, 0});
  corner(-a + r, b - r, 90);
  side({-a, b - r, 0}, {-a, -b + r, 0});
  corner(-a + r, -b + r, 180);
  inside = rounded_rectangle(x_ - a, y_ - b, x_ + a, y_ + b, r);
  return drawing_.composite(s);
}

}  // namespace capstan::testing::removal

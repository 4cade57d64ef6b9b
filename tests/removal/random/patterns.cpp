#include <cmath>
#include <numbers>

#include "tests/removal/random/maker.h"

// Patterns: of holes, of compounds, turned, at places of their own.

namespace capstan::testing::removal {

void Maker::circle(const std::string& name) {
  const int count = whole(2, 4);
  const double d = half(2, 4), on = half(12, 16), step = 360.0 / (count + whole(0, 1));
  const int without = chance(0.3) ? 2 : 0;
  const auto base = drawing_.hole(name + " BASE", drawing_.placement({on / 2, 0, 0}), height_, d,
                                  drawing_.through_bottom());
  drawing_.circular_pattern(name, at(), base, step, count, on,
                            without > 0 ? std::vector{without} : std::vector<int>{});
  for (int i = 0; i < count; ++i) {
    if (i + 1 == without) continue;
    bored(x_ + on / 2 * std::cos(i * step * kDeg), y_ + on / 2 * std::sin(i * step * kDeg), d,
          -height_ - kOver, kOver, 0.1);
  }
  keep_field(name);
  keep_field(name + " BASE");
}

// Rows of holes, or of counterbored ones; or the same at places of their own.
void Maker::rows(const std::string& name) {
  const int columns = 2, lines = whole(1, 2);
  const double d = half(2, 3), apart = half(8, 10), between = half(8, 10);
  const bool compound = chance(0.5), general = chance(0.4);
  const auto origin = drawing_.placement({0, 0, 0});
  auto base = drawing_.hole(name + " BASE", origin, height_, d, drawing_.through_bottom());
  if (compound) {
    const auto bore = drawing_.hole(name + " BORE", origin, 2, d + 2, drawing_.flat_bottom());
    base = drawing_.compound(name + " SCREW", origin, {bore, base});
    keep_field(name + " SCREW");
  }
  const double x0 = -apart / 2, y0 = -between / 2;
  if (general) {
    std::vector<Drawing::Id> places;
    for (int l = 0; l < lines; ++l) {
      for (int c = 0; c < columns; ++c) {
        if (l + c > 0) places.push_back(drawing_.placement({c * apart, l * between, 0}));
      }
    }
    drawing_.general_pattern(name, at(x0, y0), base, places);
  } else {
    drawing_.rectangular_pattern(name, at(x0, y0), base, apart, {1, 0, 0}, columns, lines, between,
                                 {0, 1, 0});
  }
  for (int l = 0; l < lines; ++l) {
    for (int c = 0; c < columns; ++c) {
      const double x = x_ + x0 + c * apart, y = y_ + y0 + l * between;
      bored(x, y, d, -height_ - kOver, kOver, 0.1);
      if (compound) bored(x, y, d + 2, -2, kOver, 0.1);
    }
  }
  for (const char* of : {"", " BASE", " BORE"}) keep_field(name + of);
}

// A pattern whose frame is turned, of compounds that are turned in it: a hole through on one side of the
// compound's origin, a blind one on the other.
void Maker::nested(const std::string& name) {
  const double outer = whole(0, 11) * 15.0, inner = whole(0, 7) * 15.0;
  const double d = half(2, 3.5), e = half(2, 3), off = half(2, 2.5), deep = whole(3, 6);
  const auto a = drawing_.hole(name + " THROUGH", drawing_.placement({off, 0, 0}), height_, d,
                               drawing_.through_bottom());
  const auto b =
      drawing_.hole(name + " BLIND", drawing_.placement({-off, 0, 0}), deep, e, drawing_.conical_bottom(118));
  const Point way{std::cos(inner * kDeg), std::sin(inner * kDeg), 0};
  const double apart = half(9, 11);
  // The compound's own place in the pattern, the first copy.
  const Point first{-0.5 * apart, 0, 0};
  const auto pair = drawing_.compound(name + " PAIR", drawing_.placement(first, {0, 0, 1}, way), {a, b});
  std::vector<Point> copies{first, {first.x + apart, 0, 0}};
  // Copies keep the direction of the first unless a place of a general pattern turns them.
  std::vector<double> turns{inner, inner};
  drawing_.rectangular_pattern(name, turned_at(0, 0, outer), pair, apart, {1, 0, 0}, 2, 1, 1, {0, 1, 0});
  for (std::size_t i = 0; i < copies.size(); ++i) {
    const double c = std::cos(turns[i] * kDeg), s = std::sin(turns[i] * kDeg);
    const Point p = seen(copies[i].x + off * c, copies[i].y + off * s, outer);
    const Point q = seen(copies[i].x - off * c, copies[i].y - off * s, outer);
    bored(p.x, p.y, d, -height_ - kOver, kOver, 0.1);
    bored(q.x, q.y, e, -deep, kOver, 0.1);
    const auto point = [&](double angle_deg) {
      const double tip = e / 2 / std::tan(angle_deg / 2 * kDeg);
      return cone(q.x, q.y, -deep - tip, 0, -deep + 0.01, e / 2 * (1 + 0.01 / tip));
    };
    target_.cut(point(kBluntestDeg), point(118));
  }
  for (const char* of : {"", " THROUGH", " BLIND", " PAIR"}) keep_field(name + of);
}

}  // namespace capstan::testing::removal

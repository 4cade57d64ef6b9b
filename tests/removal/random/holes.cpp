#include <cmath>
#include <numbers>

#include "tests/removal/random/maker.h"

// Holes alone, in compounds, in patterns, with a thread.

namespace capstan::testing::removal {

// A diameter with limits to both sides of it: anything between them is right.
void Maker::bored(double x, double y, double d, double below, double top, double tolerance) {
  target_.cut(cylinder(x, y, (d - tolerance) / 2, below, top),
              cylinder(x, y, (d + tolerance) / 2, below, top));
}

void Maker::hole(const std::string& name) {
  const double dx = half(-4, 4), dy = half(-4, 4), d = half(3, 10), deep = whole(4, 8);
  const double x = x_ + dx, y = y_ + dy;
  const double tolerance = chance(0.2) ? 0.2 : 0.5 * standard_tolerance(whole(6, 12), d);
  keep_field(name);
  switch (whole(0, 3)) {
    case 0: {
      const auto made = drawing_.hole(name, at(dx, dy), height_, d, drawing_.through_bottom(), 0, tolerance);
      bored(x, y, d, -height_ - kOver, kOver, tolerance);
      if (chance(0.3)) {
        const double wide = half(0.5, 1);
        drawing_.chamfer(name + " EDGE", made, made, 45, wide);
        target_.cut(cone(x, y, -wide, d / 2, 0.2, d / 2 + wide + 0.2));
        keep_field(name + " EDGE");
      }
      return;
    }
    case 1:
      drawing_.hole(name, at(dx, dy), deep, d, drawing_.flat_bottom(), 0, tolerance);
      return bored(x, y, d, -deep, kOver, tolerance);
    case 2: {
      drawing_.hole(name, at(dx, dy), deep, d, drawing_.conical_bottom(118), 0, tolerance);
      bored(x, y, d, -deep, kOver, tolerance);
      const auto point = [&](double angle_deg) {
        const double tip = d / 2 / std::tan(angle_deg / 2 * kDeg);
        return cone(x, y, -deep - tip, 0, -deep + 0.01, d / 2 * (1 + 0.01 / tip));
      };
      return target_.cut(point(kBluntestDeg), point(118));
    }
    default:
      drawing_.hole(name, at(dx, dy), deep + d / 2, d, drawing_.spherical_bottom(d / 2), 0, 0.1);
      bored(x, y, d, -deep, kOver, 0.1);
      return target_.cut(sphere({x, y, -deep}, d / 2));
  }
}

void Maker::counterbored(const std::string& name) {
  const double d = half(3, 7), wide = d + half(3, 5), deep = whole(2, 5);
  const auto bore =
      drawing_.hole(name + " BORE", drawing_.placement({0, 0, 0}), deep, wide, drawing_.flat_bottom());
  const auto core = drawing_.hole(name + " CORE", drawing_.placement({0, 0, -deep}), height_ - deep, d,
                                  drawing_.through_bottom());
  const bool bore_first = chance(0.5);
  const double dx = half(-3, 3);
  drawing_.compound(name, at(dx), bore_first ? std::vector{bore, core} : std::vector{core, bore},
                    chance(0.5) ? "COUNTERBORE_HOLE" : "COMPOUND_FEATURE");
  bored(x_ + dx, y_, wide, -deep, kOver, 0.1);
  bored(x_ + dx, y_, d, -height_ - kOver, kOver, 0.1);
  for (const char* of : {"", " BORE", " CORE"}) keep_field(name + of);
}

void Maker::countersunk(const std::string& name) {
  const double d = half(3, 6), wide = d + 2 * half(1, 2), deep = (wide - d) / 2;
  const auto core =
      drawing_.hole(name + " CORE", drawing_.placement({0, 0, 0}), height_, d, drawing_.through_bottom());
  const auto sink = drawing_.hole(name + " SINK", drawing_.placement({0, 0, 0}), deep, wide,
                                  drawing_.through_bottom(), drawing_.angle_taper(45));
  drawing_.compound(name, at(), {core, sink}, "COUNTERSUNK_HOLE");
  bored(x_, y_, d, -height_ - kOver, kOver, 0.1);
  target_.cut(cone(x_, y_, -deep, d / 2, 0.2, wide / 2 + 0.2));
  for (const char* of : {"", " CORE", " SINK"}) keep_field(name + of);
}

void Maker::thread(const std::string& name) {
  struct Size {
    double major, pitch, core;
  };
  static const Size kSizes[] = {{4, 0.7, 3.3}, {5, 0.8, 4.2}, {6, 1, 5}, {8, 1.25, 6.8}};
  const Size& s = kSizes[whole(0, 3)];
  const double deep = std::min(height_ - 5.0, 2.0 * s.major), full = deep - 4.0 * s.pitch;
  const auto core = drawing_.hole_of(name + " CORE", at(), deep, drawing_.length(s.core, 0.15, 0.05),
                                     drawing_.conical_bottom(118));
  drawing_.thread(name, at(), full, core, s.major, s.pitch);
  const auto drilled = [&](double more, double angle_deg) {
    const double tip = s.core / 2 / std::tan(angle_deg / 2 * kDeg);
    return either({cylinder(x_, y_, s.core / 2 + more, -deep, kOver),
                   cone(x_, y_, -deep - tip, more, -deep + 0.01, s.core / 2 * (1 + 0.01 / tip) + more)});
  };
  // The flanks lie anywhere between core and major diameter; a tap runs on by its chamfer.
  target_.cut(
      drilled(-0.025, kBluntestDeg),
      either({drilled(0.075, 118), cylinder(x_, y_, s.major / 2 + 0.05, -full - 3.5 * s.pitch, kOver)}));
  for (const char* of : {"", " CORE"}) keep_field(name + of);
}

// A counterbored hole whose bore goes through a pocket's wall, or stands in its floor; the bore is deeper.
void Maker::counterbore_in_pocket(const std::string& name) {
  const double l = half(10, 13), w = half(11, 16), r = half(2.5, 4), shallow = whole(2, 3);
  const double d = half(3, 5), wide = d + half(3, 4), deep = shallow + whole(1, 3);
  const double px = -4, bx = px + l / 2 + (chance(0.5) ? half(0, 2) : -wide / 2 - half(0.5, 1));
  drawing_.closed_pocket(name + " POCKET", at(px), shallow, drawing_.rectangle(l, w), r);
  target_.cut(
      prism(rounded_rectangle(x_ + px - l / 2, y_ - w / 2, x_ + px + l / 2, y_ + w / 2, r), -shallow, kOver));
  const auto bore =
      drawing_.hole(name + " BORE", drawing_.placement({0, 0, 0}), deep, wide, drawing_.flat_bottom());
  const auto core = drawing_.hole(name + " CORE", drawing_.placement({0, 0, -deep}), height_ - deep, d,
                                  drawing_.through_bottom());
  drawing_.compound(name, at(bx), {bore, core}, "COUNTERBORE_HOLE");
  bored(x_ + bx, y_, wide, -deep, kOver, 0.1);
  bored(x_ + bx, y_, d, -height_ - kOver, kOver, 0.1);
  for (const char* of : {"", " POCKET", " BORE", " CORE"}) keep_field(name + of);
}

}  // namespace capstan::testing::removal

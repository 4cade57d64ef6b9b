#include <cmath>
#include <numbers>

#include "tests/removal/parts.h"

namespace capstan::testing::removal {
namespace {

constexpr double kOver = 2.0;

// What a drill leaves below its full diameter: the file's flank of 30 degrees, 20 degrees for a point of 140.
void drill_tip(Target& t, double x, double y, double diameter, double z) {
  const double r = 0.5 * diameter;
  const double blunt = r * std::tan(20.0 * std::numbers::pi / 180.0);
  const double sharp = r * std::tan(31.5 * std::numbers::pi / 180.0);
  t.cut(cone(x, y, z - blunt, 0, z + 0.01, r), cone(x, y, z - sharp, 0, z + 0.01, r));
}

// With a cone of 45 degrees at its top, 0.5 mm deep, whose foot is `foot` wide.
void seated(Target& t, double x, double y, double diameter, double foot, double top, double below) {
  t.cut(cylinder(x, y, 0.5 * diameter, top - below, kOver));
  t.cut(cone(x, y, top - 0.5, 0.5 * foot, top + 0.1, 0.5 * foot + 0.6));
}

// The same where the foot is as wide as the hole: a chamfer.
void blind(Target& t, double x, double y, double diameter, double top, double below) {
  seated(t, x, y, diameter, diameter, top, below);
}

}  // namespace

// Example 2 of ISO 14649-11, its five references mended, from the figures in the file. `raw` is the raw piece
// that the plan takes: the file states none.
Target example2(const Box& raw) {
  const double bottom = raw.lo.z - kOver;
  Target t(box(raw.lo, {raw.hi.x, raw.hi.y, 0.0}));
  // The front side, 50 mm down along 230 mm; nothing is said of the three others.
  t.cut(box({0, -50, -50}, {230, 0, kOver}), box({-50, -50, bottom}, {310, 0, kOver}));
  // The step from x = 230 on, from y = 40 to 140, 20 mm deep; its inner corners as a mill of 25 mm leaves
  // them.
  t.cut(prism(rounded_rectangle(230, 40, 320, 140, 12.5), -20, kOver),
        prism(rectangle(230, 40, 320, 140), -20, kOver));
  // The pocket at (50, 0), open at the front, 70 x 50 mm with R10, 20 mm deep; its boss of 30 x 20 mm, R5.
  const Depth2 outline = both(rounded_rectangle(50, -50, 120, 50, 10), rectangle(0, -kOver, 260, 180));
  t.cut(prism(without(outline, rounded_rectangle(70, 15, 100, 35, 5)), -20, kOver));
  // Hole 1: 40 mm through.
  blind(t, 160, 90, 40, 0, -bottom);
  // Hole 2: 25 mm, 15 deep, then 15 mm, 30 deep, drilled.
  blind(t, 160, 150, 25, 0, 15);
  t.cut(cylinder(160, 150, 7.5, -30, kOver));
  drill_tip(t, 160, 150, 15, -30);
  // Hole 3: 25 mm, 15 deep, then 15 mm through.
  blind(t, 160, 30, 25, 0, 15);
  t.cut(cylinder(160, 30, 7.5, bottom, kOver));
  for (const double y : {120.0, 60.0}) {
    blind(t, 130, y, 10, 0, 15);  // hole 4
    drill_tip(t, 130, y, 10, -15);
    seated(t, 190, y, 8.3, 10, 0, 25);  // hole 5: the core of an M10, its cone from 11 to 10 mm
    drill_tip(t, 190, y, 8.3, -25);
  }
  for (const double y : {110.0, 70.0}) {
    blind(t, 245, y, 10, -20, 20);  // hole 6, on the step
    drill_tip(t, 245, y, 10, -40);
  }
  // Slots 1 and 2, 10 mm wide and deep.
  t.cut(prism(stroke({{245, 90}, {210, 90}}, 10), -10, kOver));
  t.cut(prism(stroke({{85, 90}, {110, 90}}, 10), -10, kOver));
  // The T-slot from the left side to x = 50: 20 mm wide, below it a bar of 32 x 20 mm. Its depth of 10 mm is
  // that of its neck, for the bar does not fit into it: the floor lies 30 mm down. The end is round in both.
  t.cut(prism(stroke({{-20, 90}, {50, 90}}, 20), -30, kOver));
  t.cut(prism(stroke({{-20, 90}, {50, 90}}, 32), -30, -10));
  // The groove in hole 1, 44 mm wide, 3.5 high, 20 mm down, is not planned: its material stays.
  return t;
}

}  // namespace capstan::testing::removal

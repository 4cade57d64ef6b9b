#include "tests/sweep/features.h"

#include <cmath>
#include <numbers>
#include <sstream>

#include "tests/removal/drawing.h"

// Twelve parts of one feature each, of the size of a hand. Sizes bear +-0.1 mm where nothing else is said,
// which is Drawing's default. What a catalogue's way of making it removes is reckoned from the drawing's
// numbers.

namespace capstan::testing::sweep {
namespace {

using removal::Box;
using removal::Drawing;
using removal::Point;

constexpr double kPi = std::numbers::pi;
constexpr double kZone = 0.2;  ///< of Drawing::length

Box block(double x, double y, double height, double raw = 0.0) { return {{0.0, 0.0, -height}, {x, y, raw}}; }

/// What a rectangle with rounded corners holds, mm2, and its outline, mm.
double area(double x, double y, double r) { return x * y - (4.0 - kPi) * r * r; }
double outline(double x, double y, double r) { return 2.0 * (x + y) - (8.0 - 2.0 * kPi) * r; }

/// Drills reach deeper than the depth by their point: a third of the diameter, at most.
constexpr double kPoint = 0.3;

Feature through_hole() {
  Drawing d("THROUGH HOLE", block(40, 40, 20));
  d.hole("HOLE", d.placement({20, 20, 0}), 20, 8, d.through_bottom());
  return {"through hole", d.text(), 0, kZone, {{Work::kDrill, 8, 20 + kPoint * 8}}};
}

Feature reamed_hole() {
  Drawing d("H7 HOLE", block(40, 40, 20));
  d.hole_of("HOLE", d.placement({20, 20, 0}), 20, d.length(10, 0.015, 0.0), d.through_bottom());
  return {"H7 hole", d.text(), 0, 0.015, {{Work::kDrill, 9.8, 20 + kPoint * 9.8}, {Work::kReam, 10, 21}}};
}

// Its core is a blind hole.
Feature tapped_hole() {
  Drawing d("TAPPED HOLE", block(40, 40, 30));
  const auto at = d.placement({20, 20, 0});
  const auto core = d.hole_of("CORE", at, 21, d.length(6.75, 0.15, 0.05), d.conical_bottom(118));
  d.thread("M8", at, 15, core, 8, 1.25);
  return {"tapped hole", d.text(), 0, kZone, {{Work::kDrill, 6.8, 21 + kPoint * 6.8}, {Work::kTap, 8, 15}}};
}

Feature counterbore() {
  Drawing d("COUNTERBORE", block(40, 40, 20));
  const auto bore = d.hole("BORE", d.placement({0, 0, 0}), 6.5, 11, d.flat_bottom());
  const auto core = d.hole("CORE", d.placement({0, 0, -6.5}), 13.5, 6.6, d.through_bottom());
  d.compound("SCREW", d.placement({20, 20, 0}), {bore, core}, "COUNTERBORE_HOLE");
  const double ring = 0.25 * kPi * (11 * 11 - 6.6 * 6.6) * 6.5;
  return {
      "counterbore",
      d.text(),
      0,
      kZone,
      {{Work::kDrill, 6.6, 20 + kPoint * 6.6}, {Work::kRough, 8, ring, 6.5}, {Work::kFinish, 8, kPi * 11}}};
}

/// Roughing with one mill, its walls along the outline once, its floor in rows of half the mill.
std::vector<CatalogueWork> milled(double mill, double floor_mm2, double depth, double walls_mm) {
  return {{Work::kRough, mill, floor_mm2 * depth, depth},
          {Work::kFinish, mill, walls_mm},
          {Work::kFinish, mill, floor_mm2 / (0.5 * mill)}};
}

// Its upper edge is broken by 1 mm.
Feature shallow_pocket() {
  Drawing d("SHALLOW POCKET", block(80, 60, 20));
  const auto p = d.closed_pocket("POCKET", d.placement({40, 30, 0}), 8, d.rectangle(60, 40), 6);
  d.chamfer("EDGE", p, p, 45, 1);
  Feature out{"shallow pocket", d.text(), 0, kZone, milled(12, area(60, 40, 6), 8, outline(60, 40, 6))};
  out.catalogue.push_back({Work::kChamfer, 8, outline(60, 40, 6)});
  return out;
}

Feature deep_pocket() {
  Drawing d("DEEP POCKET", block(70, 56, 42));
  d.closed_pocket("POCKET", d.placement({35, 28, 0}), 30, d.rectangle(50, 36), 5);
  return {"deep pocket", d.text(), 0, kZone, milled(10, area(50, 36, 5), 30, outline(50, 36, 5))};
}

Feature island_pocket() {
  Drawing d("ISLAND POCKET", block(90, 70, 24));
  const auto boss = d.boss("BOSS", d.placement({45, 35, 0}), 10, d.rectangle(22, 16));
  d.closed_pocket("POCKET", d.placement({45, 35, 0}), 10, d.rectangle(70, 50), 5, {boss});
  return {"island pocket", d.text(), 0, kZone,
          milled(10, area(70, 50, 5) - 22 * 16, 10, outline(70, 50, 5) + 2 * (22 + 16))};
}

Feature step() {
  Drawing d("STEP", block(70, 50, 24));
  d.step("STEP", d.placement({58, 0, 0}), 10, 50, {0, 1, 0});
  return {"step", d.text(), 0, 0, milled(16, 12 * 50, 10, 50)};
}

Feature slot() {
  Drawing d("SLOT", block(60, 40, 20));
  d.slot("SLOT", d.placement({0, 20, 0}), 8, d.linear_path(60, {1, 0, 0}), d.square_u(12), "open", "open");
  return {"slot", d.text(), 0, kZone, milled(10, 12 * 60, 8, 2 * 60)};
}

// Two passes of a mill of 50 mm.
Feature face() {
  Drawing d("FACE", block(80, 60, 20, 2));
  d.face("FACE", 0, 0, 80, 60, 2, 2);
  return {"face", d.text(), 0, 0, {{Work::kFace, 50, 2 * (80 + 50)}}};
}

Feature contour() {
  Drawing d("CONTOUR", block(80, 60, 24));
  std::vector<std::pair<Drawing::Id, bool>> curve;
  const double x = 30, y = 20, r = 8;
  const auto line = [&](Point a, Point b) { curve.emplace_back(d.polyline({a, b}), true); };
  const auto arc = [&](Point c, double from, double to) {
    curve.emplace_back(d.arc(c, r, from, to, true), true);
  };
  line({-x + r, -y, 0}, {x - r, -y, 0});
  arc({x - r, -y + r, 0}, 270, 360);
  line({x, -y + r, 0}, {x, y - r, 0});
  arc({x - r, y - r, 0}, 0, 90);
  line({x - r, y, 0}, {-x + r, y, 0});
  arc({-x + r, y - r, 0}, 90, 180);
  line({-x, y - r, 0}, {-x, -y + r, 0});
  arc({-x + r, -y + r, 0}, 180, 270);
  d.outside("CONTOUR", d.placement({40, 30, 0}), 12, d.closed(d.composite(curve)));
  return {"contour", d.text(), 0, 0,
          milled(16, 80 * 60 - area(2 * x, 2 * y, r), 12, outline(2 * x, 2 * y, r))};
}

// A dome of 30 x 24 mm, 4 mm high, on a block of 12 mm: its walls stand upright, and 1 mm is left all round.
Feature freeform() {
  constexpr int kColumns = 20, kRows = 16;
  constexpr double kX = 30, kY = 24, kHigh = 4, kFoot = -12, kRaw = 1;
  std::ostringstream out;
  const auto triangle = [&](Point a, Point b, Point c) {
    out << "facet normal 0 0 0\nouter loop\n";
    for (const Point& p : {a, b, c}) out << "vertex " << p.x << ' ' << p.y << ' ' << p.z << '\n';
    out << "endloop\nendfacet\n";
  };
  const auto at = [&](int i, int j) {
    const double x = kX * i / kColumns, y = kY * j / kRows;
    return Point{x, y, kHigh * (std::sin(kPi * x / kX) * std::sin(kPi * y / kY) - 1.0)};
  };
  const auto foot = [&](Point p) { return Point{p.x, p.y, kFoot}; };
  out << "solid dome\n";
  for (int j = 0; j < kRows; ++j) {
    for (int i = 0; i < kColumns; ++i) {
      triangle(at(i, j), at(i + 1, j), at(i + 1, j + 1));
      triangle(at(i, j), at(i + 1, j + 1), at(i, j + 1));
    }
  }
  std::vector<Point> rim;
  for (int i = 0; i < kColumns; ++i) rim.push_back(at(i, 0));
  for (int j = 0; j < kRows; ++j) rim.push_back(at(kColumns, j));
  for (int i = kColumns; i > 0; --i) rim.push_back(at(i, kRows));
  for (int j = kRows; j > 0; --j) rim.push_back(at(0, j));
  const Point middle{0.5 * kX, 0.5 * kY, kFoot};
  for (std::size_t i = 0; i < rim.size(); ++i) {
    const Point a = rim[i], b = rim[(i + 1) % rim.size()];
    triangle(foot(a), foot(b), b);
    triangle(foot(a), b, a);
    triangle(middle, foot(b), foot(a));
  }
  out << "endsolid dome\n";
  // The mean of a product of two half sine waves is (2 / pi)^2.
  const double over = kX * kY * (kHigh * (1.0 - 4.0 / (kPi * kPi)) + kRaw);
  const double around = ((kX + 2 * kRaw) * (kY + 2 * kRaw) - kX * kY) * -kFoot;
  // Rows of 0.4 mm with a ball of 8 mm leave scallops of 0.4^2 / (4 x 8) = 0.005 mm.
  return {"freeform",
          out.str(),
          kRaw,
          0,
          {{Work::kRough, 10, over, kHigh + kRaw},
           {Work::kRough, 10, around, -kFoot},
           {Work::kFinish, 10, 2 * (kX + kY)},
           {Work::kBall, 8, kX * kY / 0.4}}};
}

}  // namespace

const std::vector<Feature>& features() {
  static const std::vector<Feature> all = {through_hole(),   reamed_hole(), tapped_hole(),   counterbore(),
                                           shallow_pocket(), deep_pocket(), island_pocket(), step(),
                                           slot(),           face(),        contour(),       freeform()};
  return all;
}

}  // namespace capstan::testing::sweep

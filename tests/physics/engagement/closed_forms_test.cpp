#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <functional>
#include <numbers>

#include "planner/physics/engagement/engagement.h"
#include "planner/physics/stock/sweep.h"

// Paths at 27 degrees to the grid, cells of D / 100, against closed forms.

namespace capstan::engagement {
namespace {

using geometry::Vec2;
using geometry::Vec3;
using model::Cutter;
using model::CutterClass;
using model::CutterPath;
using model::MoveRole;

constexpr double kPi = std::numbers::pi;
constexpr double kSkew = 27.0 * kPi / 180.0;
const Vec2 kAlong{std::cos(kSkew), std::sin(kSkew)};
const Vec2 kLeft{-std::sin(kSkew), std::cos(kSkew)};
const Vec2 kFrom{15.13, 12.07};

Cutter cutter(CutterClass kind, double diameter, double corner = 0.0, double point = 0.0) {
  Cutter c;
  c.id = "t";
  c.cutter_class = kind;
  c.cutting_diameter_mm = diameter;
  c.corner_radius_mm = corner;
  c.point_angle_rad = point;
  c.maximum_depth_of_cut_mm = 30.0;
  return c;
}

stock::HeightMap block(double cell = 0.1) { return stock::from_box({{0, 0, -20}, {80, 60, 0}}, cell); }

/// Takes away, down to z, what lies where `free` says; s along the path, x to its right.
void carve(stock::HeightMap& map, double z, const std::function<bool(double s, double x)>& free) {
  constexpr int kSub = 10;
  for (int iy = 0; iy < map.ny; ++iy) {
    for (int ix = 0; ix < map.nx; ++ix) {
      int hits = 0;
      for (int k = 0; k < kSub * kSub; ++k) {
        const Vec2 p{map.x_of(ix) + map.cell_mm * ((k % kSub + 0.5) / kSub - 0.5),
                     map.y_of(iy) + map.cell_mm * ((k / kSub + 0.5) / kSub - 0.5)};
        hits += free(dot(p - kFrom, kAlong), -dot(p - kFrom, kLeft)) ? 1 : 0;
      }
      if (hits == 0) continue;
      const auto low = static_cast<float>(z - map.origin.z);
      const float top = map.at(ix, iy).top_mm;
      const float share = static_cast<float>(hits) / static_cast<float>(kSub * kSub);
      map.set(ix, iy, hits == kSub * kSub ? stock::Column{low, low, 0.0F} : stock::Column{top, low, share});
    }
  }
}

CutterPath straight(double z, double from, double to, double right = 0.0) {
  const auto at = [&](double s) {
    const Vec2 p = kFrom + s * kAlong - right * kLeft;
    return Vec3{p.x, p.y, z};
  };
  CutterPath p;
  p.start(at(from));
  p.line(at(to), MoveRole::kCut);
  return p;
}

double allowed(double csa, double ap, double diameter) { return std::max(0.01 * csa, 0.005 * ap * diameter); }

/// Mean of a function over a step, Simpson.
double mean(const std::function<double(double)>& f, double to, double step) {
  double sum = 0.0;
  constexpr int kParts = 8;
  for (int k = 0; k <= kParts; ++k) {
    const double weight = k == 0 || k == kParts ? 1.0 : (k % 2 == 1 ? 4.0 : 2.0);
    sum += weight * f(to - step + step * k / kParts);
  }
  return sum / (3.0 * kParts);
}

TEST(BlockEdge, SectionAndAnglesAreFunctionsOfThePosition) {
  // Out of the air, slantwise through the face x = 0 of the block. A rim point at phi from +x is inside where
  // cos(phi) > -x / R; in front where phi is within a quarter turn of the feed. Projected across the feed
  // that is R (sin(psi - lo) - sin(psi - hi)).
  auto map = block();
  const double r = 5.0, ap = 2.0;
  CutterPath p;
  const Vec2 start{-7.0, 20.0};
  p.start({start.x, start.y, -ap});
  p.line({start.x + 25.0 * kAlong.x, start.y + 25.0 * kAlong.y, -ap}, MoveRole::kCut);
  const auto m = measure(p, cutter(CutterClass::kEndmill, 2.0 * r), map);
  ASSERT_TRUE(m);
  const auto sides = [&](double s) {
    const double x = start.x + s * kAlong.x;
    const double beta = std::acos(std::clamp(-x / r, -1.0, 1.0));
    const double lo = std::max(-beta, kSkew - 0.5 * kPi), hi = std::min(beta, kSkew + 0.5 * kPi);
    return std::array<double, 2>{r * std::sin(kSkew - hi), r * std::sin(kSkew - lo)};
  };
  double worst = 0.0, worst_angle = 0.0;
  int n = 0;
  for (std::size_t i = 0; i < m->sections.size(); ++i) {
    const Engagement& e = m->engagement[i];
    const double at = m->sections.at_mm[i];
    if (at > 12.0 || e.removed_mm3 <= 0.0) continue;
    const double expected = mean([&](double s) { return ap * (sides(s)[1] - sides(s)[0]); }, at, e.step_mm);
    worst = std::max(worst, std::abs(e.csa_mm2 - expected));
    EXPECT_LT(std::abs(e.csa_mm2 - expected), allowed(expected, ap, 2.0 * r)) << at;
    ++n;
    const auto [left, right] = sides(at);
    if (expected < 2.0) continue;  // the first touch
    const double entry = std::acos(-left / r), exit = std::acos(-right / r);
    worst_angle = std::max({worst_angle, std::abs(e.entry_rad - entry), std::abs(e.exit_rad - exit)});
    EXPECT_NEAR(e.arc_rad, e.exit_rad - e.entry_rad, 1e-9);
  }
  EXPECT_GT(n, 20);
  EXPECT_LT(worst_angle, 0.2);  // a cell in X, abeam where the cosine is flat
  std::printf("[ figures  ] into a block: CSA within %.4f mm2 of up to 20, angles within %.3f rad\n", worst,
              worst_angle);
}

TEST(BlockEdge, WhatIsLeftOnBothSidesOfTheWayOutIsTwoArcs) {
  // The block ends at s = 20, square to the feed: beyond, only what lies abeam and behind stands.
  auto map = block();
  carve(map, -20.0, [](double s, double) { return s > 20.0; });
  const double r = 5.0, ap = 2.0;
  const auto m = measure(straight(-ap, 0.0, 30.0), cutter(CutterClass::kEndmill, 2.0 * r), map);
  ASSERT_TRUE(m);
  int n = 0;
  for (std::size_t i = 0; i < m->sections.size(); ++i) {
    const Engagement& e = m->engagement[i];
    const double out = m->sections.at_mm[i] - e.step_mm + r - 20.0;  // of the front, as the step begins
    if (out < 1.0 || out > 4.0) continue;
    const auto free = [&](double s) { return std::sqrt(r * r - (20.0 - s) * (20.0 - s)); };
    const double csa =
        mean([&](double s) { return 2.0 * ap * (r - free(s)); }, m->sections.at_mm[i], e.step_mm);
    EXPECT_LT(std::abs(e.csa_mm2 - csa), allowed(csa, ap, 2.0 * r));
    // From 0 to half and from the other half to pi, as the step begins.
    const double half = std::acos(free(m->sections.at_mm[i] - e.step_mm) / r);
    EXPECT_NEAR(e.entry_rad, 0.0, 0.05);
    EXPECT_NEAR(e.exit_rad, kPi, 0.05);
    EXPECT_NEAR(e.arc_rad, 2.0 * half, 0.25);  // both arcs lie abeam, where the cosine is flat
    EXPECT_LT(e.arc_rad, e.exit_rad - e.entry_rad - 0.5);
    ++n;
  }
  EXPECT_GT(n, 8);
}

TEST(ThinWalls, TwoRibsAreTwoArcs) {
  auto map = block();
  carve(map, -20.0, [](double, double x) { return !((x > -4.0 && x < -2.0) || (x > 1.0 && x < 3.0)); });
  const auto m = measure(straight(-3.0, 0.0, 30.0), cutter(CutterClass::kEndmill, 10.0), map);
  ASSERT_TRUE(m);
  const Engagement& e = m->engagement[m->engagement.size() / 2];
  EXPECT_NEAR(e.csa_mm2, 12.0, allowed(12.0, 3.0, 10.0));
  EXPECT_NEAR(e.entry_rad, std::acos(0.8), 0.05);
  EXPECT_NEAR(e.exit_rad, std::acos(-0.6), 0.05);
  const double arcs = std::acos(0.4) - std::acos(0.8) + std::acos(-0.6) - std::acos(-0.2);
  EXPECT_NEAR(e.arc_rad, arcs, 0.12);
}

TEST(Steps, ContactAtTwoDepthsSpansBothInAngleAndTheDeeperInDepth) {
  // 4 mm to the left of the axis stand 2 mm above the tip, 2 mm on the right stand 5 mm.
  auto map = block();
  carve(map, -3.0, [](double, double x) { return x < 3.0; });
  carve(map, -20.0, [](double, double x) { return x > -1.0 && x < 3.0; });
  const auto m = measure(straight(-5.0, 0.0, 30.0), cutter(CutterClass::kEndmill, 10.0), map);
  ASSERT_TRUE(m);
  const std::size_t i = m->engagement.size() / 2;
  EXPECT_NEAR(m->engagement[i].csa_mm2, 4.0 * 2.0 + 2.0 * 5.0, allowed(18.0, 5.0, 10.0));
  EXPECT_NEAR(m->sections.ad_max_mm[i], 5.0, 0.01);
  EXPECT_NEAR(m->sections.y_max_ofs_mm[i], 2.5, 0.01);
  EXPECT_NEAR(m->engagement[i].entry_rad, 0.0, 0.05);
  EXPECT_NEAR(m->engagement[i].exit_rad, kPi, 0.05);
  const double arcs = std::acos(0.2) + kPi - std::acos(-0.6);
  EXPECT_NEAR(m->engagement[i].arc_rad, arcs, 0.12);
}

TEST(Corner, EngagementRisesTowardsAnInsideCorner) {
  // A wall on the left is cut ae deep; a wall ahead stands at s = 20.
  const double r = 5.0, ap = 3.0, ae = 1.0;
  auto map = block();
  carve(map, -20.0, [&](double s, double x) { return s < 20.0 && x > ae - r; });
  const auto m = measure(straight(-ap, 5.0, 19.0), cutter(CutterClass::kEndmill, 2.0 * r), map);
  ASSERT_TRUE(m);
  double worst = 0.0, last = 0.0;
  for (std::size_t i = 0; i < m->sections.size(); ++i) {
    const double at = m->sections.at_mm[i];
    const auto csa = [&](double s) {
      const double gap = 20.0 - (5.0 + s);
      const double half = gap >= r ? 0.0 : std::sqrt(r * r - gap * gap);
      // Left wall: X in [-r, ae - r]; wall ahead: |X| < half. Their union.
      return ap * (std::max(half, r - ae) <= r - ae ? ae + 2.0 * half : r + half);
    };
    const double expected = mean(csa, at, m->engagement[i].step_mm);
    worst = std::max(worst, std::abs(m->sections.csa_mm2[i] - expected));
    EXPECT_LT(std::abs(m->sections.csa_mm2[i] - expected), allowed(expected, ap, 2.0 * r)) << at;
    last = m->sections.csa_mm2[i];
  }
  EXPECT_GT(last, 8.0 * ap * ae);
  std::printf("[ figures  ] corner: CSA within %.4f mm2, from %.1f to %.1f\n", worst, ap * ae, last);
}

TEST(Shoulder, UpAndDownCutAreMirrored) {
  const double ae = 2.0, ap = 3.0;
  std::array<Engagement, 2> both;
  for (const int side : {-1, 1}) {
    auto map = block();
    carve(map, -20.0, [&](double, double x) { return side * x < 5.0 - ae; });
    const auto m = measure(straight(-ap, 0.0, 30.0), cutter(CutterClass::kEndmill, 10.0), map);
    ASSERT_TRUE(m);
    const std::size_t i = m->engagement.size() / 2;
    both.at(side < 0 ? 0 : 1) = m->engagement[i];
    EXPECT_NEAR(m->sections.x_cg_ofs_mm[i], side * (5.0 - 0.5 * ae), 0.02);
    EXPECT_NEAR(m->sections.x_max_ofs_mm[i], side * (5.0 - 0.5 * ae), 0.02);
    EXPECT_NEAR(m->sections.y_cg_ofs_mm[i], 0.5 * ap, 0.01);
    EXPECT_NEAR(m->sections.y_max_ofs_mm[i], 0.5 * ap, 0.01);
    EXPECT_NEAR(m->sections.rd_max_mm[i], ae, 0.02);
    EXPECT_NEAR(m->sections.ad_max_mm[i], ap, 0.01);
  }
  // Material on the left (up-cut for a tooth that turns clockwise): it comes in at 0, with no chip.
  EXPECT_NEAR(both[0].entry_rad, 0.0, 0.02);
  EXPECT_NEAR(both[0].exit_rad, std::acos(1.0 - 2.0 * ae / 10.0), 0.02);
  EXPECT_NEAR(both[1].entry_rad, kPi - both[0].exit_rad, 0.02);
  EXPECT_NEAR(both[1].exit_rad, kPi, 0.02);
}

TEST(BallInPlane, SevenParametersMatchTheCircularSegment) {
  const double r = 5.0, ap = 1.0;
  auto map = block();
  const auto m = measure(straight(-ap, 0.0, 30.0), cutter(CutterClass::kBallEndmill, 2.0 * r, r), map);
  ASSERT_TRUE(m);
  const std::size_t i = m->engagement.size() - 3;
  const double half = std::acos((r - ap) / r);
  const double down = 4.0 * r * std::pow(std::sin(half), 3) / (3.0 * (2.0 * half - std::sin(2.0 * half)));
  const auto& s = m->sections;
  EXPECT_NEAR(s.ad_max_mm[i], ap, 0.01);
  EXPECT_NEAR(s.rd_max_mm[i], 2.0 * std::sqrt(ap * (2.0 * r - ap)), 0.1);
  EXPECT_NEAR(s.x_max_ofs_mm[i], 0.0, 0.05);
  EXPECT_NEAR(s.y_max_ofs_mm[i], 0.5 * ap, 0.01);
  EXPECT_NEAR(s.x_cg_ofs_mm[i], 0.0, 0.01);
  EXPECT_NEAR(s.y_cg_ofs_mm[i], r - down, 0.01);
}

TEST(FaceMill, ALeadAngleMakesATrapezium) {
  Cutter c = cutter(CutterClass::kFacemill, 40.0);
  c.lead_angle_rad = 45.0 * kPi / 180.0;
  c.maximum_depth_of_cut_mm = 6.0;
  auto map = stock::from_box({{0, 0, -20}, {160, 130, 0}}, 0.4);
  CutterPath p;
  p.start({40.0, 40.0, -3.0});
  p.line({40.0 + 60.0 * kAlong.x, 40.0 + 60.0 * kAlong.y, -3.0}, MoveRole::kCut);
  const auto m = measure(p, c, map);
  ASSERT_TRUE(m);
  const double csa = 3.0 * (40.0 + 3.0);
  const std::size_t i = m->engagement.size() - 3;
  EXPECT_NEAR(m->sections.csa_mm2[i], csa, 0.01 * csa);
  EXPECT_NEAR(m->sections.rd_max_mm[i], 46.0, 0.4);
  EXPECT_NEAR(m->sections.y_cg_ofs_mm[i], 3.0 / 3.0 * (40.0 + 2.0 * 46.0) / (40.0 + 46.0), 0.01);
  std::printf("[ figures  ] face mill, 45 degrees: CSA %.4f %% off\n",
              100.0 * (m->sections.csa_mm2[i] / csa - 1.0));
}

TEST(ChamferMill, AnEdgeIsATriangle) {
  // A 90 degree cutter with a 2 mm tip runs beside a wall 2 mm from its axis, its tip 2 mm below the top: at
  // the top its radius is 3 mm, so that a triangle with legs of 1 mm goes.
  Cutter c = cutter(CutterClass::kChamferMill, 10.0, 0.0, 0.5 * kPi);
  c.tip_diameter_mm = 2.0;
  auto map = block();
  carve(map, -20.0, [](double, double x) { return x < 2.0; });
  const auto m = measure(straight(-2.0, 0.0, 30.0), c, map);
  ASSERT_TRUE(m);
  for (std::size_t i = m->engagement.size() / 3; i + 1 < m->engagement.size(); ++i) {
    EXPECT_NEAR(m->sections.csa_mm2[i], 0.5, allowed(0.5, 1.0, 10.0));
    EXPECT_NEAR(m->sections.ad_max_mm[i], 1.0, 0.2);
    EXPECT_NEAR(m->sections.x_cg_ofs_mm[i], 2.0 + 1.0 / 3.0, 0.05);
    EXPECT_NEAR(m->sections.y_cg_ofs_mm[i], 2.0 - 1.0 / 3.0, 0.05);
  }
}

TEST(Plunge, ABallsContactIsTheCircleItHasReached) {
  auto map = block();
  CutterPath p;
  p.start({30.03, 30.07, 0.0});
  p.line({30.03, 30.07, -4.0}, MoveRole::kPlunge);
  const auto m = measure(p, cutter(CutterClass::kBallEndmill, 10.0, 5.0), map);
  ASSERT_TRUE(m);
  const auto volume = [](double h) { return kPi * h * h * (5.0 - h / 3.0); };
  for (std::size_t i = 1; i < m->sections.size(); ++i) {
    const double h = m->sections.at_mm[i], step = m->engagement[i].step_mm;
    if (m->engagement[i].removed_mm3 <= 0.0) continue;
    const double area = (volume(h) - volume(h - step)) / step;
    EXPECT_NEAR(m->sections.csa_mm2[i], area, 0.01 * area) << h;
    EXPECT_NEAR(m->sections.rd_max_mm[i], 2.0 * std::sqrt(h * (10.0 - h)), 0.25);
    EXPECT_TRUE(m->engagement[i].plunge);
  }
  EXPECT_NEAR(m->removed_mm3, volume(4.0), 1e-3 * volume(4.0));
}

TEST(Plunge, AFlatCuttersContactIsItsFace) {
  auto map = block();
  CutterPath p;
  p.start({30.03, 30.07, 0.0});
  p.line({30.03, 30.07, -4.0}, MoveRole::kPlunge);
  const auto m = measure(p, cutter(CutterClass::kEndmill, 10.0), map);
  ASSERT_TRUE(m);
  EXPECT_NEAR(m->removed_mm3, 100.0 * kPi, 0.1 * kPi);
  for (const Engagement& e : m->engagement) EXPECT_NEAR(e.csa_mm2, 25.0 * kPi, 0.05);
}

}  // namespace
}  // namespace capstan::engagement

#include "planner/physics/engagement/planar/planar.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <random>

namespace capstan::engagement {
namespace {

using geometry::Box3;
using geometry::Vec2;
using geometry::Vec3;
using model::Cutter;
using model::CutterClass;
using model::CutterPath;
using model::MoveRole;
using stock::PlanarStock;

constexpr double kPi = std::numbers::pi;
constexpr double kSkew = 27.0 * kPi / 180.0;
const Box3 kBlock{{0.0, 0.0, -20.0}, {80.0, 60.0, 0.0}};

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

Vec3 skewed(double s, double left, double z) {
  const Vec2 p = Vec2{15.13, 12.07} + s * Vec2{std::cos(kSkew), std::sin(kSkew)} +
                 left * Vec2{-std::sin(kSkew), std::cos(kSkew)};
  return {p.x, p.y, z};
}

CutterPath line(double left, double z, double length) {
  CutterPath p;
  p.start(skewed(0.0, left, 10.0));
  p.rapid(skewed(0.0, left, 5.0));
  p.line(skewed(0.0, left, z), MoveRole::kPlunge);
  p.line(skewed(length, left, z), MoveRole::kCut);
  return p;
}

/// Largest relative error of the CSA of the samples of a move between two places.
double worst_csa(const Measurement& m, std::uint32_t move, double lo, double hi, double expected) {
  double worst = 0.0;
  int n = 0;
  for (std::size_t i = 0; i < m.sections.size(); ++i) {
    if (m.sections.move[i] != move || m.sections.at_mm[i] < lo || m.sections.at_mm[i] > hi) continue;
    worst = std::max(worst, std::abs(m.sections.csa_mm2[i] / expected - 1.0));
    ++n;
  }
  EXPECT_GT(n, 0);
  return worst;
}

TEST(PlanarSlot, EverythingIsThatOfAFullCut) {
  auto stock = PlanarStock::from_box(kBlock);
  const auto m = measure(line(0.0, -3.0, 40.0), cutter(CutterClass::kEndmill, 10.0), stock);
  ASSERT_TRUE(m);
  EXPECT_LT(worst_csa(*m, 3, 0.0, 40.0, 30.0), 1e-6);
  EXPECT_LT(worst_csa(*m, 2, 5.3, 8.0, 25.0 * kPi), 1e-6);  // the plunge
  const auto& s = m->sections;
  const std::size_t last = s.size() - 1;
  EXPECT_NEAR(s.ad_max_mm[last], 3.0, 1e-8);
  EXPECT_NEAR(s.rd_max_mm[last], 10.0, 1e-6);
  EXPECT_NEAR(s.x_cg_ofs_mm[last], 0.0, 1e-6);
  EXPECT_NEAR(s.y_cg_ofs_mm[last], 1.5, 1e-6);
  EXPECT_NEAR(m->engagement[last].arc_rad, kPi, 1e-3);
  EXPECT_EQ(m->rapid_removed_mm3, 0.0);
  EXPECT_NEAR(m->removed_mm3, 3.0 * (400.0 + 25.0 * kPi), 1e-4);
}

TEST(PlanarShoulder, WidthAnglesAndCentreMatchAtAnyWidthAndSide) {
  const Cutter c = cutter(CutterClass::kEndmill, 10.0);
  for (const double side : {-1.0, 1.0}) {
    for (const double ae : {0.01, 0.1, 0.5, 2.0, 5.0, 8.0, 9.99}) {
      auto stock = PlanarStock::from_box(kBlock);
      ASSERT_TRUE(measure(line(0.0, -3.0, 40.0), c, stock));
      const auto m = measure(line(side * ae, -3.0, 40.0), c, stock);
      ASSERT_TRUE(m);
      // Beyond a radius from either end of the first slot.
      EXPECT_LT(worst_csa(*m, 3, 10.0, 34.0, 3.0 * ae), 1e-6) << ae;
      for (std::size_t i = 0; i < m->sections.size(); ++i) {
        if (m->sections.move[i] != 3 || m->sections.at_mm[i] < 10.0 || m->sections.at_mm[i] > 34.0) continue;
        const auto& e = m->engagement[i];
        EXPECT_NEAR(e.ae_mm, ae, 1e-6);
        EXPECT_NEAR(m->sections.x_cg_ofs_mm[i], -side * (5.0 - 0.5 * ae), 1e-6);
        const double inner = std::acos((5.0 - ae) / 5.0);
        EXPECT_NEAR(e.entry_rad, side > 0.0 ? 0.0 : kPi - inner, 1e-6) << ae;
        EXPECT_NEAR(e.exit_rad, side > 0.0 ? inner : kPi, 1e-6) << ae;
      }
    }
  }
}

/// Area of the part of a disc with x < d.
double segment(double radius, double d) {
  const double k = std::clamp(d, -radius, radius);
  return radius * radius * (kPi - std::acos(k / radius)) + k * std::sqrt((radius - k) * (radius + k));
}

TEST(PlanarBlockEdge, EnteringAndLeavingAreFunctionsOfThePosition) {
  auto stock = PlanarStock::from_box(kBlock);
  CutterPath p;
  p.start({-10.0, 30.0, -2.0});
  p.line({90.0, 30.0, -2.0}, MoveRole::kCut);
  const auto m = measure(p, cutter(CutterClass::kEndmill, 10.0), stock, {.step_mm = 0.5});
  ASSERT_TRUE(m);
  // Removed up to x: the swept band inside the block, its front half round.
  const auto removed = [](double x) {
    const auto beyond = [&](double edge) {  // of a band that ends in a half circle about x
      const double d = edge - x;            // area of the band ahead of the edge
      if (d >= 5.0) return 0.0;
      if (d >= 0.0) return 25.0 * kPi - segment(5.0, d);
      return -10.0 * d + 12.5 * kPi;
    };
    return 2.0 * (beyond(0.0) - beyond(80.0));
  };
  int entering = 0;
  for (std::size_t i = 0; i < m->sections.size(); ++i) {
    const double x = m->sections.at_mm[i] - 10.0;
    const auto& e = m->engagement[i];
    if (e.removed_mm3 == 0.0) continue;
    EXPECT_NEAR(e.removed_mm3, removed(x) - removed(x - 0.5), 1e-5) << x;  // 5e-7 of D ap
    if (x < 0.0) {                                                         // widest at the end of the step
      ++entering;
      const double half = std::acos(-x / 5.0);
      EXPECT_NEAR(e.entry_rad, kPi / 2.0 - half, 1e-6) << x;
      EXPECT_NEAR(e.exit_rad, kPi / 2.0 + half, 1e-6) << x;
    }
  }
  EXPECT_GE(entering, 9);
  EXPECT_NEAR(m->removed_mm3, 2.0 * 10.0 * 80.0, 1e-4);
  EXPECT_EQ(m->engagement.back().removed_mm3, 0.0);  // the cut is closed
}

TEST(PlanarCorner, WidthIsThatOfTheCircleInTheRoundedCorner) {
  // Round a square: passes 3 mm inside a slot of the same cutter, into a right inner corner.
  auto stock = PlanarStock::from_box(kBlock);
  const Cutter c = cutter(CutterClass::kEndmill, 10.0);
  const double ae = 3.0;
  CutterPath first;
  first.start(skewed(0.0, 0.0, -2.0));
  first.line(skewed(25.0, 0.0, -2.0), MoveRole::kCut);
  first.line(skewed(25.0, 20.0, -2.0), MoveRole::kCut);
  ASSERT_TRUE(measure(first, c, stock));
  CutterPath second;
  second.start(skewed(8.0, -ae, -2.0));
  second.line(skewed(25.0 + ae, -ae, -2.0), MoveRole::kCut);
  const auto m = measure(second, c, stock, {.step_mm = 0.01});
  ASSERT_TRUE(m);
  // In the frame of the pass (u along, v left, v = 0 at the first pass): the cutter stands at (u, -ae). What
  // was cut is within 5 of the first pass, which here is the ray v = 0, u <= 25 and its corner disc.
  for (std::size_t i = 0; i < m->sections.size(); ++i) {
    const double u = 8.0 + m->sections.at_mm[i] - 0.005;  // middle of the step
    if (u < 14.0 || u > 25.99) continue;  // beyond, the far wall of the first pass is met, too
    // Left end of the contact: front circle (u + y, -ae - x) meets the edge v = -5 (before the corner disc
    // begins at u = 25) or the disc about (25, 0), whichever the point lies at.
    double x = 5.0 - ae;
    if (u + std::sqrt(25.0 - x * x) > 25.0) {
      // Circles of radius 5 about (25, 0) and (u, -ae): the point farther right of the line between them.
      const double dx = 25.0 - u;
      const double d = std::hypot(dx, ae);
      const double half = std::sqrt(25.0 - 0.25 * d * d);
      const double v = -0.5 * ae - dx / d * half;  // the crossing that lies on the right and ahead
      x = -ae - v;
    }
    EXPECT_NEAR(m->sections.csa_mm2[i], 2.0 * (5.0 - x), 1e-4) << u;
  }
}

TEST(PlanarWall, AirBetweenTwoContactsIsNoArcOfContact) {
  // A slot of 6 mm, then a cutter of 10 mm down its middle: 2 mm on either side.
  auto stock = PlanarStock::from_box(kBlock);
  ASSERT_TRUE(measure(line(0.0, -3.0, 40.0), cutter(CutterClass::kEndmill, 6.0), stock));
  const auto m = measure(line(0.0, -3.0, 40.0), cutter(CutterClass::kEndmill, 10.0), stock);
  ASSERT_TRUE(m);
  EXPECT_LT(worst_csa(*m, 3, 10.0, 34.0, 12.0), 1e-6);
  for (std::size_t i = 0; i < m->sections.size(); ++i) {
    if (m->sections.move[i] != 3 || m->sections.at_mm[i] < 10.0 || m->sections.at_mm[i] > 34.0) continue;
    EXPECT_NEAR(m->engagement[i].arc_rad, 2.0 * std::acos(3.0 / 5.0), 1e-6);
    EXPECT_NEAR(m->engagement[i].entry_rad, 0.0, 1e-6);
    EXPECT_NEAR(m->engagement[i].exit_rad, kPi, 1e-6);
    EXPECT_NEAR(m->sections.x_cg_ofs_mm[i], 0.0, 1e-6);
  }
}

TEST(PlanarArc, SlotAndRingOnAnArcFollowPappus) {
  for (const double radius : {6.0, 17.0}) {
    for (const bool clockwise : {false, true}) {
      auto stock = PlanarStock::from_box(kBlock);
      const Cutter c = cutter(CutterClass::kEndmill, 10.0);
      CutterPath p;
      p.start({40.0 - radius, 30.0, -2.0});
      p.arc({40.0 + radius, 30.0, -2.0}, {40.0, 30.0}, clockwise, MoveRole::kCut);
      const auto m = measure(p, c, stock);
      ASSERT_TRUE(m);
      EXPECT_LT(worst_csa(*m, 1, 0.0, radius * kPi * 0.45, 20.0), 1e-6) << radius;
    }
  }
  // A ring 1 mm wide at radius 12 around a disc that is open already: area over the length of the centre's
  // way.
  auto stock = PlanarStock::from_box(kBlock);
  const Cutter c = cutter(CutterClass::kEndmill, 10.0);
  CutterPath p;
  p.start({40.0, 30.0, -2.0});
  for (const double r : {4.0, 6.0}) {
    p.line({40.0 + r, 30.0, -2.0}, MoveRole::kCut);
    p.arc({40.0 + r, 30.0, -2.0}, {40.0, 30.0}, false, MoveRole::kCut);
  }
  p.line({47.0, 30.0, -2.0}, MoveRole::kCut);
  p.arc({47.0, 30.0, -2.0}, {40.0, 30.0}, false, MoveRole::kCut);
  const auto m = measure(p, c, stock);
  ASSERT_TRUE(m);
  const double area = kPi * (12.0 * 12.0 - 11.0 * 11.0);
  EXPECT_LT(worst_csa(*m, 6, 8.0, 2.0 * kPi * 7.0 - 8.0, 2.0 * area / (2.0 * kPi * 7.0)), 1e-6);
  const double removed = m->removed_mm3 + m->rapid_removed_mm3;
  EXPECT_NEAR(removed, 2.0 * kPi * 144.0, 1e-6 * removed);
  EXPECT_NEAR(stock.volume(), 80.0 * 60.0 * 20.0 - 2.0 * kPi * 144.0, 1e-3);
}

CutterPath pocket(double stepover, double depth, int levels) {
  CutterPath p;
  p.start(skewed(0.0, 0.0, 5.0));
  for (int level = 1; level <= levels; ++level) {
    const double z = -depth * level / levels;
    p.line(skewed(0.0, 0.0, z), MoveRole::kPlunge);
    int k = 0;
    for (double left = 0.0; left < 12.0; left += stepover, ++k) {
      p.line(skewed(k % 2 == 0 ? 0.0 : 20.0, left, z), MoveRole::kLink);
      p.line(skewed(k % 2 == 0 ? 20.0 : 0.0, left, z), MoveRole::kCut);
    }
    for (const auto& [s, left] : {std::pair{0.0, 12.0}, {0.0, 0.0}, {20.0, 0.0}, {20.0, 12.0}, {0.0, 12.0}})
      p.line(skewed(s, left, z), MoveRole::kCut);
    p.rapid(skewed(0.0, 12.0, 5.0));
    p.rapid(skewed(0.0, 0.0, 5.0));
  }
  return p;
}

TEST(PlanarPocket, RemovedVolumeIsThatOfThePocketAndTheRestIsTheRest) {
  for (const int levels : {1, 3}) {
    auto stock = PlanarStock::from_box(kBlock);
    const double before = stock.volume();
    EXPECT_NEAR(before, 80.0 * 60.0 * 20.0, 1e-6);
    const auto m = measure(pocket(4.0, 6.0, levels), cutter(CutterClass::kEndmill, 10.0), stock);
    ASSERT_TRUE(m);
    const double expected = 6.0 * (30.0 * 22.0 - (4.0 - kPi) * 25.0);
    EXPECT_NEAR(m->removed_mm3, expected, 1e-6 * expected) << levels;
    EXPECT_NEAR(before - stock.volume(), expected, 2e-6 * expected) << levels;
    EXPECT_EQ(m->rapid_removed_mm3, 0.0);
    EXPECT_NEAR(m->highest_contact_mm, 6.0 / levels, 1e-8);
  }
}

TEST(PlanarRamp, VolumeIsThatOfTheSweptSlot) {
  auto stock = PlanarStock::from_box(kBlock);
  CutterPath p;
  p.start(skewed(0.0, 0.0, 0.0));
  p.line(skewed(40.0, 0.0, -2.0), MoveRole::kRamp);
  const auto m = measure(p, cutter(CutterClass::kEndmill, 10.0), stock);
  ASSERT_TRUE(m);
  // Derived in the height map's test: slope R L^2 and the bottom's two half discs.
  const double expected = 10.0 * (2.0 / 40.0) * 800.0 + 4.0 * kPi * 25.0 / 2.0;
  EXPECT_NEAR(m->removed_mm3, expected, 1e-4 * expected);
  EXPECT_NEAR(80.0 * 60.0 * 20.0 - stock.volume(1e-6), expected, 2e-3 * expected);
}

TEST(PlanarHelix, VolumeIsThatOfTheBoreOnceItsBottomIsCleared) {
  auto stock = PlanarStock::from_box(kBlock);
  CutterPath p;
  p.start({43.0, 30.0, 0.0});
  for (int k = 1; k <= 4; ++k) p.arc({43.0, 30.0, -1.0 * k}, {40.0, 30.0}, false, MoveRole::kRamp);
  p.arc({43.0, 30.0, -4.0}, {40.0, 30.0}, false, MoveRole::kCut);
  const auto m = measure(p, cutter(CutterClass::kEndmill, 10.0), stock);
  ASSERT_TRUE(m);
  const double expected = kPi * 64.0 * 4.0;
  EXPECT_NEAR(m->removed_mm3, expected, 1e-3 * expected);
  EXPECT_NEAR(80.0 * 60.0 * 20.0 - stock.volume(1e-7), expected, 2e-5 * expected);
}

// Deeper than the fall of a turn the cutter touches its bore along a line, no more.
TEST(PlanarHelix, CutsNoDeeperThanItFallsInATurn) {
  auto stock = PlanarStock::from_box(kBlock);
  constexpr double kFall = 1.5;
  CutterPath p;
  p.start({44.5, 30.0, 0.0});
  for (int k = 1; k <= 8; ++k) p.arc({44.5, 30.0, -kFall * k}, {40.0, 30.0}, false, MoveRole::kRamp);
  const auto m = measure(p, cutter(CutterClass::kEndmill, 10.0), stock);
  ASSERT_TRUE(m);
  ASSERT_FALSE(m->sections.ad_max_mm.empty());
  for (std::size_t i = 0; i < m->sections.size(); ++i) {
    EXPECT_LE(m->sections.ad_max_mm[i], 1.1 * kFall) << m->sections.move[i] << " " << m->sections.at_mm[i];
  }
}

// Under the tip stands a ring whose edges lie within the disc: read in lines, it is never even, so that
// halving the way until it is would take hours.
TEST(PlanarHelix, ARingAroundADrilledHoleIsMeasuredWithoutHalvingNoise) {
  auto stock = PlanarStock::from_box(kBlock);
  CutterPath drilled;
  drilled.start({40.0, 30.0, 5.0});
  drilled.line({40.0, 30.0, -6.0}, MoveRole::kDrill);
  ASSERT_TRUE(measure(drilled, cutter(CutterClass::kEndmill, 9.0), stock));
  CutterPath p;
  p.start({41.0, 30.0, 0.0});
  for (int k = 1; k <= 8; ++k) p.arc({41.0, 30.0, -0.5 * k}, {40.0, 30.0}, false, MoveRole::kRamp);
  p.arc({41.0, 30.0, -4.0}, {40.0, 30.0}, false, MoveRole::kCut);
  const auto m = measure(p, cutter(CutterClass::kEndmill, 10.0), stock);
  ASSERT_TRUE(m);
  // Between 9 and 12 mm across, 4 mm deep.
  const double expected = kPi * (36.0 - 20.25) * 4.0;
  EXPECT_NEAR(m->removed_mm3, expected, 3e-3 * expected);
}

// Halvings of the way and of the lines under a ramp are bounded. `unbounded` is the greatest section of the
// same path by this very code with lines and way halved nine times, as far as 1e-6 of the front asks for it,
// edges or not: minutes each. Steps an eighth as long have eight times as many halvings over the same way.
TEST(PlanarHelix, ThePeakSectionOfARingIsThatOfAnUnboundedMeasurementToAThousandth) {
  constexpr double kStep = 0.25;  // a fortieth of the diameter
  struct Ring {
    double offset, unbounded;
  };
  for (const auto& [offset, unbounded] : {Ring{1.0, 3.925026}, Ring{0.8, 4.163765}, Ring{1.7, 3.619487}}) {
    CutterPath drilled;
    drilled.start({40.0, 30.0, 5.0});
    drilled.line({40.0, 30.0, -6.0}, MoveRole::kDrill);
    CutterPath p;
    const double x = 40.0 + offset;
    p.start({x, 30.0, 0.0});
    for (int k = 1; k <= 8; ++k) p.arc({x, 30.0, -0.5 * k}, {40.0, 30.0}, false, MoveRole::kRamp);
    p.arc({x, 30.0, -4.0}, {40.0, 30.0}, false, MoveRole::kCut);
    struct Peak {
      double csa = 0.0, width = 0.0;
    };
    const auto peak_of = [&](double step) {
      Peak out;
      auto stock = PlanarStock::from_box(kBlock);
      EXPECT_TRUE(measure(drilled, cutter(CutterClass::kEndmill, 9.0), stock));
      const auto m = measure(p, cutter(CutterClass::kEndmill, 10.0), stock, {.step_mm = step});
      EXPECT_TRUE(m);
      std::map<std::pair<std::uint32_t, long>, std::pair<double, double>> at;  // volume, length
      for (std::size_t i = 0; m && i < m->sections.size(); ++i) {
        const auto& e = m->engagement[i];
        out.width = std::max(out.width, e.ae_mm);
        const double middle = m->sections.at_mm[i] - 0.5 * e.step_mm;
        auto& [volume, length] = at[{m->sections.move[i], static_cast<long>(middle / kStep)}];
        volume += e.removed_mm3;
        length += e.step_mm;
      }
      for (const auto& [where, cut] : at) {
        if (cut.second > 0.5 * kStep) out.csa = std::max(out.csa, cut.first / cut.second);
      }
      return out;
    };
    const Peak plain = peak_of(kStep), fine = peak_of(kStep / 8.0);
    EXPECT_NEAR(plain.csa, unbounded, 1e-3 * unbounded) << offset;
    EXPECT_NEAR(plain.csa, fine.csa, 1e-3 * unbounded) << offset;
    EXPECT_NEAR(plain.width, fine.width, 1e-3 * fine.width) << offset;
  }
}

TEST(PlanarDrill, HoleIsConeAndCylinderAndPecksTakeNothingTwice) {
  const double tip = 5.0 / std::tan(59.0 * kPi / 180.0);
  const double area = kPi * 25.0;
  auto stock = PlanarStock::from_box(kBlock);
  CutterPath p;
  p.start({30.0, 30.0, 5.0});
  p.line({30.0, 30.0, -tip - 2.0}, MoveRole::kDrill);
  p.rapid({30.0, 30.0, 5.0});
  p.rapid({30.0, 30.0, -tip - 1.5});
  p.line({30.0, 30.0, -tip - 4.0}, MoveRole::kDrill);
  const auto m = measure(p, cutter(CutterClass::kTwistDrill, 10.0, 0.0, 118.0 * kPi / 180.0), stock);
  ASSERT_TRUE(m);
  EXPECT_NEAR(m->rapid_removed_mm3, 0.0, 1e-6);
  const double expected = area * 4.0 + area * tip / 3.0;
  EXPECT_NEAR(m->removed_mm3, expected, 1e-3 * expected);
  EXPECT_LT(worst_csa(*m, 1, 5.0 + tip + 0.3, 5.0 + tip + 2.0, area), 1e-3);
  EXPECT_TRUE(m->engagement.back().plunge);
  EXPECT_NEAR(m->sections.ad_max_mm.back(), tip, 0.1 * tip);
  EXPECT_NEAR(m->engagement.back().ae_mm, 10.0, 1e-9);
}

TEST(PlanarMeasure, BelowThePieceThereIsNothingToCut) {
  auto stock = PlanarStock::from_box(kBlock);
  const double tip = 5.0 / std::tan(59.0 * kPi / 180.0);
  CutterPath p;
  p.start({30.0, 30.0, 1.0});
  p.line({30.0, 30.0, -20.0 - tip - 2.0}, MoveRole::kDrill);
  const auto drill = measure(p, cutter(CutterClass::kTwistDrill, 10.0, 0.0, 118.0 * kPi / 180.0), stock);
  ASSERT_TRUE(drill);
  EXPECT_NEAR(drill->removed_mm3, kPi * 25.0 * 20.0, 1e-4 * drill->removed_mm3);
  CutterPath around;
  around.start({-10.0, 0.0, -23.0});
  around.line({90.0, 0.0, -23.0}, MoveRole::kCut);
  const auto m = measure(around, cutter(CutterClass::kEndmill, 10.0), stock);
  ASSERT_TRUE(m);
  EXPECT_LT(worst_csa(*m, 1, 20.0, 80.0, 5.0 * 20.0), 1e-6);
  const std::size_t middle = m->sections.size() / 2;
  EXPECT_NEAR(m->sections.ad_max_mm[middle], 20.0, 1e-6);
  EXPECT_NEAR(m->sections.y_cg_ofs_mm[middle], 13.0, 1e-6);
  EXPECT_NEAR(m->highest_contact_mm, 23.0, 1e-6);
}

TEST(PlanarMeasure, RefusesWhatItCannotHoldAndCutsNothingThen) {
  auto stock = PlanarStock::from_box(kBlock);
  const auto ball = measure(line(0.0, -3.0, 40.0), cutter(CutterClass::kBallEndmill, 10.0, 5.0), stock);
  ASSERT_FALSE(ball);
  EXPECT_EQ(ball.error().code, "ENG-NOT-PLANAR");
  EXPECT_EQ(stock.trail_count(), 0U);
  EXPECT_EQ(measure({}, cutter(CutterClass::kTSlotMill, 10.0), stock).error().code, "ENG-UNDERCUT");
  EXPECT_EQ(measure({}, cutter(CutterClass::kEndmill, 0.0), stock).error().code, "ENG-PROFILE");
  const Cutter c = cutter(CutterClass::kEndmill, 10.0);
  for (const double bad :
       {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    CutterPath p = line(0.0, -3.0, 40.0);
    p.y[2] = bad;
    EXPECT_EQ(measure(p, c, stock).error().code, "ENG-NUMBER");
    EXPECT_FALSE(PlanarStock(stock).cut(model::profile_of(c), p));
  }
  stock.lose("something else was cut");
  EXPECT_EQ(measure(line(0.0, -3.0, 40.0), c, stock).error().code, "ENG-NOT-PLANAR");
}

TEST(PlanarMeasure, NothingToCutGivesNoSamples) {
  auto stock = PlanarStock::from_box(kBlock);
  const Cutter c = cutter(CutterClass::kEndmill, 10.0);
  EXPECT_EQ(measure({}, c, stock)->sections.size(), 0U);
  CutterPath p;
  p.start(skewed(0.0, 0.0, 0.0));  // on the top face: touches, takes nothing
  p.line(skewed(0.0, 0.0, 0.0), MoveRole::kCut);
  p.line(skewed(40.0, 0.0, 0.0), MoveRole::kCut);
  p.arc(skewed(40.0, 0.0, 0.0), {40.0, 40.0}, true, MoveRole::kCut);
  p.arc(p.point(3), xy(p.point(3)), true, MoveRole::kCut);  // a circle of no radius
  p.dwell();
  const auto m = measure(p, c, stock);
  ASSERT_TRUE(m);
  EXPECT_EQ(m->sections.size(), 0U);
  EXPECT_EQ(m->removed_mm3, 0.0);
}

TEST(PlanarMeasure, APathRepeatedCutsNothing) {
  auto stock = PlanarStock::from_box(kBlock);
  const Cutter c = cutter(CutterClass::kEndmill, 10.0);
  CutterPath p = pocket(4.0, 3.0, 1);
  p.arc(p.point(p.size() - 1), xy(skewed(6.0, 6.0, 0.0)), true, MoveRole::kLink);
  ASSERT_TRUE(measure(p, c, stock));
  const auto again = measure(p, c, stock);
  ASSERT_TRUE(again);
  EXPECT_EQ(again->sections.size(), 0U);
  EXPECT_LT(again->removed_mm3, 1e-6);
}

CutterPath random_path(std::mt19937_64& random) {
  std::uniform_real_distribution<double> u(0.0, 1.0);
  const auto point = [&](double z) { return Vec3{-5.0 + 90.0 * u(random), -5.0 + 70.0 * u(random), z}; };
  CutterPath p;
  const double z = -0.5 - 4.0 * u(random);
  p.start(point(2.0));
  p.line({p.x[0], p.y[0], z}, MoveRole::kPlunge);
  for (int k = 0; k < 8; ++k) {
    if (u(random) < 0.5) {
      p.line(point(z), MoveRole::kCut);
      continue;
    }
    const Vec2 from = xy(p.point(p.size() - 1));
    const double r = 0.5 + 12.0 * u(random);
    const double a = 2.0 * kPi * u(random);
    const double b = 2.0 * kPi * u(random);
    const Vec2 centre = from + r * Vec2{std::cos(a), std::sin(a)};
    p.arc({centre.x + r * std::cos(b), centre.y + r * std::sin(b), z}, centre, u(random) < 0.5,
          MoveRole::kCut);
  }
  return p;
}

TEST(PlanarMeasure, RemovedAndRestMakeTheWholeOnRandomPaths) {
  std::mt19937_64 random(3);
  for (int k = 0; k < 20; ++k) {
    auto stock = PlanarStock::from_box(kBlock);
    double removed = 0.0;
    for (const double d : {12.0, 6.0, 9.0}) {
      const auto m = measure(random_path(random), cutter(CutterClass::kEndmill, d), stock);
      ASSERT_TRUE(m);
      removed += m->removed_mm3 + m->rapid_removed_mm3;
      double sum = 0.0;
      for (const auto& e : m->engagement) {
        sum += e.removed_mm3;
        EXPECT_TRUE(std::isfinite(e.csa_mm2) && std::isfinite(e.arc_rad));
        EXPECT_GE(e.exit_rad, e.entry_rad);
        EXPECT_LE(e.ae_mm, d + 1e-9);
        // The depth leaves out slivers, whose volume counts; none is higher than the piece.
        EXPECT_LE(e.csa_mm2, d * e.ap_mm * (1.0 + 1e-9) + kSliver * 20.0 + (e.plunge ? d * d : 0.0));
      }
      EXPECT_NEAR(sum, m->removed_mm3, 1e-5 * m->removed_mm3);  // slivers have no sample
    }
    EXPECT_NEAR(removed, 80.0 * 60.0 * 20.0 - stock.volume(1e-7), 1e-4 * removed) << k;
  }
}

TEST(PlanarMeasure, AgreesWithTheHeightMapWithinItsAccuracyOnRandomPaths) {
  std::mt19937_64 random(5);
  for (int k = 0; k < 6; ++k) {
    auto stock = PlanarStock::from_box(kBlock);
    auto map = stock::from_box(kBlock, 0.1);
    for (const double d : {10.0, 12.0}) {
      const auto path = random_path(random);
      const Cutter c = cutter(CutterClass::kEndmill, d);
      const Options options{.step_mm = 0.5};
      const auto exact = measure(path, c, stock, options);
      const auto cells = measure(path, c, map, options);
      ASSERT_TRUE(exact && cells);
      EXPECT_NEAR(exact->removed_mm3, cells->removed_mm3, 1e-3 * cells->removed_mm3) << k;
      // Move by move, as the two need not cut arcs into equal steps.
      std::vector<double> per_move(path.size(), 0.0);
      for (std::size_t i = 0; i < exact->sections.size(); ++i)
        per_move[exact->sections.move[i]] += exact->sections.removed_mm3[i];
      for (std::size_t i = 0; i < cells->sections.size(); ++i)
        per_move[cells->sections.move[i]] -= cells->sections.removed_mm3[i];
      for (std::size_t i = 1; i < path.size(); ++i) {
        const double most = d * -path.z[i] * model::move_length(path, i);
        EXPECT_NEAR(per_move[i], 0.0, 0.005 * most + 0.05) << k << " " << i;
      }
    }
  }
}

TEST(PlanarMeasure, TheSamePathGivesTheSameNumbers) {
  std::mt19937_64 random(9);
  const auto path = random_path(random);
  auto a = PlanarStock::from_box(kBlock);
  auto b = a;
  const Cutter c = cutter(CutterClass::kEndmill, 10.0);
  const auto first = measure(path, c, a);
  const auto second = measure(path, c, b);
  ASSERT_TRUE(first && second);
  EXPECT_EQ(first->engagement, second->engagement);
  EXPECT_EQ(first->sections.x_cg_ofs_mm, second->sections.x_cg_ofs_mm);
}

TEST(PlanarMeasure, AnotherGridOfTilesGivesTheSameNumbers) {
  std::mt19937_64 random(13);
  for (int k = 0; k < 5; ++k) {
    const auto path = random_path(random);
    const Cutter c = cutter(CutterClass::kEndmill, 10.0);
    auto fine = PlanarStock::from_box(kBlock, 0.7);
    auto coarse = PlanarStock::from_box(kBlock, 17.0);
    const auto a = measure(path, c, fine);
    const auto b = measure(path, c, coarse);
    ASSERT_TRUE(a && b);
    EXPECT_NEAR(a->removed_mm3, b->removed_mm3, 1e-5 * b->removed_mm3);
    ASSERT_EQ(a->engagement.size(), b->engagement.size());
    for (std::size_t i = 0; i < a->engagement.size(); ++i)
      EXPECT_NEAR(a->engagement[i].csa_mm2, b->engagement[i].csa_mm2, 1e-4);
  }
}

}  // namespace
}  // namespace capstan::engagement

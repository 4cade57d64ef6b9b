#include "planner/physics/engagement/planar/planar.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <random>

#include "tests/physics/engagement/planar/skewed.h"

namespace capstan::engagement {
namespace {

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

}  // namespace
}  // namespace capstan::engagement

#include "planner/physics/engagement/engagement.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "planner/physics/stock/sweep.h"

namespace capstan::engagement {
namespace {

using geometry::Box3;
using geometry::Vec2;
using geometry::Vec3;
using model::Cutter;
using model::CutterClass;
using model::CutterPath;
using model::MoveRole;

constexpr double kPi = std::numbers::pi;
constexpr double kSkew = 27.0 * kPi / 180.0;  // no axis, no diagonal, no simple ratio
constexpr double kCell = 0.1;                 // D / 100

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

const Box3 kBlock{{0.0, 0.0, -20.0}, {80.0, 60.0, 0.0}};
const Vec2 kAlong{std::cos(kSkew), std::sin(kSkew)};
const Vec2 kLeft{-std::sin(kSkew), std::cos(kSkew)};

Vec3 skewed(double s, double left, double z) {
  const Vec2 p = Vec2{15.13, 12.07} + s * kAlong + left * kLeft;
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

struct Error {
  double worst = 0.0, rms = 0.0, mean = 0.0;
  int n = 0;
};

/// CSA of the samples of move `move` between arc lengths lo and hi against the expected value.
Error csa_error(const Measurement& m, std::uint32_t move, double lo, double hi, double expected) {
  Error e;
  for (std::size_t i = 0; i < m.sections.size(); ++i) {
    if (m.sections.move[i] != move || m.sections.at_mm[i] < lo || m.sections.at_mm[i] > hi) continue;
    const double d = m.sections.csa_mm2[i] - expected;
    e.worst = std::max(e.worst, std::abs(d));
    e.rms += d * d;
    e.mean += d;
    ++e.n;
  }
  e.rms = std::sqrt(e.rms / e.n);
  e.mean /= e.n;
  return e;
}

void report(const char* what, const Error& e, double expected) {
  const auto percent = [&](double v) { return std::to_string(100.0 * v / expected); };
  testing::Test::RecordProperty(std::string(what) + "_worst_percent", percent(e.worst));
  std::printf("[ figures  ] %s: expected %.4f mm2, worst %s %%, rms %s %%, bias %s %% over %d samples\n",
              what, expected, percent(e.worst).c_str(), percent(e.rms).c_str(), percent(e.mean).c_str(), e.n);
}

/// What is asked: 1 % of the value or 0.5 % of ap D, whichever is more.
double allowed(double csa, double ap, double diameter) { return std::max(0.01 * csa, 0.005 * ap * diameter); }

TEST(SkewedSlot, CsaIsDiameterTimesDepth) {
  auto map = stock::from_box(kBlock, kCell);
  const auto m = measure(line(0.0, -3.0, 40.0), cutter(CutterClass::kEndmill, 10.0), map);
  ASSERT_TRUE(m);
  const Error e = csa_error(*m, 3, 6.0, 40.0, 30.0);
  report("slot", e, 30.0);
  ASSERT_GT(e.n, 100);
  EXPECT_LT(e.worst, allowed(30.0, 3.0, 10.0));
  const auto& s = m->sections;
  const std::size_t last = s.size() - 1;
  EXPECT_NEAR(s.ad_max_mm[last], 3.0, 1e-4);
  EXPECT_NEAR(s.rd_max_mm[last], 10.0, 0.1);
  EXPECT_NEAR(s.x_cg_ofs_mm[last], 0.0, 0.05);
  EXPECT_NEAR(s.y_cg_ofs_mm[last], 1.5, 1e-4);
  EXPECT_NEAR(m->engagement[last].arc_rad, kPi, 0.3);  // acos is steep at the edge
  EXPECT_EQ(m->rapid_removed_mm3, 0.0);
}

TEST(SkewedShoulder, CsaAndWidthMatchTheClosedForm) {
  for (const double ae : {0.5, 2.0, 5.0, 8.0}) {
    auto map = stock::from_box(kBlock, kCell);
    const Cutter c = cutter(CutterClass::kEndmill, 10.0);
    ASSERT_TRUE(measure(line(0.0, -3.0, 40.0), c, map));
    // The second pass lies to the right: what it takes is on its right side.
    const auto m = measure(line(-ae, -3.0, 40.0), c, map);
    ASSERT_TRUE(m);
    const double csa = 3.0 * ae;
    const Error e = csa_error(*m, 3, 10.0, 34.0, csa);
    report(("shoulder ae " + std::to_string(ae)).c_str(), e, csa);
    EXPECT_LT(e.worst, allowed(csa, 3.0, 10.0)) << ae;
    for (std::size_t i = 0; i < m->sections.size(); ++i) {
      if (m->sections.move[i] != 3 || m->sections.at_mm[i] < 10.0 || m->sections.at_mm[i] > 34.0) continue;
      EXPECT_NEAR(m->sections.rd_max_mm[i], ae, 0.1) << ae;
      EXPECT_NEAR(m->sections.x_cg_ofs_mm[i], 5.0 - 0.5 * ae, 0.08) << ae;
      EXPECT_NEAR(m->engagement[i].exit_rad, kPi, 0.25) << ae;
      EXPECT_NEAR(m->engagement[i].entry_rad, std::acos(-(5.0 - ae) / 5.0), 0.25) << ae;
    }
  }
}

TEST(BallInPlane, CsaIsACircularSegment) {
  for (const double ap : {0.5, 1.0, 3.0}) {
    auto map = stock::from_box(kBlock, kCell);
    const auto m = measure(line(0.0, -ap, 40.0), cutter(CutterClass::kBallEndmill, 10.0, 5.0), map);
    ASSERT_TRUE(m);
    const double half = std::acos((5.0 - ap) / 5.0);
    const double csa = 25.0 * (half - std::sin(half) * std::cos(half));
    const Error e = csa_error(*m, 3, 6.0, 40.0, csa);
    report(("ball ap " + std::to_string(ap)).c_str(), e, csa);
    EXPECT_LT(e.worst, allowed(csa, ap, 10.0)) << ap;
    EXPECT_NEAR(m->sections.ad_max_mm.back(), ap, 0.02 * ap + 0.005) << ap;
    EXPECT_NEAR(m->sections.rd_max_mm.back(), 2.0 * std::sqrt(ap * (10.0 - ap)), 0.2) << ap;
  }
}

TEST(BullInPlane, CsaIsRectangleAndTwoQuarterRounds) {
  auto map = stock::from_box(kBlock, kCell);
  const auto m = measure(line(0.0, -2.0, 40.0), cutter(CutterClass::kBullnoseEndmill, 10.0, 1.0), map);
  ASSERT_TRUE(m);
  const double csa = 20.0 - 2.0 * (1.0 - kPi / 4.0);
  const Error e = csa_error(*m, 3, 6.0, 40.0, csa);
  report("bull", e, csa);
  EXPECT_LT(e.worst, allowed(csa, 2.0, 10.0));
}

TEST(DrillInSolid, CsaIsTheHolesAreaAndVolumeIsConeAndCylinder) {
  auto map = stock::from_box(kBlock, kCell);
  const double tip = 5.0 / std::tan(59.0 * kPi / 180.0);
  CutterPath p;
  p.start({30.03, 30.07, 5.0});
  p.line({30.03, 30.07, -tip - 4.0}, MoveRole::kDrill);
  const auto m = measure(p, cutter(CutterClass::kTwistDrill, 10.0, 0.0, 118.0 * kPi / 180.0), map);
  ASSERT_TRUE(m);
  const double area = kPi * 25.0;
  const Error e = csa_error(*m, 1, 5.0 + tip + 0.5, 5.0 + tip + 4.0, area);
  report("drill", e, area);
  EXPECT_LT(e.worst, 0.01 * area);
  EXPECT_NEAR(m->removed_mm3, area * 4.0 + area * tip / 3.0, 0.001 * m->removed_mm3);
  EXPECT_TRUE(m->engagement.back().plunge);
  EXPECT_NEAR(m->sections.ad_max_mm.back(), tip, 0.1 * tip);
}

TEST(Ramp, VolumeIsThatOfTheSweptSlot) {
  auto map = stock::from_box(kBlock, kCell);
  CutterPath p;
  p.start(skewed(0.0, 0.0, 0.0));
  p.line(skewed(40.0, 0.0, -2.0), MoveRole::kRamp);
  const auto m = measure(p, cutter(CutterClass::kEndmill, 10.0), map);
  ASSERT_TRUE(m);
  // On the line at w beside the path the half chord is h = sqrt(R^2 - w^2). The last position to cover s is
  // the deepest: s + h for s in [-h, 40 - h], the end for s in [40 - h, 40 + h]. Integrated over s that is
  // slope 40^2 / 2 + 2 * 2 h, and over w: 10 * slope * 800 + 4 * pi R^2 / 2.
  const double slope = 2.0 / 40.0;
  const double expected = 10.0 * slope * 800.0 + 4.0 * kPi * 25.0 / 2.0;
  std::printf("[ figures  ] ramp volume %.3f of %.3f\n", m->removed_mm3, expected);
  EXPECT_NEAR(m->removed_mm3, expected, 0.001 * expected);
}

TEST(Pocket, RemovedVolumeIsThatOfThePocket) {
  auto map = stock::from_box(kBlock, kCell);
  const double before = stock::volume(map);
  // A skewed rectangle 20 x 12 of centre-line passes 4 mm apart, then once around: a pocket 30 x 22, R5.
  CutterPath p;
  p.start(skewed(0.0, 0.0, 5.0));
  p.line(skewed(0.0, 0.0, -2.0), MoveRole::kPlunge);
  for (int k = 0; k < 4; ++k) {
    p.line(skewed(k % 2 == 0 ? 20.0 : 0.0, 4.0 * k, -2.0), MoveRole::kCut);
    if (k < 3) p.line(skewed(k % 2 == 0 ? 20.0 : 0.0, 4.0 * (k + 1), -2.0), MoveRole::kLink);
  }
  for (const auto& [s, left] : {std::pair{0.0, 0.0}, {20.0, 0.0}, {20.0, 12.0}, {0.0, 12.0}}) {
    p.line(skewed(s, left, -2.0), MoveRole::kCut);
  }
  const auto m = measure(p, cutter(CutterClass::kEndmill, 10.0), map);
  ASSERT_TRUE(m);
  const double expected = 2.0 * (30.0 * 22.0 - (4.0 - kPi) * 25.0);
  std::printf("[ figures  ] pocket volume %.3f of %.3f (%.4f %%)\n", m->removed_mm3, expected,
              100.0 * (m->removed_mm3 / expected - 1.0));
  EXPECT_NEAR(m->removed_mm3, expected, 0.001 * expected);
  EXPECT_NEAR(before - stock::volume(map), m->removed_mm3, 1e-3);  // single precision of heights
}

TEST(Arc, RingVolumeAndSection) {
  auto map = stock::from_box(kBlock, kCell);
  CutterPath p;
  p.start({42.0, 30.0, 5.0});
  p.line({42.0, 30.0, -2.0}, MoveRole::kPlunge);
  p.arc({42.0, 30.0, -2.0}, {30.0, 30.0}, false, MoveRole::kCut);
  const auto m = measure(p, cutter(CutterClass::kEndmill, 10.0), map);
  ASSERT_TRUE(m);
  const double ring = 2.0 * kPi * (17.0 * 17.0 - 7.0 * 7.0);
  EXPECT_NEAR(m->removed_mm3, ring, 0.001 * ring);
  const Error e = csa_error(*m, 2, 6.0, 65.0, 20.0);
  report("arc", e, 20.0);
  EXPECT_LT(e.worst, allowed(20.0, 2.0, 10.0));
}

TEST(Path, TheSamePassTwiceTakesNothingTheSecondTime) {
  auto map = stock::from_box(kBlock, kCell);
  const Cutter c = cutter(CutterClass::kEndmill, 10.0);
  const auto first = measure(line(0.0, -3.0, 40.0), c, map);
  const auto second = measure(line(0.0, -3.0, 40.0), c, map);
  ASSERT_TRUE(first && second);
  EXPECT_LT(second->removed_mm3, 1e-3 * first->removed_mm3);
}

TEST(Path, AWholeMoveAtOnceCutsWhatItsStepsCut) {
  for (const CutterClass kind : {CutterClass::kEndmill, CutterClass::kBallEndmill}) {
    const Cutter c = cutter(kind, 10.0, kind == CutterClass::kBallEndmill ? 5.0 : 0.0);
    auto stepped = stock::from_box(kBlock, kCell);
    auto whole = stepped;
    const CutterPath p = line(0.0, -3.0, 30.0);
    const auto m = measure(p, c, stepped);
    ASSERT_TRUE(m);
    const double at_once = stock::cut(whole, model::profile_of(c), p);
    EXPECT_NEAR(m->removed_mm3, at_once, 1e-3 * at_once);
  }
}

TEST(Path, ARapidThroughStockIsCountedApart) {
  auto map = stock::from_box(kBlock, kCell);
  CutterPath p;
  p.start({-10.0, 30.0, -1.0});
  p.rapid({90.0, 30.0, -1.0});
  const auto m = measure(p, cutter(CutterClass::kEndmill, 10.0), map);
  ASSERT_TRUE(m);
  EXPECT_NEAR(m->rapid_removed_mm3, 800.0, 1.0);
  EXPECT_EQ(m->removed_mm3, 0.0);
  EXPECT_EQ(m->sections.size(), 0U);
}

// A drill of 6.6 mm in cells of 10 mm: each hole's edges cross cells that hold one edge only. Pecks and the
// way out go where the drill has been; a rapid further down than that is in material.
TEST(Path, RapidsWhereTheCutterHasBeenTouchNothingHoweverCoarseTheCells) {
  const Cutter drill = cutter(CutterClass::kTwistDrill, 6.6, 0.0, 140.0 * kPi / 180.0);
  CutterPath p;
  p.start({13.0, 17.0, 10.0});
  p.rapid({13.0, 17.0, 2.0});
  p.line({13.0, 17.0, -6.0}, MoveRole::kPlunge);
  p.rapid({13.0, 17.0, 2.0});
  p.rapid({13.0, 17.0, -5.5});
  p.line({13.0, 17.0, -12.0}, MoveRole::kPlunge);
  p.rapid({13.0, 17.0, 10.0});
  auto map = stock::from_box(kBlock, 10.0);
  const auto free = measure(p, drill, map);
  ASSERT_TRUE(free);
  EXPECT_EQ(free->rapid_removed_mm3, 0.0);
  p.rapid({13.0, 17.0, -15.0});
  map = stock::from_box(kBlock, 0.1);
  const auto into = measure(p, drill, map);
  ASSERT_TRUE(into);
  EXPECT_NEAR(into->rapid_removed_mm3, kPi * 3.3 * 3.3 * 3.0, 1.0);  // of 103 mm3
}

TEST(Path, EmptyStandingAndAirPathsGiveNoSamples) {
  auto map = stock::from_box(kBlock, 0.5);
  const auto before = map;
  const Cutter c = cutter(CutterClass::kEndmill, 10.0);
  EXPECT_EQ(measure({}, c, map)->sections.size(), 0U);
  CutterPath p;
  p.start({10.0, 10.0, 3.0});
  p.line({10.0, 10.0, 3.0}, MoveRole::kCut);
  p.dwell();
  p.line({50.0, 10.0, 0.0}, MoveRole::kCut);
  p.arc({50.0, 30.0, 0.0}, {50.0, 20.0}, true, MoveRole::kCut);
  const auto m = measure(p, c, map);
  ASSERT_TRUE(m);
  EXPECT_EQ(m->sections.size(), 0U);
  EXPECT_EQ(m->removed_mm3, 0.0);
  EXPECT_EQ(map, before);
}

TEST(Path, EntryAndExitAreSeenAndOneEmptySampleClosesTheCut) {
  auto map = stock::from_box(kBlock, kCell);
  CutterPath p;
  p.start({-10.0, 30.0, -2.0});
  p.line({90.0, 30.0, -2.0}, MoveRole::kCut);
  const auto m = measure(p, cutter(CutterClass::kEndmill, 10.0), map);
  ASSERT_TRUE(m);
  const auto& s = m->sections;
  EXPECT_NEAR(s.at_mm.front(), 5.0, 0.3);    // the rim touches the block
  EXPECT_LT(s.csa_mm2.front(), 0.6 * 20.0);  // and widens over the first half diameter
  EXPECT_EQ(s.csa_mm2.back(), 0.0);
  EXPECT_GT(s.csa_mm2[s.size() - 2], 0.0);
  EXPECT_NEAR(m->removed_mm3, 80.0 * 10.0 * 2.0, 1.0);
  EXPECT_NEAR(m->highest_contact_mm, 2.0, 1e-4);
}

TEST(Path, RandomPathsGiveFiniteNumbersAndTheVolumeTheStockLost) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> u(0.0, 1.0);
  const Cutter cutters[] = {cutter(CutterClass::kEndmill, 10.0), cutter(CutterClass::kBallEndmill, 8.0, 4.0),
                            cutter(CutterClass::kBullnoseEndmill, 12.0, 2.0),
                            cutter(CutterClass::kChamferMill, 10.0, 0.0, kPi / 2.0)};
  for (int k = 0; k < 40; ++k) {
    auto map = stock::from_box(kBlock, 0.4);
    const double before = stock::volume(map);
    CutterPath p;
    p.start({80.0 * u(random), 60.0 * u(random), 1.0});
    for (int i = 0; i < 12; ++i) {
      const Vec3 to{100.0 * u(random) - 10.0, 80.0 * u(random) - 10.0, 4.0 - 10.0 * u(random)};
      if (i % 3 == 2) {
        const Vec3 at = p.point(p.size() - 1);
        const Vec2 centre = xy(at) + 6.0 * u(random) * Vec2{std::cos(1.0 * i), std::sin(1.0 * i)};
        const Vec2 r = xy(at) - centre;
        const double turn = 6.0 * u(random) + 0.1;
        p.arc({centre.x + r.x * std::cos(turn) - r.y * std::sin(turn),
               centre.y + r.x * std::sin(turn) + r.y * std::cos(turn), i % 2 == 0 ? at.z : to.z},
              centre, false, MoveRole::kCut);
      } else {
        p.line(to, MoveRole::kCut);
      }
    }
    const auto m = measure(p, cutters[k % 4], map);
    ASSERT_TRUE(m);
    const auto& s = m->sections;
    for (std::size_t i = 0; i < s.size(); ++i) {
      for (const double v : {s.ad_max_mm[i], s.rd_max_mm[i], s.x_max_ofs_mm[i], s.y_max_ofs_mm[i],
                             s.csa_mm2[i], s.x_cg_ofs_mm[i], s.y_cg_ofs_mm[i], m->engagement[i].arc_rad}) {
        ASSERT_TRUE(std::isfinite(v));
      }
      EXPECT_GE(s.csa_mm2[i], 0.0);
      EXPECT_LE(s.rd_max_mm[i], cutters[k % 4].cutting_diameter_mm + 1e-9);
    }
    const double lost = before - stock::volume(map);
    EXPECT_NEAR(m->removed_mm3 + m->rapid_removed_mm3, lost, 1e-3 * lost);
  }
}

TEST(Path, NotANumberIsRefused) {
  auto map = stock::from_box(kBlock, 1.0);
  CutterPath p;
  p.start({0.0, 0.0, 5.0});
  p.line({std::nan(""), 0.0, 5.0}, MoveRole::kCut);
  const auto m = measure(p, cutter(CutterClass::kEndmill, 10.0), map);
  ASSERT_FALSE(m);
  EXPECT_EQ(m.error().code, "ENG-NUMBER");
}

TEST(Undercut, IsRefusedByName) {
  auto map = stock::from_box(kBlock, 1.0);
  const auto m = measure({}, cutter(CutterClass::kTSlotMill, 10.0), map);
  ASSERT_FALSE(m);
  EXPECT_EQ(m.error().code, "ENG-UNDERCUT");
}

}  // namespace
}  // namespace capstan::engagement

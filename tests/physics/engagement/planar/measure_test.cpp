#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <random>

#include "planner/physics/stock/height_map.h"
#include "tests/physics/engagement/planar/skewed.h"

// What holds of every measurement: sums, refusals, the height map's agreement, other grids.

namespace capstan::engagement {
namespace {

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

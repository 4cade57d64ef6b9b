#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <random>

#include "planner/physics/engagement/engagement.h"
#include "planner/physics/stock/sweep.h"
#include "planner/physics/stock/turned.h"

namespace capstan::engagement {
namespace {

using geometry::Vec3;
using model::Cutter;
using model::CutterClass;
using model::CutterPath;
using model::MoveRole;

constexpr double kPi = std::numbers::pi;

Cutter cutter(CutterClass kind, double diameter, double corner = 0.0) {
  Cutter c;
  c.id = "t";
  c.cutter_class = kind;
  c.cutting_diameter_mm = diameter;
  c.corner_radius_mm = corner;
  c.maximum_depth_of_cut_mm = 30.0;
  return c;
}

stock::HeightMap block(double cell = 0.5) { return stock::from_box({{0, 0, -20}, {40, 30, 0}}, cell); }

/// All numbers are finite, nothing is negative, and the stock lost what is counted.
void sound(const Result<Measurement>& m, const stock::HeightMap& before, const stock::HeightMap& after) {
  ASSERT_TRUE(m) << m.error().message;
  for (std::size_t i = 0; i < m->engagement.size(); ++i) {
    const Engagement& e = m->engagement[i];
    for (const double v : {e.ap_mm, e.ae_mm, e.entry_rad, e.exit_rad, e.arc_rad, e.csa_mm2, e.removed_mm3,
                           m->sections.x_cg_ofs_mm[i], m->sections.y_cg_ofs_mm[i],
                           m->sections.x_max_ofs_mm[i], m->sections.y_max_ofs_mm[i]}) {
      ASSERT_TRUE(std::isfinite(v)) << i;
    }
    ASSERT_GE(e.csa_mm2, 0.0);
    ASSERT_GE(e.arc_rad, -1e-9);
  }
  const double lost = stock::volume(before) - stock::volume(after);
  EXPECT_NEAR(m->removed_mm3 + m->rapid_removed_mm3, lost, 1e-3 * lost + 1e-3);
}

TEST(Hostile, NumbersThatAreNoneAreRefused) {
  for (const double bad : {std::nan(""), std::numeric_limits<double>::infinity(), -1e300, 1e6}) {
    for (int where = 0; where < 5; ++where) {
      CutterPath p;
      p.start({5, 5, -1});
      p.line({10, 5, -1}, MoveRole::kCut);
      p.arc({15, 5, -1}, {12.5, 5}, true, MoveRole::kCut);
      (where == 0 ? p.x : where == 1 ? p.y : where == 2 ? p.z : where == 3 ? p.cx : p.cy)[2] = bad;
      auto map = block();
      const auto before = map;
      const auto m = measure(p, cutter(CutterClass::kEndmill, 10.0), map);
      ASSERT_FALSE(m);
      EXPECT_EQ(m.error().code, "ENG-NUMBER");
      EXPECT_EQ(map, before);
    }
  }
}

TEST(Hostile, CuttersWithoutAShapeAreRefused) {
  auto map = block();
  for (const double bad : {0.0, -1.0, std::nan(""), std::numeric_limits<double>::infinity()}) {
    const auto m = measure({}, cutter(CutterClass::kEndmill, bad), map);
    ASSERT_FALSE(m) << bad;
    EXPECT_EQ(m.error().code, "ENG-PROFILE");
  }
  EXPECT_FALSE(measure({}, cutter(CutterClass::kBullnoseEndmill, 10.0, std::nan("")), map));
}

TEST(Hostile, AnEmptyMapAndAPathBesideTheStockGiveNothing) {
  CutterPath p;
  p.start({-500, 5, -1});
  p.line({-400, 5, -1}, MoveRole::kCut);
  p.arc({-400, 5, -1}, {-390, 5}, false, MoveRole::kCut);
  p.line({-400, 5, -100}, MoveRole::kPlunge);
  stock::HeightMap none;
  const auto empty = measure(p, cutter(CutterClass::kEndmill, 10.0), none);
  ASSERT_TRUE(empty);
  EXPECT_EQ(empty->sections.size(), 0U);
  auto map = block();
  const auto before = map;
  const auto beside = measure(p, cutter(CutterClass::kEndmill, 10.0), map);
  ASSERT_TRUE(beside);
  EXPECT_EQ(beside->sections.size(), 0U);
  EXPECT_EQ(map, before);
}

TEST(Hostile, ACutterLargerThanTheStockTakesAllOfIt) {
  for (const CutterClass kind : {CutterClass::kEndmill, CutterClass::kBallEndmill}) {
    auto map = block();
    const auto before = map;
    CutterPath p;
    p.start({-300, 15, -30});
    p.line({300, 15, -30}, MoveRole::kCut);
    const auto m = measure(p, cutter(kind, 200.0, kind == CutterClass::kBallEndmill ? 100.0 : 0.0), map);
    sound(m, before, map);
    EXPECT_NEAR(m->removed_mm3, 40.0 * 30.0 * 20.0, 25.0);
  }
}

TEST(Hostile, ACutterSmallerThanACellStillConservesVolume) {
  auto map = block(0.5);
  const auto before = map;
  CutterPath p;
  p.start({3, 3, 1});
  p.line({3, 3, -2}, MoveRole::kPlunge);
  p.line({30, 21, -2}, MoveRole::kCut);
  sound(measure(p, cutter(CutterClass::kEndmill, 0.3), map), before, map);
}

TEST(Hostile, ArcsOfAnyKindAreSound) {
  const Cutter cutters[] = {cutter(CutterClass::kEndmill, 8.0), cutter(CutterClass::kBallEndmill, 8.0, 4.0),
                            cutter(CutterClass::kBullnoseEndmill, 8.0, 1.0)};
  for (const Cutter& c : cutters) {
    for (const bool clockwise : {false, true}) {
      for (const double z : {-3.0, -1.0, -6.0}) {                   // level, up, down
        for (const double radius : {0.0, 1e-12, 0.4, 3.0, 11.0}) {  // from none to a wide turn
          auto map = block();
          const auto before = map;
          CutterPath p;
          p.start({20, 15, 2});
          p.line({20, 15, -3}, MoveRole::kPlunge);
          p.arc({20, 15, z}, {20 - radius, 15}, clockwise, MoveRole::kCut);                 // full turn
          p.arc({20 + radius, 15 + radius, z}, {20, 15 + 0.3}, clockwise, MoveRole::kCut);  // radii differ
          p.line({20 + radius, 15 + radius, z}, MoveRole::kCut);                            // nowhere
          sound(measure(p, c, map), before, map);
        }
      }
    }
  }
}

TEST(Helix, DownRemovesARingAndUpAgainNothing) {
  auto map = block(0.1);
  const auto before = map;
  CutterPath p;
  p.start({24, 15, 0});
  p.arc({24, 15, -2}, {20, 15}, false, MoveRole::kRamp);
  p.arc({24, 15, -2}, {20, 15}, false, MoveRole::kCut);
  const std::size_t level = p.size();
  p.arc({24, 15, 0}, {20, 15}, false, MoveRole::kCut);  // rises over its own floor
  const auto m = measure(p, cutter(CutterClass::kEndmill, 6.0), map);
  sound(m, before, map);
  EXPECT_NEAR(m->removed_mm3, 2.0 * kPi * (49.0 - 1.0), 1e-3 * 2.0 * kPi * 48.0);
  for (std::size_t i = 0; i < m->sections.size(); ++i) {
    EXPECT_TRUE(m->sections.move[i] < level || m->sections.csa_mm2[i] < 1e-3);
  }
}

TEST(Heads, CutUnderAnOverhangIsNeverMeasured) {
  CutterPath deep;
  deep.start({-20, 15, -12});
  deep.line({60, 15, -12}, MoveRole::kCut);
  for (const CutterClass kind :
       {CutterClass::kTSlotMill, CutterClass::kDovetailMill, CutterClass::kBackCountersink,
        CutterClass::kBackCounterbore, CutterClass::kSideMill, CutterClass::kThreadMill}) {
    Cutter c = cutter(kind, 16.0);
    c.cutting_width_mm = c.maximum_depth_of_cut_mm = 4.0;
    auto map = block();
    const auto before = map;
    const auto m = measure(deep, c, map);
    ASSERT_FALSE(m) << model::to_text(kind);
    EXPECT_EQ(m.error().code, "ENG-UNDERCUT");
    EXPECT_EQ(map, before) << "what is refused is not cut";
  }
  // In the open, no deeper than its disc is high, a side mill is an end mill.
  Cutter disc = cutter(CutterClass::kSideMill, 16.0);
  disc.cutting_width_mm = 4.0;
  auto map = block();
  const auto before = map;
  CutterPath open;
  open.start({-20, 15, -3});
  open.line({60, 15, -3}, MoveRole::kCut);
  const auto m = measure(open, disc, map);
  sound(m, before, map);
  EXPECT_NEAR(m->removed_mm3, 40.0 * 16.0 * 3.0, 2.0);
}

TEST(Pieces, ARoundBarFacedOffLosesADisc) {
  auto map = stock::from_cylinder({{0, 0, 0}, {60, 60, 20}}, 25.0, 0.2);
  const auto before = map;
  CutterPath p;
  p.start({-20, 0, 18});
  for (int k = 0; k <= 8; ++k) {
    p.line({k % 2 == 0 ? 80.0 : -20.0, 8.0 * k, 18}, MoveRole::kCut);
    p.line({k % 2 == 0 ? 80.0 : -20.0, 8.0 * (k + 1), 18}, MoveRole::kLink);
  }
  const auto m = measure(p, cutter(CutterClass::kEndmill, 20.0), map);
  sound(m, before, map);
  const double disc = kPi * 625.0 * 2.0;
  EXPECT_NEAR(m->removed_mm3, disc, 1e-3 * disc);
}

TEST(Pieces, AMeshLosesWhatStoodAboveTheCut) {
  // A wedge rising from 1 to 3 over a floor at -5; everything above 0 goes.
  geometry::Mesh mesh;
  mesh.vertices = {{0, 0, 1}, {10, 0, 1}, {10, 10, 3}, {0, 10, 3}};
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
  auto map = stock::from_mesh(mesh, -5.0, 0.1);
  const auto before = map;
  CutterPath p;
  p.start({-20, 5, 0});
  p.line({30, 5, 0}, MoveRole::kCut);
  const auto m = measure(p, cutter(CutterClass::kEndmill, 16.0), map);
  sound(m, before, map);
  EXPECT_NEAR(m->removed_mm3, 200.0, 0.2);
}

TEST(Pieces, StockCarriedToTheNextSetupIsNotCutAgain) {
  auto first = block(0.25);
  CutterPath p;
  p.start({-20, 15, -3});
  p.line({60, 15, -3}, MoveRole::kCut);
  const Cutter c = cutter(CutterClass::kEndmill, 10.0);
  const auto cut = measure(p, c, first);
  ASSERT_TRUE(cut);
  auto next = block(0.25);
  stock::take_over(next, {}, first, {});
  // Cells that the slot's walls cross stay full: never too low.
  EXPECT_GE(stock::volume(next), stock::volume(first) - 1e-6);
  const auto again = measure(p, c, next);
  ASSERT_TRUE(again);
  EXPECT_LT(again->removed_mm3, 0.05 * cut->removed_mm3);
}

}  // namespace
}  // namespace capstan::engagement

#include <gtest/gtest.h>

#include <array>
#include <numbers>

#include "planner/making/toolpath/defaults.h"
#include "tests/making/toolpath/path_helpers.h"

namespace capstan::toolpath {
namespace {

using geometry::Region;
using geometry::Vec2;
using geometry::Vec3;
using model::MoveKind;
using model::MoveRole;
using model::StrategyKind;

PathJob face_job(const Region& area, double depth, double diameter) {
  PathJob t = area_job(area, depth, diameter);
  t.shape.kind = model::ShapeKind::kFace;
  t.shape.name = "FACE";
  t.shape.open = true;
  t.shape.reach = geometry::offset_sharp(area, 100.0);
  t.operation = model::TypeId::kPlaneRoughMilling;
  t.strategy = StrategyKind::kBidirectional;
  t.cutter.centre_cutting = false;
  t.cutter.maximum_ramp_angle_rad = 0.0;
  return t;
}

void expect_sound(const PathJob& t, const std::string& name, double standing_mm = 0.0) {
  Job job;
  const auto g = generate(t, job);
  ASSERT_TRUE(g) << name << ": " << g.error().message;
  plot(*g, t.shape.area, name);
  EXPECT_THAT(rule_breaks(t, *g), testing::IsEmpty()) << name;
  HeightMap map({-20, -20}, {140, 140}, 0.5, t.start_z_mm);
  map.only(t.stock.empty() ? t.shape.area : t.stock);
  for (const auto& i : t.shape.islands) map.set_top(i.area, standing_mm);
  EXPECT_THAT(map.run(*g, t.cutter).faults, testing::IsEmpty()) << name;
  Region all = t.shape.area;
  for (const auto& i : t.shape.islands) {
    EXPECT_NEAR(map.highest(geometry::offset(i.area, -0.3)), standing_mm, 1e-4) << name;
    all = geometry::subtract(all, geometry::offset(i.area, 0.5));
  }
  EXPECT_NEAR(map.highest(all), t.feature_in_setup.origin.z - t.shape.depth_mm, 1e-4) << name;
}

TEST(FacePath, RunsThePassesOfNistsExample) {
  // ISO 14649 example 1 as NIST's interpreter ran it: nist_ex1.can, its lines 14 to 42.
  PathJob t = face_job(geometry::rectangle({0, 0}, {100, 120}), 5.0, 18.0);
  t.feature_in_setup.origin.z = 5.0;
  t.operation = model::TypeId::kPlaneFinishMilling;
  t.start_z_mm = 5.0;
  t.axial_depth_mm = 2.5;
  t.overlap = 0.05;
  t.feed_direction = Vec2{0.0, 1.0};
  t.stepover_left = true;
  t.retract_z_mm = 15.0;
  t.approach.kind = Approach::Kind::kPlunge;
  Job job;
  const auto g = generate(t, job);
  ASSERT_TRUE(g) << g.error().message;
  const std::array<double, 6> x = {91.9, 74.8, 57.7, 40.6, 23.5, 6.4};
  // The interpreter runs 13.5 mm over the edges, half a radius of it through air; here it is a millimetre.
  const double over = 9.0 + kAirBeyond;
  std::vector<Vec3> expected;
  for (const double z : {2.5, 0.0}) {
    bool up = true;
    for (const double v : x) {
      expected.push_back({v, up ? -over : 120.0 + over, z});
      expected.push_back({v, up ? 120.0 + over : -over, z});
      up = !up;
    }
  }
  std::vector<Vec3> cut;
  for (std::size_t i = 1; i < g->path.size(); ++i) {
    // On the upper level a pass is divided where its cut ends.
    const auto along = [&](std::size_t k) {
      return k < g->path.size() && g->path.kind[k] == MoveKind::kLine && g->path.x[k] == g->path.x[k - 1] &&
             g->path.z[k] == g->path.z[k - 1];
    };
    if (g->path.kind[i] == MoveKind::kLine && !(along(i) && along(i + 1))) cut.push_back(g->path.point(i));
  }
  ASSERT_EQ(cut.size(), expected.size());
  for (std::size_t i = 0; i < cut.size(); ++i) EXPECT_LT(norm(cut[i] - expected[i]), 1e-9) << i;
  for (std::size_t i = 1; i < g->path.size(); ++i) {
    if (g->path.kind[i] == MoveKind::kRapid) {
      EXPECT_GE(g->path.z[i], 15.0);
    }
  }
}

TEST(FacePath, CutsWholeFacesOfAnyOutlineFromOutside) {
  const Region l_shape = geometry::clean({{{0, 0}, {90, 0}, {90, 30}, {35, 30}, {35, 80}, {0, 80}}});
  const Region triangle = geometry::clean({{{0, 0}, {100, 10}, {40, 90}}});
  for (const Region& area : {l_shape, triangle, geometry::disc({50, 50}, 40.0)}) {
    for (const auto s :
         {StrategyKind::kBidirectional, StrategyKind::kUnidirectional, StrategyKind::kContourParallel}) {
      PathJob t = face_job(area, 2.0, 20.0);
      t.strategy = s;
      t.radial_depth_mm = 14.0;
      expect_sound(
          t, "face_" + std::to_string(area.loops[0].size()) + "_" + std::to_string(static_cast<int>(s)));
      t.feed_direction = Vec2{0.6, 0.8};
      expect_sound(t, "face_skew");
    }
  }
}

TEST(FacePath, BringsTheFlatEndOfABullNoseToTheLastEdge) {
  // Flat for 3 of its 10 mm; 80 mm are no whole number of passes.
  PathJob t = face_job(geometry::rectangle({0, 0}, {60, 80}), 1.0, 10.0);
  t.cutter.cutter_class = model::CutterClass::kBullnoseEndmill;
  t.cutter.corner_radius_mm = 3.5;
  t.radial_depth_mm = 6.5;
  expect_sound(t, "face_bull");
}

TEST(FacePath, LeavesABossOnTheFaceStanding) {
  for (const auto s : {StrategyKind::kBidirectional, StrategyKind::kContourParallel}) {
    PathJob t = face_job(geometry::rectangle({0, 0}, {100, 80}), 4.0, 16.0);
    t.strategy = s;
    t.axial_depth_mm = 2.0;
    t.shape.islands.push_back({geometry::disc({55, 40}, 12.0), 0.0});
    t.shape.reach = geometry::subtract(t.shape.reach, t.shape.islands[0].area);
    expect_sound(t, "face_boss_" + std::to_string(static_cast<int>(s)));
  }
}

TEST(FacePath, ClearsTheStripBetweenABossAndTheEdge) {
  // 5 mm on the left and 10 mm in front of the boss: less than the cutter's radius, which overhangs the edge.
  for (const auto s : {StrategyKind::kBidirectional, StrategyKind::kUnidirectional}) {
    PathJob t = face_job(geometry::rectangle({0, 0}, {60, 40}), 5.0, 50.0);
    t.strategy = s;
    t.radial_depth_mm = 35.0;
    t.shape.islands.push_back({geometry::rounded_rectangle({5, 10}, {19, 30}, 3.0), 0.0});
    t.shape.reach = geometry::subtract(t.shape.reach, t.shape.islands[0].area);
    Job job;
    const auto g = generate(t, job);
    ASSERT_TRUE(g) << g.error().message;
    HeightMap map({-80, -80}, {140, 120}, 0.5, 0.0);
    map.only(t.shape.area);
    map.set_top(t.shape.islands[0].area, 0.0);
    EXPECT_THAT(map.run(*g, t.cutter).faults, testing::IsEmpty());
    EXPECT_NEAR(map.highest(geometry::rectangle({0.5, 0.5}, {59.5, 9.0})), -5.0, 1e-4);
    EXPECT_NEAR(map.highest(geometry::rectangle({0.5, 0.5}, {4.0, 39.5})), -5.0, 1e-4);
  }
}

TEST(FacePath, StartsOutsideOfRawMaterialThatStandsOut) {
  PathJob t = face_job(geometry::rectangle({0, 0}, {100, 80}), 2.0, 16.0);
  t.stock = geometry::rectangle({-12, -12}, {112, 92});
  Job job;
  const auto g = generate(t, job);
  ASSERT_TRUE(g);
  HeightMap map({-20, -20}, {140, 140}, 0.5, 0.0);
  map.only(t.stock);
  EXPECT_THAT(map.run(*g, t.cutter).faults, testing::IsEmpty());
}

TEST(OutsidePath, GoesRoundFromOutsideUntilTheContour) {
  for (const bool climb : {true, false}) {
    PathJob t = area_job({}, 8.0, 10.0);
    t.shape.kind = model::ShapeKind::kOutside;
    t.shape.name = "OUTSIDE";
    t.shape.open = true;
    const Region kept = geometry::rounded_rectangle({20, 20}, {80, 60}, 5.0);
    t.shape.islands.push_back({kept, 0.0});
    t.shape.area = geometry::offset_sharp(kept, 100.0);
    t.shape.reach = geometry::subtract(geometry::offset_sharp(kept, 200.0), kept);
    t.stock = geometry::rectangle({0, 0}, {100, 80});
    t.operation = model::TypeId::kSideRoughMilling;
    t.axial_depth_mm = 4.0;
    t.radial_depth_mm = 4.0;
    t.climb = climb;
    t.cutter.centre_cutting = false;
    t.cutter.maximum_ramp_angle_rad = 0.0;
    Job job;
    const auto g = generate(t, job);
    ASSERT_TRUE(g) << g.error().message;
    plot(*g, kept, "outside");
    EXPECT_THAT(rule_breaks(t, *g), testing::IsEmpty());
    EXPECT_LE(gouge_mm(*g, t.shape.reach, 5.0, -1e-6), 0.003);
    HeightMap map({-20, -20}, {120, 100}, 0.25, 0.0);
    map.only(t.stock);
    EXPECT_THAT(map.run(*g, t.cutter).faults, testing::IsEmpty());
    EXPECT_NEAR(map.highest(geometry::subtract(t.stock, geometry::offset(kept, 0.4))), -8.0, 1e-4);
    EXPECT_NEAR(map.highest(kept), 0.0, 1e-9);
    // Finishing the same contour after roughing, on arcs.
    t.operation = model::TypeId::kSideFinishMilling;
    t.left_on_side_mm = 0.4;
    const auto f = generate(t, job);
    ASSERT_TRUE(f) << f.error().message;
    plot(*f, kept, "outside_finish");
    EXPECT_THAT(rule_breaks(t, *f), testing::IsEmpty());
    HeightMap rest({-20, -20}, {120, 100}, 0.25, 0.0);
    rest.only(geometry::offset(kept, 0.4));
    EXPECT_THAT(rest.run(*f, t.cutter).faults, testing::IsEmpty());
    EXPECT_NEAR(rest.highest(geometry::subtract(geometry::offset(kept, 0.4), geometry::offset(kept, 0.2))),
                -8.0, 1e-4);
  }
}

TEST(StepPath, ClearsWhatLiesBesideTheWall) {
  PathJob t = area_job({}, 6.0, 12.0);
  t.shape.kind = model::ShapeKind::kStep;
  t.shape.name = "STEP";
  t.shape.open = true;
  t.shape.area = geometry::rectangle({60, 0}, {160, 80});
  t.shape.reach = geometry::rectangle({60, -100}, {260, 180});
  t.stock = geometry::rectangle({0, 0}, {100, 80});
  t.axial_depth_mm = 3.0;
  t.cutter.centre_cutting = false;
  t.cutter.maximum_ramp_angle_rad = 0.0;
  Job job;
  const auto g = generate(t, job);
  ASSERT_TRUE(g) << g.error().message;
  plot(*g, t.stock, "step");
  EXPECT_THAT(rule_breaks(t, *g), testing::IsEmpty());
  EXPECT_LE(gouge_mm(*g, t.shape.reach, 6.0, -1e-6), 0.003);
  HeightMap map({-5, -20}, {130, 100}, 0.25, 0.0);
  map.only(t.stock);
  EXPECT_THAT(map.run(*g, t.cutter).faults, testing::IsEmpty());
  EXPECT_NEAR(map.highest(geometry::rectangle({60.3, 0}, {100, 80})), -6.0, 1e-4);
}

PathJob slot_job(double width, double depth, double diameter, bool open) {
  PathJob t = area_job({}, depth, diameter);
  t.shape.kind = model::ShapeKind::kSlot;
  t.shape.name = "SLOT";
  t.shape.spine = {{0, 0}, {60, 0}};
  t.shape.width.nominal_mm = width;
  t.shape.area = geometry::stroke(t.shape.spine, 0.5 * width, false);
  t.shape.reach = t.shape.area;
  t.shape.open = open;
  if (open) {
    t.shape.reach = geometry::stroke({{-100, 0}, {160, 0}}, 0.5 * width, false);
  } else {
    t.shape.area = t.shape.reach = geometry::stroke(t.shape.spine, 0.5 * width, true);
  }
  return t;
}

TEST(SlotPath, CutsOpenAndClosedSlotsInOnePassOrWider) {
  for (const bool open : {true, false}) {
    for (const double diameter : {8.0, 6.0}) {
      PathJob t = slot_job(8.0, 5.0, diameter, open);
      t.axial_depth_mm = 2.0;
      t.cutter.centre_cutting = false;
      Job job;
      const auto g = generate(t, job);
      ASSERT_TRUE(g) << g.error().message;
      plot(*g, t.shape.area, "slot");
      EXPECT_THAT(rule_breaks(t, *g), testing::IsEmpty()) << open << diameter;
      EXPECT_LE(gouge_mm(*g, t.shape.reach, 0.5 * diameter, -1e-6), 0.012);
      HeightMap map({-20, -10}, {80, 10}, 0.125, 0.0);
      if (open) map.only(geometry::rectangle({0, -10}, {60, 10}));
      EXPECT_THAT(map.run(*g, t.cutter).faults, testing::IsEmpty()) << open << diameter;
      EXPECT_NEAR(map.highest(geometry::offset(t.shape.area, -0.2)), -5.0, 1e-4) << open << diameter;
    }
  }
}

TEST(SlotPath, EntersATeeSlotByItsOpenEndOnly) {
  PathJob t = slot_job(8.0, 12.0, 14.0, true);
  t.shape.slot_profile = {{0, 7}, {4, 7}, {4, 4}, {12, 4}};
  t.cutter.cutter_class = model::CutterClass::kTSlotMill;
  t.cutter.cutting_width_mm = 4.0;
  t.cutter.neck_diameter_mm = 7.0;
  t.shape.reach = geometry::stroke({{0, 0}, {160, 0}}, 4.0, false);
  t.stock = geometry::rectangle({-20, -30}, {60, 30});
  Job job;
  const auto g = generate(t, job);
  ASSERT_TRUE(g) << g.error().message;
  EXPECT_EQ(g->levels_z_mm.size(), 1U);
  for (std::size_t i = 1; i < g->path.size(); ++i) {
    const bool vertical = std::abs(g->path.x[i] - g->path.x[i - 1]) < 1e-9;
    if (vertical && g->path.z[i] != g->path.z[i - 1]) {
      EXPECT_GT(g->path.x[i], 60.0 + 7.0);
    }
  }
  t.shape.reach = geometry::stroke(t.shape.spine, 4.0, false);
  EXPECT_EQ(generate(t, job).error().code, "TPA-ENTRY");
}

TEST(SlotPath, RefusesACutterWiderThanTheSlotAndAFormThatDoesNotMatch) {
  Job job;
  EXPECT_EQ(generate(slot_job(8.0, 5.0, 8.1, true), job).error().code, "TPA-NO-FIT");
  PathJob vee = slot_job(8.0, 4.0, 10.0, true);
  vee.shape.slot_angle_rad = std::numbers::pi / 2.0;
  vee.shape.slot_profile = {{0, 0}, {4, 4}};
  EXPECT_EQ(generate(vee, job).error().code, "TPA-NO-FIT") << "a flat end wider than the vee";
  vee.cutter.cutter_class = model::CutterClass::kTwistDrill;
  EXPECT_EQ(generate(vee, job).error().code, "TPA-TOOL");
  vee.cutter.cutter_class = model::CutterClass::kChamferMill;
  vee.cutter.point_angle_rad = std::numbers::pi / 2.0;
  const auto g = generate(vee, job);
  ASSERT_TRUE(g) << g.error().message;
  EXPECT_NEAR(g->levels_z_mm.back(), -4.0, 1e-12);
  vee.cutter.tip_diameter_mm = 0.1;  // as an engraving cutter has: 0.05 out of each flank
  EXPECT_TRUE(generate(vee, job));
  vee.cutter.tip_diameter_mm = 1.0;
  const auto blunt = generate(vee, job);
  ASSERT_FALSE(blunt) << "half a millimetre would be cut from each flank";
  EXPECT_EQ(blunt.error().code, "TPA-TOOL");
  EXPECT_NE(blunt.error().message.find("flat tip of 1 mm"), std::string::npos);
}

TEST(EdgePath, ChamfersTheUpperEdgeOfAPocketWithTheConesFlank) {
  PathJob t = area_job(geometry::rounded_rectangle({0, 0}, {40, 30}, 8.0), 1.0, 10.0);
  t.shape.kind = model::ShapeKind::kChamfer;
  t.shape.chamfer_width_mm = 1.0;
  t.shape.chamfer_angle_rad = std::numbers::pi / 4.0;
  t.operation = model::TypeId::kSideFinishMilling;
  t.cutter.cutter_class = model::CutterClass::kChamferMill;
  t.cutter.point_angle_rad = std::numbers::pi / 2.0;
  Job job;
  const auto g = generate(t, job);
  ASSERT_TRUE(g) << g.error().message;
  EXPECT_THAT(rule_breaks(t, *g), testing::IsEmpty());
  // 45 degrees: the tip 1.5 below the face, its axis 0.5 from the wall, cuts 1 wide at the face.
  double x = 1e9;
  for (std::size_t i = 1; i < g->path.size(); ++i) x = std::min(x, g->path.x[i]);
  EXPECT_NEAR(x, 0.5, 1e-5);
  EXPECT_NEAR(g->levels_z_mm[0], -1.5, 1e-12);
}

}  // namespace
}  // namespace capstan::toolpath

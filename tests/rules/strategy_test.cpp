#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <numbers>

#include "rules/rules.h"
#include "tests/support/scratch.h"

namespace capstan::rules {
namespace {

using model::CutterClass;
using model::FeatureShape;
using model::HoleBottom;
using model::Proposal;
using model::ShapeKind;
using model::TypeId;
using ::testing::HasSubstr;

/// The shipped tables with one row that holds for everything of a kind, before all others.
RuleBase with_chain(const std::string& table, const std::string& when, const std::string& chain) {
  const auto* info = ::testing::UnitTest::GetInstance()->current_test_info();
  const std::filesystem::path dir = capstan::testing::scratch_file(std::string(info->name()) + "_" + table);
  std::filesystem::create_directories(dir);
  std::ofstream(dir / "row.yaml") << "table: " << table
                                  << "\nrows:\n  - id: test.row\n    priority: 0\n    when: {" << when
                                  << "}\n    chains: [[" << chain << "]]\n    source: \"test\"\n";
  Job job;
  auto base = load_rules(dir.string(), job);
  EXPECT_TRUE(base) << (base ? "" : base.error().message);
  return base ? *std::move(base) : RuleBase{};
}

FeatureShape pocket(double corner) {
  FeatureShape s;
  s.kind = ShapeKind::kPocket;
  s.name = "P";
  s.depth_mm = 12.0;
  s.corner_radius_mm = corner;
  s.area = s.reach = geometry::rounded_rectangle({0, 0}, {100, 60}, corner);
  return s;
}

const std::string kUpright = "wall: [upright]";

TEST(RestAction, AsksForAWideCutterFirstAndForOneThatFitsTheCornersThen) {
  const RuleBase base = with_chain("pocket", kUpright,
                                   "{do: area_rough, corners: 0, allowance_side_mm: 0.3}, "
                                   "{do: rest_rough, allowance_side_mm: 0.3}");
  const Proposal p = propose(base, pocket(6.0), {});
  ASSERT_EQ(p.chains.size(), 1U) << p.cannot;
  const auto& wide = p.chains[0][0];
  const auto& rest = p.chains[0][1];
  EXPECT_EQ(rest.operation, TypeId::kBottomAndSideRoughMilling);
  // Corners of 6 mm, 0.3 mm left: 11.4 mm at most, and 0.9 of the corner's 12 mm.
  EXPECT_NEAR(rest.tool.diameter_max_mm, 10.8, 1e-9);
  EXPECT_NEAR(wide.tool.diameter_min_mm, 1.25 * 11.4, 1e-9);
  EXPECT_GT(wide.tool.diameter_min_mm, rest.tool.diameter_max_mm) << "so that there always is a rest";
  EXPECT_DOUBLE_EQ(rest.rest_of_diameter_mm, wide.tool.diameter_max_mm);
  EXPECT_EQ(wide.rest_of_diameter_mm, 0.0);
}

TEST(RestAction, IsRefusedWhereCornersDoNotLimitTheCutter) {
  const RuleBase base = with_chain("pocket", kUpright, "{do: area_rough, corners: 0}, rest_rough");
  EXPECT_THAT(propose(base, pocket(26.0), {}).cannot, HasSubstr("not wide enough to be worth a second one"));
  EXPECT_THAT(propose(base, pocket(0.0), {}).cannot, HasSubstr("no rest to machine"));
}

TEST(RestAction, LeavesNarrowPlacesToANarrowerCutterWhereTheWideOneReachesMostOfTheArea) {
  const RuleBase base =
      with_chain("pocket", kUpright, "{do: area_rough, of_area: 0.9}, {do: rest_rough, of_area: 0.9}");
  FeatureShape one_narrow_place = pocket(6.0);
  one_narrow_place.islands.push_back({geometry::disc({20, 30}, 16.0), 0.0});  // 4 mm from the left wall
  const Proposal p = propose(base, one_narrow_place, {});
  ASSERT_EQ(p.chains.size(), 1U) << p.cannot;
  EXPECT_GT(p.chains[0][0].tool.diameter_max_mm, 10.0);
  EXPECT_LT(p.chains[0][1].tool.diameter_max_mm, 4.0);
  EXPECT_GT(p.chains[0][0].tool.diameter_min_mm, p.chains[0][1].tool.diameter_max_mm);
  EXPECT_GT(p.chains[0][1].rest_of_diameter_mm, 0.0);
  EXPECT_THAT(propose(base, pocket(26.0), {}).cannot, HasSubstr("reaches enough of the area"));
}

TEST(RoughAction, MayLeaveCornersOfTwiceTheirRadiusToTheFinish) {
  const RuleBase base =
      with_chain("pocket", kUpright, "{do: area_rough, corners: 2, allowance_side_mm: 0.3}, area_finish");
  const Proposal p = propose(base, pocket(6.0), {});
  ASSERT_EQ(p.chains.size(), 1U) << p.cannot;
  EXPECT_NEAR(p.chains[0][0].tool.diameter_max_mm, 24.0, 1e-9);
  EXPECT_LE(p.chains[0][1].tool.diameter_max_mm, 12.0);
}

TEST(FloorAndThinWallActions, CutTheFloorAtOnceAndTheWallInLevelsOfItsThickness) {
  const RuleBase base = with_chain("pocket", kUpright,
                                   "{do: area_rough, allowance_side_mm: 0.3, allowance_bottom_mm: 0.2}, "
                                   "{do: floor_finish, allowance_side_mm: 0.3}, thin_wall_finish");
  Context c;
  c.wall_thickness_mm = 1.5;
  const Proposal p = propose(base, pocket(6.0), c);
  ASSERT_EQ(p.chains.size(), 1U) << p.cannot;
  EXPECT_TRUE(p.chains[0][1].one_level);
  EXPECT_DOUBLE_EQ(p.chains[0][1].allowance_side_mm, 0.3);
  EXPECT_EQ(p.chains[0][2].operation, TypeId::kSideFinishMilling);
  EXPECT_DOUBLE_EQ(p.chains[0][2].axial_depth_mm, 1.5);
  FeatureShape open = pocket(6.0);
  open.through = true;
  EXPECT_THAT(propose(base, open, c).cannot, HasSubstr("no floor"));
}

FeatureShape hole(double d, double depth) {
  FeatureShape s;
  s.kind = ShapeKind::kHole;
  s.name = "H";
  s.diameter.nominal_mm = s.bottom_diameter_mm = d;
  s.depth_mm = depth;
  s.bottom = HoleBottom::kThrough;
  s.through = true;
  s.area = s.reach = geometry::disc({0, 0}, 0.5 * d);
  return s;
}

TEST(DeepHoleActions, PeckWithItsOwnOperationAndGunDrillAfterItsPilot) {
  const RuleBase peck = with_chain("hole", "taper: [none]", "peck_drill");
  const Proposal p = propose(peck, hole(8, 20), {});
  ASSERT_FALSE(p.chains.empty()) << p.cannot;
  EXPECT_EQ(p.chains[0][0].operation, TypeId::kMultistepDrilling);
  EXPECT_TRUE(p.chains[0][0].peck);

  Context c;
  const RuleBase gun = with_chain("hole", "taper: [none]", "gun_pilot, gun_drill");
  EXPECT_THAT(propose(gun, hole(8, 160), c).cannot, HasSubstr("coolant through the spindle"));
  c.has_through_coolant = true;
  const Proposal deep = propose(gun, hole(8, 160), c);
  ASSERT_FALSE(deep.chains.empty()) << deep.cannot;
  const auto& pilot = deep.chains[0][0];
  const auto& drill = deep.chains[0][1];
  EXPECT_NEAR(pilot.depth_mm, 12.0, 1e-9);
  EXPECT_EQ(drill.tool.classes.front(), CutterClass::kGunDrill);
  EXPECT_TRUE(drill.tool.coolant_through && drill.coolant_through);
  EXPECT_EQ(drill.start_diameter_mm, 0.0)
      << "the pilot ends far above the bottom: the whole section is drilled";
  EXPECT_FALSE(drill.peck);
  EXPECT_GT(drill.tool.reach_mm, 160.0);
}

FeatureShape slot(std::vector<geometry::Vec2> section) {
  FeatureShape s;
  s.kind = ShapeKind::kSlot;
  s.name = "S";
  s.depth_mm = section.back().x;
  s.width.nominal_mm = 2.0 * section.back().y;
  s.spine = {{0, 0}, {60, 0}};
  s.area = s.reach = geometry::stroke(s.spine, section.back().y, false);
  s.open = true;
  s.slot_profile = std::move(section);
  return s;
}

TEST(UndercutActions, OpenTheMouthThenAskForAHeadThatFitsAndANeckThatPasses) {
  const FeatureShape tee = slot({{0, 10.5}, {9, 10.5}, {9, 6}, {21, 6}});
  const RuleBase base = with_chain("slot", "it_grade: {from: 0, to: 18}", "t_slot_rough, t_slot_finish");
  const Proposal p = propose(base, tee, {});
  ASSERT_FALSE(p.chains.empty()) << p.cannot;
  const auto& neck = p.chains[0][0];
  const auto& form = p.chains[0][1];
  EXPECT_NEAR(neck.tool.diameter_max_mm, 0.95 * 12.0, 1e-9);
  EXPECT_DOUBLE_EQ(neck.depth_mm, 21.0);
  EXPECT_EQ(form.tool.classes.front(), CutterClass::kTSlotMill);
  EXPECT_DOUBLE_EQ(form.tool.diameter_max_mm, 21.0);
  EXPECT_DOUBLE_EQ(form.tool.cutting_width_max_mm, 9.0);
  EXPECT_NEAR(form.tool.neck_diameter_max_mm, 11.8, 1e-9);
  FeatureShape closed = tee;
  closed.open = false;
  EXPECT_THAT(propose(base, closed, {}).cannot, HasSubstr("open end"));

  const RuleBase dove = with_chain("slot", "it_grade: {from: 0, to: 18}", "dovetail_rough, dovetail_finish");
  const Proposal d = propose(dove, slot({{0, 15}, {8, 10}}), {});
  ASSERT_FALSE(d.chains.empty()) << d.cannot;
  EXPECT_EQ(d.chains[0][1].tool.classes.front(), CutterClass::kDovetailMill);
  EXPECT_DOUBLE_EQ(d.chains[0][1].tool.depth_of_cut_mm, 8.0);
  EXPECT_THAT(propose(dove, tee, {}).cannot, HasSubstr("do not lean"));
}

TEST(EdgeActions, RoundByTheCutterOfTheRadiusAndBreakByTheShopsSize) {
  FeatureShape s = pocket(6.0);
  s.kind = ShapeKind::kEdgeRound;
  s.round_radius_mm = s.depth_mm = 2.0;
  const RuleBase round = with_chain("edge_round", "round_radius_mm: {from: 0, below: 100}", "edge_round");
  const Proposal p = propose(round, s, {});
  ASSERT_FALSE(p.chains.empty()) << p.cannot;
  EXPECT_EQ(p.chains[0][0].tool.classes.front(), CutterClass::kCornerRoundingMill);
  EXPECT_DOUBLE_EQ(p.chains[0][0].tool.corner_radius_exact_mm, 2.0);

  const RuleBase edge = with_chain("pocket", kUpright, "area_rough, break_edge");
  EXPECT_THAT(propose(edge, pocket(6.0), {}).cannot, HasSubstr("no edge is required to be broken"));
  Context c;
  c.edge_break_mm = 0.3;
  const Proposal e = propose(edge, pocket(6.0), c);
  ASSERT_FALSE(e.chains.empty()) << e.cannot;
  const auto& step = e.chains[0].back();
  EXPECT_EQ(step.operation, TypeId::kSideFinishMilling);
  EXPECT_DOUBLE_EQ(step.axial_depth_mm, 0.3);
  EXPECT_NEAR(step.tool.point_angle_rad, 0.5 * std::numbers::pi, 1e-12);
  FeatureShape open = pocket(6.0);
  open.open = true;
  EXPECT_THAT(propose(edge, open, c).cannot, HasSubstr("closed pockets"));
}

TEST(ThreadActions, LockTheOverrides) {
  FeatureShape s = hole(5.0, 20.0);
  s.kind = ShapeKind::kThread;
  s.thread_major_mm = 6.0;
  s.thread_pitch_mm = 1.0;
  s.thread_depth_mm = 12.0;
  Context c;
  c.core_diameter_mm = 5.0;
  c.core_depth_mm = 20.0;
  for (const char* action : {"tap", "thread_mill"}) {
    const RuleBase base = with_chain("thread", "thread_hand: [right]", action);
    const Proposal p = propose(base, s, c);
    ASSERT_FALSE(p.chains.empty()) << p.cannot;
    EXPECT_TRUE(p.chains[0][0].lock_override) << action;
  }
}

}  // namespace
}  // namespace capstan::rules

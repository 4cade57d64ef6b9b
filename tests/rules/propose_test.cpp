#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <span>
#include <vector>

#include "rules/facts/it_grade.h"
#include "rules/rules.h"
#include "tests/rules/proposed.h"
#include "tests/rules/shop.h"

namespace capstan::rules {
namespace {

using drawn::hole;
using model::CutterClass;
using model::FeatureShape;
using model::HoleBottom;
using model::Proposal;
using model::ShapeKind;
using model::TypeId;
using testing::ElementsAre;
using testing::HasSubstr;

constexpr double kDegree = std::numbers::pi / 180.0;

FeatureShape pocket(double corner, double depth = 10.0) {
  FeatureShape s;
  s.kind = ShapeKind::kPocket;
  s.name = "P";
  s.depth_mm = depth;
  s.corner_radius_mm = corner;
  s.area = s.reach = geometry::rounded_rectangle({-40, -20}, {40, 20}, corner);
  return s;
}

TEST(Pattern, ProposesTheSameForEachCopyAsForOne) {
  std::vector<FeatureShape> shapes;
  for (int i = 0; i < 400; ++i) {
    shapes.push_back(h(hole(8, 16), 7));
    shapes.back().frame.origin.x = 20.0 * i;
  }
  const auto proposals = propose_members(shipped(), shapes, steel());
  ASSERT_EQ(proposals.size(), 400U);
  const auto one = propose_members(shipped(), std::span(shapes).first(1), steel());
  for (const auto& p : proposals) ASSERT_EQ(kinds(p.chains.at(0)), kinds(one[0].chains.at(0)));
}

TEST(Spot, IsLeftOutForACarbideDrillToFiveDiametersUnlessAPositionIsAsked) {
  const auto chains = [](double depth, const Context& c) {
    return propose_members(shipped(), std::vector{hole(10, depth)}, c)[0].chains;
  };
  const auto shallow = chains(40, steel());
  EXPECT_EQ(kinds(shallow.at(0)), std::vector{model::TypeId::kMultistepDrilling});
  EXPECT_TRUE(shallow[0][0].tool.solid_carbide);
  EXPECT_TRUE(shallow[0][0].after.empty());
  // Where there is no such drill, any drill after a spot.
  EXPECT_EQ(shallow.at(1).at(0).operation, model::TypeId::kCenterDrilling);
  EXPECT_FALSE(shallow.at(1).at(1).tool.solid_carbide);
  Context placed = steel();
  placed.quality.location_mm = 0.5;
  for (const auto& spotted : {chains(60, steel()).at(0), chains(40, placed).at(0)}) {
    ASSERT_EQ(spotted.at(0).operation, model::TypeId::kCenterDrilling);
    EXPECT_NEAR(spotted[0].tool.point_angle_rad, 142.0 * std::numbers::pi / 180.0, 1e-12);
    EXPECT_TRUE(spotted.at(1).tool.solid_carbide);
  }
}

TEST(ConicalBottom, TakesABlunterDrillAndNeverASharperOneUnlessItsTipHasARadius) {
  FeatureShape s = hole(8, 20, model::HoleBottom::kConical);
  s.bottom_angle_rad = 31.0 * kDegree;  // 118 degrees
  const auto drill = proposed(s).chains.at(0).at(1).tool;
  EXPECT_NEAR(drill.point_angle_rad, 118.0 * kDegree, 1e-12);
  EXPECT_NEAR(drill.point_angle_most_rad, 140.0 * kDegree, 1e-12);
  s.bottom_hole_radius_mm = 0.4;
  EXPECT_EQ(proposed(s).chains.at(0).at(1).tool.point_angle_most_rad, 0.0);
}

TEST(Face, IsMilledAtOnceWhereNoSurfaceIsAskedForAndRoughedFirstElse) {
  FeatureShape s = pocket(0.0);
  s.kind = ShapeKind::kFace;
  s.open = true;
  s.reach = geometry::offset_sharp(s.area, 100.0);  // nothing stands beside it
  for (const double depth : {0.49, 0.5, 2.99}) {
    s.depth_mm = depth;
    EXPECT_THAT(first(proposed(s)), ElementsAre(TypeId::kPlaneFinishMilling)) << depth;
  }
  s.depth_mm = 3.0;
  EXPECT_THAT(first(proposed(s)), ElementsAre(TypeId::kPlaneRoughMilling, TypeId::kPlaneFinishMilling));
  Context fine = steel();
  fine.quality.ra_um = 3.2;
  s.depth_mm = 0.49;
  EXPECT_THAT(first(propose(shipped(), s, fine)), ElementsAre(TypeId::kPlaneFinishMilling));
  s.depth_mm = 0.5;
  const Proposal p = propose(shipped(), s, fine);
  EXPECT_THAT(first(p), ElementsAre(TypeId::kPlaneRoughMilling, TypeId::kPlaneFinishMilling));
  EXPECT_EQ(p.chains[0][0].allowance_bottom_mm, 0.3);
  EXPECT_EQ(p.chains[0][0].tool.classes.front(), CutterClass::kFacemill);
}

TEST(Pocket, LimitsTheCutterByItsCorners) {
  const auto chain = proposed(pocket(6.0)).chains.at(0);
  EXPECT_THAT(kinds(chain),
              ElementsAre(TypeId::kBottomAndSideRoughMilling, TypeId::kBottomAndSideFinishMilling));
  EXPECT_LE(chain[0].tool.diameter_max_mm, 12.0);
  EXPECT_DOUBLE_EQ(chain[1].tool.diameter_max_mm, 12.0);
  EXPECT_THAT(chain[1].why.text, HasSubstr("corners of radius 6 mm"));
  EXPECT_TRUE(chain[0].tool.centre_cutting);
}

TEST(Pocket, WithSharpCornersSaysWhatTheyKeep) {
  EXPECT_THAT(proposed(pocket(0.0)).chains.at(0).at(1).why.text, HasSubstr("corners are sharp"));
}

TEST(Pocket, LimitsTheCutterByTheGapBesideAnIsland) {
  FeatureShape s = pocket(6.0);
  s.islands.push_back({geometry::rectangle({-35, -10}, {20, 10}), 0.0});  // 5 mm from the left wall
  const auto chain = proposed(s).chains.at(0);
  EXPECT_LT(chain[1].tool.diameter_max_mm, 5.0);
  EXPECT_LT(chain[0].tool.diameter_max_mm, chain[1].tool.diameter_max_mm);
}

TEST(Pocket, GetsFewerOrMorePassesByGrade) {
  FeatureShape s = pocket(6.0);
  s.width = {40.0, 0.0, standard_tolerance_mm(14, 40.0), true};
  EXPECT_EQ(row(proposed(s)), "pocket.rough");
  EXPECT_EQ(proposed(s).chains[0][0].allowance_side_mm, 0.0);
  s.width.upper_mm = standard_tolerance_mm(8, 40.0);
  EXPECT_EQ(proposed(s).chains.at(0).size(), 3U);
  s.width.upper_mm = standard_tolerance_mm(6, 40.0);
  EXPECT_EQ(proposed(s).chains.at(0).size(), 4U) << "measured before the last pass";
  s.width.upper_mm = standard_tolerance_mm(5, 40.0);
  EXPECT_THAT(proposed(s).cannot, HasSubstr("[pocket.grind]"));
}

TEST(Pocket, WithAFilletKeepsTheRoughCutterAboveIt) {
  FeatureShape s = pocket(6.0);
  s.bottom_radius_mm = 3.0;
  const auto chain = proposed(s).chains.at(0);
  EXPECT_EQ(chain[1].tool.corner_radius_exact_mm, 3.0);
  // A sharp corner at (side, bottom) of the allowances lies inside the fillet's circle around (3, 3).
  EXPECT_LE(std::hypot(3.0 - chain[0].allowance_side_mm, 3.0 - chain[0].allowance_bottom_mm), 3.0);
}

TEST(Pocket, TooNarrowOrDraftedAndTightGivesAReason) {
  FeatureShape s = pocket(0.0);
  s.area = s.reach = geometry::rectangle({0, 0}, {30, 0.9});
  EXPECT_THAT(proposed(s).cannot, HasSubstr("[pocket.narrow]"));
  FeatureShape d = pocket(6.0);
  d.slope_rad = 5.0 * kDegree;
  EXPECT_THAT(first(proposed(d)), ElementsAre(TypeId::kFreeformRoughMilling, TypeId::kFreeformFinishMilling));
  d.width = {40.0, 0.0, standard_tolerance_mm(8, 40.0), true};
  EXPECT_THAT(proposed(d).cannot, HasSubstr("[pocket.drafted.tight]"));
}

TEST(Pocket, ThatIsOpenNeedsNoCentreCutting) {
  FeatureShape s = pocket(6.0);
  s.open = true;
  const Proposal p = proposed(s);
  for (const auto& step : p.chains.at(0)) EXPECT_FALSE(step.tool.centre_cutting);
}

FeatureShape slot() {
  FeatureShape s = pocket(0.0, 5.0);
  s.kind = ShapeKind::kSlot;
  s.open = true;
  s.spine = {{-40, 0}, {40, 0}};
  s.width.nominal_mm = 10.0;
  s.area = geometry::stroke(s.spine, 5.0, false);
  s.reach = geometry::stroke({{-90, 0}, {90, 0}}, 5.0, false);
  return s;
}

TEST(Slot, OfEachFormGetsItsCutter) {
  const auto square = proposed(slot()).chains.at(0);
  EXPECT_LT(square[1].tool.diameter_max_mm, 10.0);
  EXPECT_GT(square[1].tool.diameter_max_mm, 9.0);
  FeatureShape vee = slot();
  vee.slot_angle_rad = 90.0 * kDegree;
  vee.slot_profile = {{0, 0}, {5, 5}};
  const auto v = proposed(vee).chains.at(0);
  EXPECT_THAT(kinds(v), ElementsAre(TypeId::kBottomAndSideRoughMilling, TypeId::kBottomAndSideFinishMilling));
  EXPECT_NEAR(v[0].allowance_side_mm, 0.3, 1e-12) << "off both flanks";
  // Half way down it is 5 mm wide; across flanks that lean by 45 degrees 0.3 mm are 0.3 sqrt 2.
  EXPECT_NEAR(v[0].tool.diameter_max_mm, 5.0 - 0.6 * std::sqrt(2.0), 1e-9);
  EXPECT_NEAR(v[1].tool.point_angle_rad, 90.0 * kDegree, 1e-12);
  EXPECT_GE(v[1].tool.diameter_min_mm, 10.0);
  FeatureShape round = slot();
  round.slot_profile = {{0, 0}, {5, 5}};
  round.slot_bottom_radius_mm = 5.0;
  EXPECT_EQ(proposed(round).chains.at(0).at(0).tool.corner_radius_exact_mm, 5.0);
  EXPECT_LE(proposed(round).chains.at(1).at(1).tool.diameter_max_mm, 9.0) << "else passes of a narrower ball";
  round.width.given = true;
  round.width.upper_mm = standard_tolerance_mm(9, 10.0);
  EXPECT_EQ(row(proposed(round)), "slot.round.tight");
  EXPECT_THAT(proposed(round).chains.at(0).at(1).tool.classes, ElementsAre(model::CutterClass::kBallEndmill));
  round.width.upper_mm = standard_tolerance_mm(8, 10.0);
  EXPECT_THAT(proposed(round).cannot, HasSubstr("[slot.round.tighter]"));
  FeatureShape radiused = vee;
  radiused.slot_bottom_radius_mm = 3.0;
  radiused.slot_profile = {{0, 0}, {0.88, 2.12}, {5, 6.24}};
  const auto r = proposed(radiused).chains.at(0);
  EXPECT_EQ(r[0].why.id, "slot.vee.radius");
  EXPECT_THAT(r[0].tool.classes, ElementsAre(model::CutterClass::kEndmill));
  EXPECT_EQ(r[1].tool.diameter_max_mm, 6.0) << "no rounder than the tip";
  FeatureShape tee = slot();
  tee.slot_profile = {{0, 9}, {2, 9}, {2, 5}, {5, 5}};
  EXPECT_EQ(row(proposed(tee)), "slot.tee");
  tee.slot_profile = {{0, 9}, {2, 9}, {2, 5}, {3, 7}};
  EXPECT_THAT(proposed(tee).cannot, HasSubstr("[slot.form]")) << "wider again above";
}

TEST(StepAndOutside, AreRoughedAndFinished) {
  FeatureShape s = pocket(0.0);
  s.open = true;
  s.kind = ShapeKind::kStep;
  EXPECT_THAT(first(proposed(s)),
              ElementsAre(TypeId::kBottomAndSideRoughMilling, TypeId::kBottomAndSideFinishMilling));
  s.kind = ShapeKind::kOutside;
  s.islands.push_back({geometry::disc({0, 0}, 10), 0.0});
  EXPECT_THAT(first(proposed(s)),
              ElementsAre(TypeId::kBottomAndSideRoughMilling, TypeId::kBottomAndSideFinishMilling));
  s.through = true;
  EXPECT_THAT(first(proposed(s)), ElementsAre(TypeId::kSideRoughMilling, TypeId::kSideFinishMilling));
}

FeatureShape thread(double major, double pitch, double depth) {
  FeatureShape s = hole(major - pitch, 30, HoleBottom::kFlat);
  s.kind = ShapeKind::kThread;
  s.thread_major_mm = major;
  s.thread_pitch_mm = pitch;
  s.thread_depth_mm = depth;
  return s;
}

TEST(Thread, IsTappedWhereTheLeadHasRoomAndMilledWhereNot) {
  const Proposal tapped = proposed(thread(10, 1.5, 25.5));  // 4.5 mm below: three pitches
  EXPECT_THAT(first(tapped), ElementsAre(TypeId::kTapping));
  EXPECT_DOUBLE_EQ(tapped.chains[0][0].depth_mm, 30.0);
  EXPECT_DOUBLE_EQ(tapped.chains[0][0].tool.thread_pitch_mm, 1.5);
  EXPECT_EQ(row(proposed(thread(10, 1.5, 26))), "thread.mill.short");
  EXPECT_THAT(proposed(thread(10, 1.5, 30)).cannot, HasSubstr("[thread.no_room]"));
  EXPECT_EQ(row(proposed(thread(24, 3, 15))), "thread.mill.large");
  Context c = steel();
  c.abilities.rigid_tapping = false;
  EXPECT_THAT(first(proposed(thread(10, 1.5, 20), c)), ElementsAre(TypeId::kThreadDrilling));
}

TEST(Thread, RefusesAHoleThatIsNoCoreForIt) {
  FeatureShape s = thread(10, 1.5, 20);
  s.diameter.nominal_mm = s.bottom_diameter_mm = 9.2;
  EXPECT_THAT(proposed(s).cannot, HasSubstr("no core for M10x1.5"));
}

TEST(Chamfer, TakesAConeOfItsAngle) {
  FeatureShape s = pocket(6.0);
  s.kind = ShapeKind::kChamfer;
  s.chamfer_width_mm = 1.0;
  s.chamfer_angle_rad = 30.0 * kDegree;
  const auto step = proposed(s).chains.at(0).at(0);
  EXPECT_NEAR(step.tool.point_angle_rad, 120.0 * kDegree, 1e-12);
  EXPECT_NEAR(step.depth_mm, std::tan(30.0 * kDegree), 1e-12);
}

TEST(Unsupported, AlwaysGivesAReason) {
  FeatureShape s = pocket(0.0);
  for (const ShapeKind kind : {ShapeKind::kEdgeRound, ShapeKind::kRoundedEnd, ShapeKind::kToolpath}) {
    s.kind = kind;
    EXPECT_FALSE(proposed(s).cannot.empty());
  }
  EXPECT_FALSE(proposed(hole(0.4, 1)).cannot.empty());
  EXPECT_FALSE(proposed(hole(20000, 1)).cannot.empty()) << "outside the domain";
}

TEST(Surfaces, AreRoughedEvenedOutAndFinishedByABallThatFitsTheirCreases) {
  FeatureShape s = pocket(0.0);
  Context c = steel();
  c.surface_radius_mm = 4.0;
  for (const ShapeKind kind : {ShapeKind::kFreeform, ShapeKind::kSphericalCap}) {
    s.kind = kind;
    const auto p = proposed(s, c);
    EXPECT_THAT(first(p), ElementsAre(TypeId::kFreeformRoughMilling, TypeId::kFreeformRoughMilling,
                                      TypeId::kFreeformRoughMilling, TypeId::kFreeformFinishMilling,
                                      TypeId::kFreeformFinishMilling));
    const double left_mm = p.chains.at(0).at(0).allowance_side_mm;
    for (const std::size_t rest : {1U, 2U}) EXPECT_EQ(p.chains.at(0).at(rest).allowance_side_mm, left_mm);
    const auto& semi = p.chains.at(0).at(3);
    EXPECT_DOUBLE_EQ(semi.allowance_side_mm, 0.2);  // of the row
    EXPECT_DOUBLE_EQ(semi.tool.diameter_max_mm, 0.0) << "it leaves material: any ball will do";
    const auto& last = p.chains.at(0).at(4);
    EXPECT_DOUBLE_EQ(last.allowance_side_mm, 0.0);
    EXPECT_DOUBLE_EQ(last.tool.diameter_max_mm, 8.0);
    EXPECT_EQ(p.chains.back().size(), 4U) << "where no ball bears the terraces, finished at once";
    if (kind == ShapeKind::kSphericalCap) continue;
    // Where the last ball does not bear what a wide one leaves in a fillet of 4 mm, one before it that leaves
    // it 0.4 mm there: (R - 4 - 0.2) (sqrt(2) - 1) = 0.2.
    ASSERT_EQ(p.chains.size(), 3U);
    const auto& narrow = p.chains.at(1).at(3);
    EXPECT_DOUBLE_EQ(narrow.allowance_side_mm, 0.2);
    EXPECT_NEAR(narrow.tool.diameter_max_mm, 2.0 * (4.0 + 0.2 + 0.2 / (std::sqrt(2.0) - 1.0)), 1e-9);
  }
}

TEST(Coolant, FollowsTheMaterialAndTheMachine) {
  EXPECT_TRUE(proposed(hole(10, 20)).chains.at(0).at(0).coolant);
  Context c;
  c.material.iso_group = "K";
  EXPECT_FALSE(proposed(hole(10, 20), c).chains.at(0).at(0).coolant);
  c = steel();
  c.has_coolant = false;
  EXPECT_FALSE(proposed(hole(10, 20), c).chains.at(0).at(0).coolant);
}

}  // namespace
}  // namespace capstan::rules

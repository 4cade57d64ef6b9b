#include <numbers>

#include "rules/facts/facts.h"
#include "rules/facts/it_grade.h"
#include "rules/rules.h"
#include "tests/rules/shop.h"

// Which chain each kind of feature gets in which situation: one line per row of experience.

namespace capstan::rules {
namespace {

using model::FeatureShape;
using model::HoleBottom;
using model::Proposal;
using model::ShapeKind;
using testing::ElementsAre;
using testing::HasSubstr;

// The first chain's actions in order; the reason when there is none.
std::vector<std::string> actions(const FeatureShape& s, const Context& c) {
  const Proposal p = propose(shipped(), s, c);
  std::vector<std::string> out;
  if (p.chains.empty()) return {p.cannot};
  for (const auto& step : p.chains[0]) out.push_back(step.name.substr(step.name.rfind(' ') + 1));
  return out;
}
std::string row(const FeatureShape& s, const Context& c) {
  const Proposal p = propose(shipped(), s, c);
  return p.chains.empty() ? p.cannot : p.chains[0][0].why.id;
}
FeatureShape hole(double d, double depth, int grade = 12) {
  FeatureShape s;
  s.kind = ShapeKind::kHole;
  s.name = "H";
  s.depth_mm = depth;
  s.through = true;
  s.diameter.nominal_mm = s.bottom_diameter_mm = d;
  s.diameter.upper_mm = standard_tolerance_mm(grade, d);
  s.diameter.given = true;
  return s;
}
FeatureShape area(ShapeKind kind, double depth = 10.0, double corner = 8.0) {
  FeatureShape s;
  s.kind = kind;
  s.name = "A";
  s.depth_mm = depth;
  s.area = s.reach = geometry::rounded_rectangle({0, 0}, {80, 40}, corner);
  s.corner_radius_mm = corner;
  return s;
}

TEST(SpotDrill, PassesBesideAWallThatStandsAboveTheHole) {
  Context c = steel();
  EXPECT_EQ(propose(shipped(), hole(5, 8), c).chains[0][0].tool.diameter_max_mm, 0.0);
  c.clear_radius_mm = 4.0;
  // 2 x (4 - 0.25) mm.
  EXPECT_NEAR(propose(shipped(), hole(5, 8), c).chains[0][0].tool.diameter_max_mm, 7.5, 1e-9);
}

TEST(Step, BetweenWallsTakesACutterOfHalfTheirDistance) {
  Context c = steel();
  FeatureShape s = area(ShapeKind::kStep, 6.0, 0.0);
  s.open = true;
  EXPECT_EQ(propose(shipped(), s, c).chains[0][0].tool.diameter_max_mm, 0.0);
  c.between_ends_mm = 24.0;
  EXPECT_NEAR(propose(shipped(), s, c).chains[0][0].tool.diameter_max_mm, 12.0, 1e-9);
}

TEST(DeepHole, IsPeckedThenGunDrilledThenRefused) {
  Context c = steel();
  EXPECT_THAT(actions(hole(10, 25), c), ElementsAre("centre", "drill"));
  EXPECT_FALSE(propose(shipped(), hole(10, 25), c).chains[0][1].peck);
  EXPECT_TRUE(propose(shipped(), hole(10, 40), c).chains[0][1].peck);
  EXPECT_EQ(row(hole(10, 150), c), "hole.long");
  EXPECT_THAT(actions(hole(10, 150), c), ElementsAre("centre", "peck_drill")) << "dry, to 20 diameters";
  EXPECT_THAT(row(hole(10, 250), c), HasSubstr("[hole.gun.dry]"));
  c.has_through_coolant = true;
  EXPECT_EQ(row(hole(10, 60), c), "hole.deep.through");
  EXPECT_TRUE(propose(shipped(), hole(10, 60), c).chains[0][1].coolant_through);
  EXPECT_FALSE(propose(shipped(), hole(10, 60), c).chains.at(1)[1].coolant_through) << "else without";
  EXPECT_THAT(actions(hole(10, 150), c), ElementsAre("centre", "gun_pilot", "gun_drill"));
  EXPECT_TRUE(propose(shipped(), hole(10, 150), c).chains[0][2].tool.coolant_through);
  EXPECT_THAT(row(hole(10, 150, 8), c), HasSubstr("[hole.gun.tight]"));
  EXPECT_THAT(row(hole(10, 1500), c), HasSubstr("[hole.gun.too_deep]"));
  c.quality.location_mm = 0.1;
  EXPECT_THAT(row(hole(10, 150), c), HasSubstr("[hole.gun.position]"));
}

TEST(HoleBelowANarrowerOne, IsMilledFromBelowByAHeadOnANeck) {
  FeatureShape narrow = hole(20, 30);
  FeatureShape wide = hole(26, 10);
  wide.frame.origin.z = -20.0;
  wide.through = true;
  const auto open = propose_members(shipped(), std::vector{narrow, wide}, steel())[1];
  ASSERT_FALSE(open.chains.empty()) << open.cannot;
  ASSERT_EQ(open.chains[0].size(), 1U) << "the narrow hole goes right through";
  const auto& s = open.chains[0][0];
  EXPECT_EQ(s.tool.classes.front(), model::CutterClass::kTSlotMill);
  EXPECT_NEAR(s.tool.diameter_max_mm, 19.6, 1e-9) << "0.2 mm clear on each side";
  EXPECT_NEAR(s.tool.neck_step_min_mm, wide.diameter.middle() - 20.0 + 0.2, 1e-9)
      << "out to the middle of the tolerance, and 0.1 mm clear on each side";
  EXPECT_GE(s.tool.reach_mm, 30.0);
  narrow.depth_mm = 20.0;
  const auto shut = propose_members(shipped(), std::vector{narrow, wide}, steel())[1];
  ASSERT_FALSE(shut.chains.empty()) << shut.cannot;
  EXPECT_EQ(shut.chains[0].front().operation, model::TypeId::kDrilling) << "first the way to the far end";
  EXPECT_LT(shut.chains[0].front().tool.diameter_max_mm, 20.0);
}

// Two coaxial holes entered from the same side, the narrow one above: a back counterbore's work.
TEST(HoleBelowANarrowerOne, IsNotTakenForOneThatIsOpenAbove) {
  FeatureShape narrow = hole(10, 20);
  FeatureShape wide = hole(20, 8);
  wide.frame.origin.z = -20.0;
  const auto proposals = propose_members(shipped(), std::vector{narrow, wide}, steel());
  EXPECT_EQ(proposals[0].chains.at(0)[0].why.id, "hole.drill");
  EXPECT_THAT(proposals[1].cannot, HasSubstr("leaves no room for a neck"));
  EXPECT_THAT(proposals[1].cannot, HasSubstr("[hole.back.counterbore]"));
  FeatureShape cone = hole(10, 5);
  cone.bottom_diameter_mm = 20.0;  // 90 degrees, wider below
  cone.frame.origin.z = -20.0;
  EXPECT_THAT(propose_members(shipped(), std::vector{narrow, cone}, steel())[1].cannot,
              HasSubstr("[hole.back.countersink]"));
  EXPECT_THAT(row(cone, steel()), HasSubstr("[hole.widening]")) << "without a hole above it";
  // The other way round it is an ordinary counterbore.
  wide.frame.origin.z = 0.0;
  narrow.depth_mm = 30.0;
  EXPECT_EQ(propose_members(shipped(), std::vector{narrow, wide}, steel())[1].chains.at(0)[0].why.id,
            "hole.shoulder");
}

TEST(TightCorners, AreRestMachinedWhereThePassageIsMuchWider) {
  const FeatureShape tight = area(ShapeKind::kPocket, 10.0, 3.0);  // 6 mm by a passage of 40 mm
  EXPECT_THAT(actions(tight, steel()), ElementsAre("area_rough", "rest_rough", "area_finish"));
  const auto chain = propose(shipped(), tight, steel()).chains.at(0);
  EXPECT_GT(chain[0].tool.diameter_max_mm, 20.0) << "the passage alone limits the first cutter";
  EXPECT_LE(chain[1].tool.diameter_max_mm, 6.0);
  EXPECT_GT(chain[1].rest_of_diameter_mm, 0.0);
  EXPECT_EQ(chain[0].why.id, "pocket.rest.finish");
  FeatureShape fine = tight;
  fine.width = {40.0, 0.0, standard_tolerance_mm(8, 40.0), true};
  EXPECT_THAT(actions(fine, steel()), ElementsAre("area_rough", "rest_rough", "area_finish", "spring_pass"));
  EXPECT_EQ(row(area(ShapeKind::kPocket, 10.0, 8.0), steel()), "pocket.finish");
}

// The widest mill in corners of R5 is 10 mm: three times that is 30 mm.
TEST(DeepPocket, InSteelOrIronGetsASpringPassWhereAToleranceAsks) {
  const auto of = [](double depth, double corner, int grade) {
    FeatureShape s = area(ShapeKind::kPocket, depth, corner);
    s.width = {40.0, 0.0, standard_tolerance_mm(grade, 40.0), true};
    return s;
  };
  for (const double corner : {5.0, 8.0}) {
    const auto deep = actions(of(6.0 * corner, corner, 10), steel());
    EXPECT_EQ(deep.back(), "spring_pass") << corner;
    EXPECT_EQ(actions(of(5.9 * corner, corner, 10), steel()).back(), "area_finish") << corner;
    EXPECT_EQ(actions(of(6.0 * corner, corner, 12), steel()).back(), "area_finish") << corner;
  }
  Context soft;
  soft.material.iso_group = "N";
  EXPECT_EQ(actions(of(30.0, 5.0, 10), soft).back(), "area_finish");
  // The step before may leave its own radius in the corners, so that it is not more slender than the last.
  const auto chain = propose(shipped(), of(48.0, 8.0, 10), steel()).chains.at(0);
  ASSERT_GE(chain.size(), 3U);
  const auto& before = chain[chain.size() - 2];
  EXPECT_EQ(before.allowance_side_mm, 0.15);
  EXPECT_GE(before.tool.diameter_max_mm, chain.back().tool.diameter_max_mm);
}

TEST(ThinWall, IsFinishedInShallowLevelsAndRefusedWhereItBendsAway) {
  for (const ShapeKind kind : {ShapeKind::kPocket, ShapeKind::kStep, ShapeKind::kOutside, ShapeKind::kSlot}) {
    Context c = steel();
    c.wall_thickness_mm = 2.0;
    FeatureShape s = area(kind, 30.0, 8.0);
    EXPECT_THAT(actions(s, c), ElementsAre("area_rough", "floor_finish", "thin_wall_finish"))
        << to_text(kind);
    const auto chain = propose(shipped(), s, c).chains.at(0);
    EXPECT_EQ(chain[0].allowance_side_mm, 0.5);
    EXPECT_LE(chain[2].axial_depth_mm, 2.0) << "levels no deeper than the wall is thick";
    c.wall_thickness_mm = 0.5;
    EXPECT_THAT(row(s, c), HasSubstr("thin_wall.too_thin]"));
    c.wall_thickness_mm = 5.0;
    EXPECT_THAT(actions(s, c), ElementsAre("area_rough", "area_finish")) << to_text(kind);
    s.through = true;
    c.wall_thickness_mm = 2.0;
    EXPECT_EQ(actions(s, c).back(), "thin_wall_finish") << "nothing below to finish";
  }
}

TEST(ThinFloor, IsFinishedAtOnceBeforeTheWalls) {
  Context c = steel();
  c.floor_thickness_mm = 1.0;
  EXPECT_THAT(actions(area(ShapeKind::kPocket), c), ElementsAre("area_rough", "floor_finish", "area_finish"));
  c.floor_thickness_mm = 5.0;
  EXPECT_THAT(actions(area(ShapeKind::kPocket), c), ElementsAre("area_rough", "area_finish"));
}

TEST(Slot, WiderBelowThanAboveGetsFormCutters) {
  FeatureShape s = area(ShapeKind::kSlot);
  s.spine = {{-40, 0}, {40, 0}};
  s.open = true;
  s.width.nominal_mm = 10.0;
  s.slot_profile = {{0, 9}, {4, 9}, {4, 5}, {10, 5}};
  EXPECT_THAT(actions(s, steel()), ElementsAre("t_slot_rough", "t_slot_finish"));
  s.open = false;
  EXPECT_THAT(row(s, steel()), HasSubstr("[slot.undercut.closed]"));
  s.open = true;
  s.slot_profile = {{0, 11}, {9, 5.8}, {10, 5.8}};  // flanks of 60 degrees under a lip
  EXPECT_THAT(actions(s, steel()), ElementsAre("dovetail_rough", "dovetail_finish"));
  s.width = {10.0, 0.0, standard_tolerance_mm(8, 10.0), true};
  EXPECT_THAT(row(s, steel()), HasSubstr("[slot.dovetail.tight]"));
}

TEST(EdgeRound, TakesACornerRoundingCutterOfItsRadius) {
  FeatureShape s = area(ShapeKind::kEdgeRound);
  s.round_radius_mm = 3.0;
  EXPECT_THAT(actions(s, steel()), ElementsAre("edge_round"));
  EXPECT_THAT(propose(shipped(), s, steel()).chains[0][0].tool.classes,
              ElementsAre(model::CutterClass::kCornerRoundingMill));
  s.round_radius_mm = 0.1;
  EXPECT_THAT(row(s, steel()), HasSubstr("[edge_round.small]"));
  s.round_radius_mm = 30.0;
  EXPECT_THAT(row(s, steel()), HasSubstr("[edge_round.large]"));
}

TEST(Edges, AreBrokenWhereTheShopWantsIt) {
  Context c = steel();
  c.edge_break_mm = 0.3;
  const auto chain = propose(shipped(), hole(10, 25), c).chains.at(0);
  ASSERT_EQ(chain.size(), 3U);
  EXPECT_EQ(chain[2].why.id, "edge_break.upper");
  EXPECT_EQ(chain[2].why.source, "the shop's rule");
  EXPECT_THAT(actions(hole(10, 25, 7), c), ElementsAre("centre", "drill", "break_edge", "ream"))
      << "nothing is cut on a hole after the step that sizes it";
  EXPECT_THAT(actions(area(ShapeKind::kPocket), c), ElementsAre("area_rough", "area_finish", "break_edge"));
  EXPECT_THAT(actions(area(ShapeKind::kFace), c), ElementsAre("plane_rough", "plane_finish"));
  FeatureShape shallow = hole(10, 0.2);
  shallow.through = false;
  shallow.bottom = HoleBottom::kFlat;
  const Proposal kept = propose(shipped(), shallow, c);
  EXPECT_FALSE(kept.chains.empty()) << "a chamfer that has no room is left out, not the hole";
  EXPECT_THAT(kept.rejected.back().what + kept.rejected.front().what, HasSubstr("breaking edges"));
  c.edge_break_mm = 3.0;
  const Proposal wide = propose(shipped(), hole(10, 25), c);
  EXPECT_EQ(wide.chains.at(0).size(), 2U);
  EXPECT_THAT(wide.rejected.at(0).why, HasSubstr("[edge_break.wide]"));
}

TEST(Edges, OfAHoleUnderAWiderOneAreNotBroken) {
  Context c = steel();
  c.edge_break_mm = 0.3;
  FeatureShape wide = hole(20, 8);
  wide.through = false;
  wide.bottom = HoleBottom::kFlat;
  FeatureShape narrow = hole(11, 22);
  narrow.frame.origin.z = -8.0;
  const auto shapes = from_the_top({wide, narrow});
  const auto proposals = propose_members(shipped(), shapes, c);
  EXPECT_THAT(proposals[0].chains.at(0).back().name, HasSubstr("break_edge"));
  EXPECT_THAT(proposals[1].chains.at(0).back().name, HasSubstr("drill"));
}

}  // namespace
TEST(Edges, OfASpottedHoleAreBrokenByTheSpot) {
  Context c = steel();
  c.edge_break_mm = 0.3;
  const auto chains = propose_members(shipped(), std::vector{hole(10, 25)}, c).at(0).chains;
  const auto has_edge = [](const std::vector<model::ProposedStep>& chain) {
    return std::any_of(chain.begin(), chain.end(),
                       [](const auto& s) { return s.name.find("break_edge") != std::string::npos; });
  };
  std::size_t bevelled = 0;
  for (std::size_t i = 0; i < chains.size(); ++i) {
    const model::ProposedStep& spot = chains[i].front();
    if (has_edge(chains[i]) || spot.operation != model::TypeId::kCenterDrilling) continue;
    ++bevelled;
    EXPECT_DOUBLE_EQ(spot.depth_mm, 5.3);  // half of 10 + 2 x 0.3 mm, at 90 degrees
    EXPECT_DOUBLE_EQ(spot.tool.diameter_min_mm, 10.6);
    EXPECT_FALSE(chains[i].at(1).tool.solid_carbide) << "its corners would meet the cone first";
    EXPECT_THAT(spot.why.text, HasSubstr("edge_break.upper"));
    ASSERT_LT(i + 1, chains.size());
    EXPECT_TRUE(has_edge(chains[i + 1])) << "the same chain with a step for the edge comes after it";
  }
  EXPECT_GT(bevelled, 0U);
  // No tip through the bottom.
  const FeatureShape shallow = hole(10, 5);
  const auto proposals = propose_members(shipped(), std::vector{shallow}, c);
  ASSERT_FALSE(proposals.at(0).chains.empty());
  for (const auto& chain : proposals[0].chains) EXPECT_LT(chain.front().depth_mm, 5.0 + 1e-9);
}

}  // namespace capstan::rules

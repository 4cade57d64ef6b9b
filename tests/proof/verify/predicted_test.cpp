#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>
#include <numbers>

#include "tests/proof/verify/checked.h"

// What a step's own numbers say of speed, edge and feed, whoever chose them.

namespace capstan::verify {
namespace {

using ::testing::HasSubstr;
using testing::of;
using testing::PlanMaker;

/// The pocket step of the small plan turns at 3000 1/min with a mill of 10 mm: 94.25 m/min.
constexpr double kSpeed = std::numbers::pi * 10.0 * 3000.0 / 1000.0;

PlanMaker plan_in(double vc_hss, double vc_carbide, model::Substrate substrate) {
  PlanMaker k = testing::good_plan();
  k.plan.material.vc_hss_m_min = vc_hss;
  k.plan.material.vc_carbide_m_min = vc_carbide;
  k.plan.cutters[0].substrate = substrate;
  k.plan.cutters[1].substrate = model::Substrate::kCarbide;
  // The drill is not what is judged: a speed of its own.
  k.plan.cutters[1].presets = {{"steel", 100.0, 0.05, "stated"}};
  return k;
}

TEST(PredictedSpeed, WithinTheCardIsNoFinding) {
  const auto k = plan_in(25, kSpeed, model::Substrate::kCarbide);
  EXPECT_TRUE(of(k, "CHK-SPEED-MATERIAL").empty());
  EXPECT_TRUE(of(k, "CHK-EDGE-LIFE").empty());
}

TEST(PredictedSpeed, AQuarterAboveTheCardIsStillNone) {
  const auto k = plan_in(25, kSpeed / 1.249, model::Substrate::kCarbide);
  EXPECT_TRUE(of(k, "CHK-SPEED-MATERIAL").empty());
}

bool speed_told(const PlanMaker& k) {
  return !of(k, "CHK-SPEED-MATERIAL").empty() || !of(k, "CHK-EDGE-LIFE").empty();
}

/// The pocket's step instead goes to and fro along the block's side, `width` further in with each pass, its
/// first one from outside: all of its cuts are as wide.
PlanMaker along_the_side(double card, double width) {
  PlanMaker k = plan_in(25, card, model::Substrate::kCarbide);
  model::CutterPath p;
  p.start({-10, -6, 10});
  p.rapid({-10, -6, 2});
  for (int i = 1; i <= 6; ++i) {
    const double y = -5.0 + i * width;
    p.line({-10, y, 2}, model::MoveRole::kLink);
    p.line({-10, y, -4}, model::MoveRole::kApproach);
    p.line({110, y, -4}, model::MoveRole::kCut);
    p.line({110, y, 2}, model::MoveRole::kLink);
    p.line({-10, y, 2}, model::MoveRole::kLink);
  }
  p.rapid({-10, 0, 10}, model::MoveRole::kRetract);
  k.plan.steps[0].schedule = std::make_shared<model::FeedSchedule>(
      model::FeedSchedule{std::vector<double>(p.size(), 600.0), std::vector<double>(p.size(), 3000.0),
                          std::vector<double>(p.size(), 0.0)});
  k.plan.steps[0].path = std::make_shared<model::CutterPath>(std::move(p));
  return k;
}

// At 1.4 times the card's speed an edge of carbide lasts 15 / 1.4^4 = 3.9 min: far longer than this step. Its
// cuts are slots: no arc of contact bears more.
TEST(PredictedSpeed, SomewhatAboveTheCardIsAWarningWithBothNumbers) {
  const auto k = along_the_side(kSpeed / 1.4, 10.0);
  const auto found = of(k, "CHK-SPEED-MATERIAL");
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].severity, Severity::kWarning);
  EXPECT_EQ(found[0].step, "pocket");
  EXPECT_THAT(found[0].message, HasSubstr("94.2 m/min"));
  EXPECT_THAT(found[0].message, HasSubstr("lower the spindle to 2142 1/min"));  // 3000 / 1.4
  EXPECT_TRUE(of(k, "CHK-EDGE-LIFE").empty());
}

// A spindle that turns no slower than 2500 1/min cannot be told to turn at 2142.
TEST(PredictedSpeed, BelowWhatTheSpindleTurnsAsksForAnotherTool) {
  auto k = along_the_side(kSpeed / 1.4, 10.0);
  k.plan.machine.spindle.rpm_min = 2500.0;
  const auto found = of(k, "CHK-SPEED-MATERIAL");
  ASSERT_EQ(found.size(), 1u);
  EXPECT_THAT(found[0].message, HasSubstr("the spindle turns no slower than 2500 1/min"));
  EXPECT_EQ(found[0].message.find("lower the spindle"), std::string::npos);
}

// At 94 m/min against 20, and were the card too slow by half against 30: 15 min x (30 / 94.2)^8 = 0.0016 min,
// and the step cuts for more than a minute.
TEST(PredictedSpeed, ThatBurnsTheEdgeWithinItsStepIsAnError) {
  const auto k = plan_in(20, 78, model::Substrate::kHss);
  const auto found = of(k, "CHK-EDGE-LIFE");
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].severity, Severity::kError);
  EXPECT_EQ(found[0].step, "pocket");
}

// A tenth of the diameter wide 1.35 times the speed wears as the table's does: 1.35 x 1.25 = 1.69.
TEST(PredictedSpeed, AboveTheCardIsNoFindingWhereAllArcsOfContactAreShort) {
  const auto k = along_the_side(kSpeed / 1.6, 1.0);
  EXPECT_TRUE(of(k, "CHK-SPEED-MATERIAL").empty());
  EXPECT_TRUE(of(k, "CHK-EDGE-LIFE").empty());
}

TEST(PredictedSpeed, IsToldOfWhereItIsMoreThanShortArcsBear) {
  const auto found = of(along_the_side(kSpeed / 1.85, 1.0), "CHK-SPEED-MATERIAL");
  ASSERT_EQ(found.size(), 1u);
  EXPECT_THAT(found[0].message, HasSubstr("by its arcs of contact; 94.2 m/min are turned"));
}

TEST(PredictedSpeed, ThatShortArcsBearIsToldOfInASlot) {
  EXPECT_EQ(of(along_the_side(kSpeed / 1.6, 10.0), "CHK-SPEED-MATERIAL").size(), 1u);
  EXPECT_EQ(of(plan_in(25, kSpeed / 1.6, model::Substrate::kCarbide), "CHK-SPEED-MATERIAL").size(), 1u);
}

// Six cuts of a tenth of the diameter, the last of them at y = 1, and a short slot at its end.
TEST(PredictedSpeed, ThatShortArcsBearIsToldOfWhereASlotIsAmongThem) {
  PlanMaker k = along_the_side(kSpeed / 1.6, 1.0);
  EXPECT_FALSE(speed_told(k));
  model::CutterPath p = *k.plan.steps[0].path;
  model::FeedSchedule s = *k.plan.steps[0].schedule;
  p.line({50, 1, 2}, model::MoveRole::kLink);
  p.line({50, -6, 2}, model::MoveRole::kLink);
  p.line({50, -6, -4}, model::MoveRole::kApproach);
  p.line({50, 30, -4}, model::MoveRole::kCut);
  p.rapid({50, 30, 10}, model::MoveRole::kRetract);
  s.feed_mm_min.resize(p.size(), 600.0);
  s.spindle_rpm.resize(p.size(), 3000.0);
  s.dwell_s.resize(p.size(), 0.0);
  k.plan.steps[0].path = std::make_shared<model::CutterPath>(p);
  k.plan.steps[0].schedule = std::make_shared<model::FeedSchedule>(s);
  EXPECT_TRUE(speed_told(k));
  // At the table's speed it is right.
  for (std::size_t i = p.size() - 3; i < p.size(); ++i) s.spindle_rpm[i] = 3000.0 / 1.6;
  k.plan.steps[0].schedule = std::make_shared<model::FeedSchedule>(s);
  EXPECT_FALSE(speed_told(k));
}

TEST(PredictedSpeed, ThatShortArcsOfCarbideBearIsToldOfWithHssAndInAluminium) {
  auto hss = along_the_side(60, 1.0);
  hss.plan.material.vc_hss_m_min = kSpeed / 1.6;
  hss.plan.cutters[0].substrate = model::Substrate::kHss;
  EXPECT_FALSE(of(hss, "CHK-SPEED-MATERIAL").empty() && of(hss, "CHK-EDGE-LIFE").empty());
  auto aluminium = along_the_side(kSpeed / 1.6, 1.0);
  aluminium.plan.material.iso_group = "N";
  EXPECT_FALSE(of(aluminium, "CHK-SPEED-MATERIAL").empty() && of(aluminium, "CHK-EDGE-LIFE").empty());
}

TEST(PredictedSpeed, WhatTheCardSaysIsNotCutWithHssIsAnError) {
  const auto found = of(plan_in(0, 60, model::Substrate::kHss), "CHK-SPEED-MATERIAL");
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].severity, Severity::kError);
  EXPECT_THAT(found[0].message, HasSubstr("steel is not cut with hss"));
}

TEST(PredictedSpeed, APresetOfAGroupDoesNotOverruleTheCardThatSaysNotWithHss) {
  auto k = plan_in(0, 60, model::Substrate::kHss);
  k.plan.cutters[0].presets = {{"P", 150.0, 0.5, "stated"}};
  EXPECT_EQ(of(k, "CHK-SPEED-MATERIAL").size(), 1u);
  k.plan.cutters[0].presets[0].material_group = "steel";  // the material itself
  EXPECT_TRUE(of(k, "CHK-SPEED-MATERIAL").empty());
}

TEST(PredictedSpeed, OfAToolThatNobodySaysIsHssIsAWarningWhereCarbideBearsIt) {
  auto k = plan_in(20, 78, model::Substrate::kHss);
  k.plan.cutters[0].sources.emplace_back("substrate", "default: not stated, the slower one");
  const auto found = of(k, "CHK-SPEED-MATERIAL");
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].severity, Severity::kWarning);
  EXPECT_THAT(found[0].message, HasSubstr("that the tool is hss is only assumed"));
  EXPECT_TRUE(of(k, "CHK-EDGE-LIFE").empty());
}

// 94 m/min against 10 of carbide's card, even if that were of a coated edge and too slow by half, 25.5:
// 15 min x (25.5 / 94.2)^4 = 0.08 min, and the step cuts for more than half a minute.
TEST(PredictedSpeed, ThatNeitherHssNorCarbideBearsIsAnErrorWhateverTheToolIsMadeOf) {
  auto k = plan_in(5, 10, model::Substrate::kHss);
  k.plan.cutters[0].sources.emplace_back("substrate", "default: not stated, the slower one");
  EXPECT_EQ(of(k, "CHK-EDGE-LIFE").size(), 1u);
}

TEST(PredictedSpeed, IsNotJudgedWhereNoCardStatesOne) {
  const auto k = plan_in(0, 0, model::Substrate::kHss);
  EXPECT_TRUE(of(k, "CHK-SPEED-MATERIAL").empty());
  EXPECT_TRUE(of(k, "CHK-EDGE-LIFE").empty());
}

// A ball of 10 mm at 0.5 mm depth cuts on a circle of 2 sqrt(0.5 x 9.5) = 4.36 mm only: 41 m/min.
TEST(PredictedSpeed, OfABallIsThatOfTheWidestCircleThatCuts) {
  auto k = plan_in(25, 41, model::Substrate::kCarbide);
  k.plan.cutters[0].cutter_class = model::CutterClass::kBallEndmill;
  k.plan.cutters[0].corner_radius_mm = 5.0;
  k.plan.steps[0].axial_depth_mm = 0.5;
  EXPECT_TRUE(of(k, "CHK-SPEED-MATERIAL").empty());
  k.plan.steps[0].axial_depth_mm = 5.0;
  EXPECT_FALSE(of(k, "CHK-SPEED-MATERIAL").empty() && of(k, "CHK-EDGE-LIFE").empty());
}

// A face mill of 10 mm at its tip, its edges leaning by 45 degrees, is 18 mm wide 4 mm above it: 170 m/min.
TEST(PredictedSpeed, OfALeaningFaceMillIsThatOfTheCircleWhereItsEdgesLeaveTheMaterial) {
  auto k =
      along_the_side(kSpeed / 1.2, 10.0);  // which the tip alone would bear: less than a quarter above it
  k.plan.cutters[0].cutter_class = model::CutterClass::kFacemill;
  k.plan.steps[0].axial_depth_mm = 4.0;
  EXPECT_FALSE(speed_told(k));
  k.plan.cutters[0].lead_angle_rad = 0.25 * std::numbers::pi;
  EXPECT_TRUE(speed_told(k));
  k.plan.steps[0].axial_depth_mm = 0.1;
  EXPECT_FALSE(speed_told(k));
}

/// A spot of 2 mm with a cone of 90 degrees and 8 mm, which cuts on a circle of 4 mm.
PlanMaker spot(double card, double rpm) {
  PlanMaker k = plan_in(25, card, model::Substrate::kCarbide);
  model::Cutter& c = k.plan.cutters[1];
  c.cutter_class = model::CutterClass::kSpotDrill;
  c.point_angle_rad = 0.5 * std::numbers::pi;
  c.presets.clear();
  model::CutterPath p;
  p.start({15, 15, 10});
  p.rapid({15, 15, 2});
  p.line({15, 15, -2}, testing::MoveRole::kDrill);
  p.rapid({15, 15, 10}, testing::MoveRole::kRetract);
  const auto* drilled = k.plan.model.get<model::MachiningWorkingstep>(k.plan.steps[1].step);
  const auto feature = drilled->its_feature;
  k.plan.steps.pop_back();
  const auto& s = k.step<model::CenterDrilling>("spot", feature, "d8", p, 0.1 * rpm, rpm);
  const auto* ws = k.plan.model.get<model::MachiningWorkingstep>(s.step);
  k.plan.model.get<model::CenterDrilling>(ws->its_operation)->cutting_depth = 2.0;
  return k;
}

bool told_of_spot(const PlanMaker& k) {
  auto all = of(k, "CHK-SPEED-MATERIAL");
  const auto life = of(k, "CHK-EDGE-LIFE");
  all.insert(all.end(), life.begin(), life.end());
  return std::any_of(all.begin(), all.end(), [](const auto& f) { return f.step == "spot"; });
}

// The card's speed on the small circle is twice that of the tool's diameter; three times as fast is not
// borne.
TEST(PredictedSpeed, OfASpotIsThatOfTheCircleThatIsIn) {
  const double rpm = 1000.0 * kSpeed / (std::numbers::pi * 4.0);
  EXPECT_FALSE(told_of_spot(spot(kSpeed, rpm)));
  EXPECT_TRUE(told_of_spot(spot(kSpeed, 3.0 * rpm)));
}

/// A finishing of a free surface with a ball of 10 mm, 0.5 mm deep, carbide's card at 41 m/min: on a level
/// floor it cuts at 41 m/min, on a steep one at 94.
PlanMaker freeform(double life_min) {
  auto k = plan_in(25, 41, model::Substrate::kCarbide);
  k.plan.cutters[0].cutter_class = model::CutterClass::kBallEndmill;
  k.plan.cutters[0].corner_radius_mm = 5.0;
  auto* ws = k.plan.model.get<model::MachiningWorkingstep>(k.plan.steps[0].step);
  ws->its_operation = k.plan.model.add(model::FreeformFinishMilling{});
  k.plan.steps[0].axial_depth_mm = 0.5;
  k.plan.steps[0].loads.tool_life_min = life_min;
  return k;
}

// 15 min at 41 m/min; at 1.25 times less speed 15 x 1.25^4 = 36.6 min, and at 1.25 times more 6.1.
TEST(PredictedSpeed, OfABallOnAFreeSurfaceIsThatOfItsDiameterUnlessThePlanMeasuredLess) {
  EXPECT_TRUE(speed_told(freeform(0.0)));
  EXPECT_FALSE(speed_told(freeform(15.0)));
  EXPECT_TRUE(speed_told(freeform(5.0)));  // it says itself that it is fast
}

TEST(PredictedSpeed, IsJudgedWhateverLifeAFileClaims) {
  EXPECT_TRUE(speed_told(freeform(1e6)));
  // In with all of its radius a ball cuts on its diameter.
  auto k = freeform(15.0);
  k.plan.steps[0].axial_depth_mm = 5.0;
  EXPECT_TRUE(speed_told(k));
  // On no free surface the depth says on what circle it cuts: 0.7 mm, 5.1 mm, 48 m/min.
  auto pocket = plan_in(25, 30, model::Substrate::kCarbide);
  pocket.plan.cutters[0].cutter_class = model::CutterClass::kBallEndmill;
  pocket.plan.cutters[0].corner_radius_mm = 5.0;
  pocket.plan.steps[0].axial_depth_mm = 0.7;
  pocket.plan.steps[0].loads.tool_life_min = 1e6;
  EXPECT_TRUE(speed_told(pocket));
}

// A drill of 8 mm at 2.5 times the card's speed: 15 / (2.5 / 1.5 / 1.3)^4 = 5.5 min were it coated, as a mill
// would be 15 / (2.5 / 1.5 / 1.7)^4 = 16.2.
TEST(PredictedSpeed, OfACoatedDrillIsNotThatOfACoatedMill) {
  auto k = plan_in(10, 30, model::Substrate::kCarbide);
  k.plan.material.iso_group = "P";
  k.plan.cutters[1].presets.clear();
  const double rpm = 1000.0 * 2.5 * 30.0 / (std::numbers::pi * k.plan.cutters[1].cutting_diameter_mm);
  double minutes = 0.0;
  const auto drill = [&](double feed) {
    testing::edit_schedule(k.plan, 1, [&](model::FeedSchedule& s) {
      for (double& f : s.feed_mm_min) f = feed;
      for (double& n : s.spindle_rpm) n = rpm;
    });
    const auto& path = *k.plan.steps[1].path;
    minutes = 0.0;
    for (std::size_t i = 1; i < path.size(); ++i)
      if (path.kind[i] != model::MoveKind::kRapid) minutes += model::move_length(path, i) / feed;
  };
  drill(1.0);
  const double at_one = minutes;
  drill(at_one / 10.0);  // ten minutes in the hole
  ASSERT_NEAR(minutes, 10.0, 1e-9);
  EXPECT_FALSE(of(k, "CHK-EDGE-LIFE").empty());
  drill(at_one / 4.0);
  const auto all = of(k, "CHK-EDGE-LIFE");
  EXPECT_TRUE(std::none_of(all.begin(), all.end(), [](const auto& f) { return f.step == "drill"; }));
}

// Two steps of one tool and 0.7 of an edge each take two edges, and are told once, where the first ends.
TEST(PredictedEdges, ThatAToolTakesMoreThanOneOfAreToldOnceWithTheirNumber) {
  auto k = plan_in(25, kSpeed, model::Substrate::kCarbide);
  const auto* ws = k.plan.model.get<model::MachiningWorkingstep>(k.plan.steps[0].step);
  const auto feature = ws->its_feature;
  k.step<model::BottomAndSideRoughMilling>("again", feature, "em10", testing::pocket_path(), 600, 3000);
  double minutes = 0.0;
  const auto path = testing::pocket_path();
  for (std::size_t i = 2; i + 1 < path.size(); ++i)  // all but the rapids at both ends, straight lines
    minutes +=
        std::hypot(path.x[i] - path.x[i - 1], path.y[i] - path.y[i - 1], path.z[i] - path.z[i - 1]) / 600.0;
  k.plan.steps[0].loads.tool_life_min = k.plan.steps[2].loads.tool_life_min = minutes / 0.7;
  auto found = of(k, "CHK-EDGES");
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].severity, Severity::kNote);
  EXPECT_EQ(found[0].step, "again");
  EXPECT_THAT(found[0].message, HasSubstr("it takes 2 edges"));
  // 2.1 in all: even if the law were wrong by its factor of two, the first edge does not last.
  k.plan.steps[2].loads.tool_life_min = minutes / 1.4;
  found = of(k, "CHK-EDGES");
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].severity, Severity::kWarning);
  EXPECT_THAT(found[0].message, HasSubstr("it takes 3 edges"));
  k.plan.steps[2].loads.tool_life_min = minutes / 0.2;  // 0.9 in all
  EXPECT_TRUE(of(k, "CHK-EDGES").empty());
}

// A tool of 10 mm and 4 teeth at 3000 1/min fed with 60 mm/min takes 0.005 mm: more than 0.3 of a carbide
// edge's 0.008 mm, less than all of it, which alloys that harden ask.
TEST(PredictedFeed, ThatSteelBearsRubsInWhatHardens) {
  PlanMaker k = testing::good_plan();
  k.plan.cutters[0].substrate = model::Substrate::kCarbide;
  testing::edit_schedule(k.plan, 0, [](model::FeedSchedule& s) {
    for (double& f : s.feed_mm_min) f = 60;
  });
  EXPECT_TRUE(of(k, "CHK-RUB").empty());
  k.plan.material.iso_group = "S";
  const auto found = of(k, "CHK-RUB");
  ASSERT_EQ(found.size(), 1u);
  EXPECT_THAT(found[0].message, HasSubstr("at least 0.008 mm in steel"));
  // What the tool is said to be fed with is no rubbing.
  k.plan.cutters[0].presets = {{"S", 30.0, 0.005, "stated"}};
  EXPECT_TRUE(of(k, "CHK-RUB").empty());
}

// 5 mm/min at 3000 1/min with four teeth: 0.000417 mm, of which three decimals would say nothing.
TEST(PredictedFeed, ThatIsFarTooSmallIsToldWithItsDigits) {
  PlanMaker k = testing::good_plan();
  k.plan.cutters[0].substrate = model::Substrate::kCarbide;
  testing::edit_schedule(k.plan, 0, [](model::FeedSchedule& s) {
    for (double& f : s.feed_mm_min) f = 5;
  });
  const auto found = of(k, "CHK-RUB");
  ASSERT_EQ(found.size(), 1u);
  EXPECT_THAT(found[0].message, HasSubstr("down to 0.00042 mm per tooth"));
}

// Planning has other depths, tools and ways; what a file states is the file's to know.
TEST(PredictedFeed, ThatRubsIsAnErrorWherePlanningChoseItAndAWarningWhereAFileStatesIt) {
  PlanMaker k = testing::good_plan();
  k.plan.cutters[0].substrate = model::Substrate::kCarbide;
  k.plan.material.iso_group = "S";
  testing::edit_schedule(k.plan, 0, [](model::FeedSchedule& s) {
    for (double& f : s.feed_mm_min) f = 60;
  });
  auto found = of(k, "CHK-RUB");
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].severity, Severity::kWarning);
  const auto* ws = k.plan.model.get<model::MachiningWorkingstep>(k.plan.steps[0].step);
  ASSERT_NE(ws, nullptr);
  model::MillingTechnology technology;
  technology.feedrate = 60.0;
  auto* op = k.plan.model.get<model::MachiningOperation>(ws->its_operation);
  ASSERT_NE(op, nullptr);
  op->its_technology = k.plan.model.add(technology);
  k.plan.ledger.bind(op->its_technology, "feedrate", model::Binder::kOptimiser,
                     {"cut", "the quickest", "own"}, {}, {});
  found = of(k, "CHK-RUB");
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].severity, Severity::kError);
}

// What an aluminium mill bears in aluminium says nothing of steel: the limit there stays 0.02 D = 0.2 mm.
TEST(PredictedFeed, OfAnotherMaterialsPresetIsNoLimitInThisOne) {
  PlanMaker k = testing::good_plan();
  testing::edit_schedule(k.plan, 0, [](model::FeedSchedule& s) {
    for (double& f : s.feed_mm_min) f = 0.3 * 4 * 3000;
  });
  EXPECT_FALSE(of(k, "CHK-FEED-TOOL").empty());
  k.plan.cutters[0].presets = {{"N", 300.0, 0.25, "stated"}};
  EXPECT_FALSE(of(k, "CHK-FEED-TOOL").empty());
  k.plan.cutters[0].presets = {{"P", 300.0, 0.25, "stated"}};
  EXPECT_TRUE(of(k, "CHK-FEED-TOOL").empty());
  // One for a material of the group lets it bear that much in the others, and no more.
  k.plan.cutters[0].presets = {{"11SMn30", 300.0, 0.31, "stated (ISO group P)"}};
  EXPECT_TRUE(of(k, "CHK-FEED-TOOL").empty());
  k.plan.cutters[0].presets = {{"11SMn30", 300.0, 0.25, "stated (ISO group P)"}};
  EXPECT_FALSE(of(k, "CHK-FEED-TOOL").empty());
}

}  // namespace
}  // namespace capstan::verify

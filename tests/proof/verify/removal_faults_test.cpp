#include <gtest/gtest.h>

#include <numbers>

#include "tests/proof/verify/checked.h"

// Steps that cut nothing (35) and what stays of planned features (36), on the small plan that is right.

namespace capstan::verify {
namespace {

using model::MoveRole;
using testing::check;
using testing::down_to;
using testing::found;
using testing::PlanMaker;
using testing::told;

model::Cutter spot_drill() {
  model::Cutter c = testing::drill();
  c.id = "spot6";
  c.cutter_class = model::CutterClass::kSpotDrill;
  c.cutting_diameter_mm = 6;
  c.point_angle_rad = 0.5 * std::numbers::pi;
  c.pocket = 4;
  return c;
}

TEST(CutsNothing, ASpotDrillAfterTheHoleItMarksIsFound) {
  PlanMaker k = testing::good_plan();
  k.plan.cutters.push_back(spot_drill());
  const auto* drilled = k.plan.model.get<model::MachiningWorkingstep>(k.plan.steps[1].step);
  // A point of 90 degrees, 3 mm deep, in a hole of 8: all air.
  k.step<model::CenterDrilling>("late spot", drilled->its_feature, "spot6", down_to(15, 15, -3), 100, 1500);
  const auto findings = check(k.plan);
  EXPECT_NE(found(findings, "CHK-CUTS-NOTHING", "late spot"), nullptr) << told(findings);
}

TEST(CutsNothing, RoughingOfWhatIsGoneAlreadyIsFound) {
  PlanMaker k = testing::good_plan();
  const auto* milled = k.plan.model.get<model::MachiningWorkingstep>(k.plan.steps[0].step);
  k.step<model::BottomAndSideRoughMilling>("again", milled->its_feature, "em10", testing::pocket_path(), 600,
                                           3000);
  const auto findings = check(k.plan);
  EXPECT_NE(found(findings, "CHK-CUTS-NOTHING", "again"), nullptr) << told(findings);
}

TEST(CutsNothing, AFinishingPassAlongTheFinishedSurfaceIsNoFault) {
  PlanMaker k = testing::good_plan();
  const auto* milled = k.plan.model.get<model::MachiningWorkingstep>(k.plan.steps[0].step);
  k.step<model::BottomAndSideFinishMilling>("spring", milled->its_feature, "em10", testing::pocket_path(),
                                            600, 3000);
  const auto findings = check(k.plan);
  EXPECT_EQ(found(findings, "CHK-CUTS-NOTHING", "spring"), nullptr) << told(findings);
}

TEST(CutsNothing, AFinishingPassInAirIsFound) {
  PlanMaker k = testing::good_plan();
  const auto* milled = k.plan.model.get<model::MachiningWorkingstep>(k.plan.steps[0].step);
  model::CutterPath p = testing::pocket_path();
  // Five millimetres above the floor and within 9 of the middle: 15 mm off the walls.
  for (double& z : p.z) z = z == -10.0 ? -5.0 : z;
  for (auto* v : {&p.x, &p.y}) {
    for (double& x : *v) x = 50 + 0.25 * (x - 50);
  }
  k.step<model::BottomAndSideFinishMilling>("in air", milled->its_feature, "em10", p, 600, 3000);
  const auto findings = check(k.plan);
  EXPECT_NE(found(findings, "CHK-CUTS-NOTHING", "in air"), nullptr) << told(findings);
}

TEST(CutsNothing, AReamersRingThinnerThanACellIsACut) {
  PlanMaker k = testing::good_plan();
  testing::with_reamer(k, 300);
  // A ring of 0.02 mm on the radius; cells are 0.2 mm wide.
  k.plan.cutters[1].cutting_diameter_mm = 7.96;
  const auto findings = check(k.plan);
  EXPECT_TRUE(findings.empty()) << told(findings);
}

TEST(Left, APocketHalfAMillimetreTooShallowIsFoundWithPlaceAndAmount) {
  PlanMaker k = testing::good_plan();
  testing::edit_path(k.plan, 0, [](auto& p) {
    for (double& z : p.z) z = z == -10.0 ? -9.5 : z;
  });
  const auto findings = check(k.plan);
  const auto* f = found(findings, "CHK-LEFT", "pocket");
  ASSERT_NE(f, nullptr) << told(findings);
  EXPECT_NE(f->message.find("0.5 mm of P"), std::string::npos) << f->message;
}

TEST(Left, AWallHalfAMillimetreTooThickIsFound) {
  PlanMaker k = testing::good_plan();
  testing::edit_path(k.plan, 0, [](auto& p) {
    for (double& x : p.x) x = x == 65.0 ? 64.5 : x;
  });
  const auto findings = check(k.plan);
  EXPECT_NE(found(findings, "CHK-LEFT", "pocket"), nullptr) << told(findings);
}

TEST(Left, WhatTheStepStatesAsAllowanceIsNoFault) {
  PlanMaker k = testing::good_plan();
  testing::edit_path(k.plan, 0, [](auto& p) {
    for (double& z : p.z) z = z == -10.0 ? -9.5 : z;
  });
  const auto* ws = k.plan.model.get<model::MachiningWorkingstep>(k.plan.steps[0].step);
  k.plan.model.get<model::BottomAndSideRoughMilling>(ws->its_operation)->allowance_bottom = 0.5;
  const auto findings = check(k.plan);
  EXPECT_TRUE(findings.empty()) << told(findings);
}

TEST(Left, AHoleThatEndsAboveItsDepthIsFound) {
  PlanMaker k = testing::good_plan();
  testing::edit_path(k.plan, 1, [](auto& p) { p.z[2] += 1.0; });
  const auto findings = check(k.plan);
  EXPECT_NE(found(findings, "CHK-LEFT", "drill"), nullptr) << told(findings);
}

TEST(Left, ACornerTooTightForTheCutterIsFoundAndASharpOneIsNot) {
  // Radius 5 stated, cut with 8: the corner keeps (8 - 5) (sqrt 2 - 1) = 1.24 mm across. None stated, cut
  // with 3: as the tool has it.
  for (const bool stated : {true, false}) {
    PlanMaker k = testing::good_plan();
    const double wide = stated ? 16.0 : 6.0;
    k.plan.cutters[0].cutting_diameter_mm = wide;
    k.plan.cutters[0].shank_diameter_mm = wide;
    testing::edit_path(k.plan, 0, [&](auto& p) {
      for (auto* v : {&p.x, &p.y}) {
        for (double& x : *v) x = 50 + (20.0 - 0.5 * wide) / 15.0 * (x - 50);
      }
    });
    const auto* ws = k.plan.model.get<model::MachiningWorkingstep>(k.plan.steps[0].step);
    if (!stated) k.plan.model.get<model::ClosedPocket>(ws->its_feature)->orthogonal_radius = {};
    const auto findings = check(k.plan);
    EXPECT_EQ(found(findings, "CHK-LEFT", "pocket") != nullptr, stated) << told(findings);
  }
}

TEST(Left, NothingStaysInCornersForWhichTheFileStatesARadiusOfZero) {
  // The mill of 10 leaves 5 (sqrt 2 - 1) = 2.07 mm across each.
  PlanMaker k = testing::good_plan();
  const auto* ws = k.plan.model.get<model::MachiningWorkingstep>(k.plan.steps[0].step);
  k.plan.model.get<model::ClosedPocket>(ws->its_feature)->orthogonal_radius = k.length(0);
  const auto findings = check(k.plan);
  EXPECT_NE(found(findings, "CHK-LEFT", "pocket"), nullptr) << told(findings);
}

TEST(Left, WhatAMillTooWideForAPocketLeavesInItsCornersIsFound) {
  // No radius stated: 3 mm may stay, for a sixth of its depth of 10 mm is less; a mill of 10 leaves 5. Its
  // way leaves the rest as the one of 6 does.
  for (const double wide : {6.0, 10.0}) {
    PlanMaker k = testing::good_plan();
    k.plan.cutters[0].cutting_diameter_mm = wide;
    k.plan.cutters[0].shank_diameter_mm = wide;
    testing::edit_path(k.plan, 0, [&](auto& p) {
      for (auto* v : {&p.x, &p.y}) {
        for (double& x : *v) x = 50 + (20.0 - 0.5 * wide) / 15.0 * (x - 50);
      }
    });
    const auto* ws = k.plan.model.get<model::MachiningWorkingstep>(k.plan.steps[0].step);
    k.plan.model.get<model::ClosedPocket>(ws->its_feature)->orthogonal_radius = {};
    const auto findings = check(k.plan);
    EXPECT_EQ(found(findings, "CHK-LEFT", "pocket") != nullptr, wide > 8.0) << told(findings);
  }
}

/// A slot of 10 mm along x from 40 to 70 at y = 75, 5 mm deep, cut by the mill of 10 between its centres.
PlanMaker slotted(bool square_ends) {
  PlanMaker k = testing::good_plan();
  model::SquareUProfile u;
  u.width = k.length(10);
  model::Direction along;
  along.direction_ratios = {{1.0, 0.0, 0.0}, true};
  model::LinearPath course;
  course.distance = k.length(square_ends ? 40 : 30);
  course.its_direction = k.plan.model.add(along);
  model::Slot slot;
  slot.its_id = "S";
  slot.feature_placement = k.at(square_ends ? 35 : 40, 80, 0);
  slot.depth = k.depth(5);
  slot.swept_shape = k.plan.model.add(u);
  slot.course_of_travel = k.plan.model.add(course);
  for (int i = 0; i < 2; ++i) {
    if (square_ends) {
      slot.end_conditions.push_back(k.plan.model.add(model::OpenSlotEndType{}));
    } else {
      slot.end_conditions.push_back(k.plan.model.add(model::RadiusedSlotEndType{}));
    }
  }
  model::CutterPath p;
  p.start({40, 80, 10});
  p.rapid({40, 80, 2});
  p.line({40, 80, -5}, MoveRole::kPlunge);
  p.line({70, 80, -5}, MoveRole::kCut);
  p.rapid({70, 80, 10}, MoveRole::kRetract);
  k.step<model::BottomAndSideFinishMilling>("slot", k.plan.model.add(slot), "em10", p, 600, 3000);
  return k;
}

TEST(Left, SquareEndsOfASlotInTheBlockThatAMillLeavesRoundAreFound) {
  for (const bool square : {true, false}) {
    const auto findings = check(slotted(square).plan);
    EXPECT_EQ(found(findings, "CHK-LEFT", "slot") != nullptr, square) << told(findings);
  }
}

/// Lines along x, close enough that nothing stays between them, then along the walls of 40 mm at x = 70; open
/// to the right.
model::CutterPath between_walls(double radius, double z) {
  model::CutterPath p;
  p.start({120, 30 + radius, 10});
  p.rapid({120, 30 + radius, z});
  for (double y = 30 + radius; y < 70 - radius; y += radius) {
    p.line({120, y, z}, MoveRole::kCut);
    p.line({70 + radius, y, z}, MoveRole::kCut);
    p.line({120, y, z}, MoveRole::kCut);
  }
  p.line({120, 30 + radius, z}, MoveRole::kCut);
  p.line({70 + radius, 30 + radius, z}, MoveRole::kCut);
  p.line({70 + radius, 70 - radius, z}, MoveRole::kCut);
  p.line({120, 70 - radius, z}, MoveRole::kCut);
  p.rapid({120, 70 - radius, 10}, MoveRole::kRetract);
  return p;
}

TEST(Left, WhatAWideMillLeavesInAStepsSharpCornersIsFound) {
  // 3 mm may stay, for a sixth of 5 mm is less; a mill of 20 leaves 10 (sqrt 2 - 1) = 4.1 mm across.
  for (const double wide : {6.0, 20.0}) {
    PlanMaker k = testing::empty_plan();
    k.plan.cutters[0].cutting_diameter_mm = k.plan.cutters[0].shank_diameter_mm = wide;
    model::Direction along;
    along.direction_ratios = {{0.0, 1.0, 0.0}, true};
    model::LinearPath course;
    course.distance = k.length(40);
    course.its_direction = k.plan.model.add(along);
    model::Step step;
    step.its_id = "S";
    step.feature_placement = k.at(70, 30, 0);
    step.depth = k.depth(5);
    step.open_boundary = k.plan.model.add(course);
    k.step<model::BottomAndSideFinishMilling>("step", k.plan.model.add(step), "em10",
                                              between_walls(0.5 * wide, -5), 600, 3000);
    const auto findings = check(k.plan);
    EXPECT_EQ(found(findings, "CHK-LEFT", "step") != nullptr, wide > 6.0) << told(findings);
  }
}

TEST(Left, WhatAMillLeavesAtAnOpenSideWithinTheBlockIsFound) {
  // Radius 6 is stated for the walls: it may stay at x = 70, not where the pocket opens at x = 90.
  for (const double opens : {100.0, 90.0}) {
    PlanMaker k = testing::empty_plan();
    model::Polyline walls;
    for (const auto& [x, y] : {std::pair{opens, 70.0}, {70.0, 70.0}, {70.0, 30.0}, {opens, 30.0}})
      walls.points.push_back(k.point(x - 70, y - 50, 0));
    model::GeneralProfile profile;
    profile.its_profile = k.plan.model.add(walls);
    model::OpenPocket pocket;
    pocket.its_id = "P";
    pocket.feature_placement = k.at(70, 50, 0);
    pocket.depth = k.depth(5);
    pocket.bottom_condition = k.plan.model.add(model::PlanarPocketBottomCondition{});
    pocket.orthogonal_radius = k.length(6);
    pocket.open_boundary = k.plan.model.add(profile);
    model::CutterPath p = between_walls(5, -5);
    for (double& x : p.x) x = x == 120 ? (opens < 100 ? opens - 5 : x) : x;
    k.step<model::BottomAndSideFinishMilling>("pocket", k.plan.model.add(pocket), "em10", p, 600, 3000);
    const auto findings = check(k.plan);
    EXPECT_EQ(found(findings, "CHK-LEFT", "pocket") != nullptr, opens < 100) << told(findings);
  }
}

TEST(Left, AHoleRightThroughThatOpensIntoACrossBoreIsDoneThereIfThePlanMakesTheBore) {
  enum Bore { kPlanned, kUnplanned, kNone };
  for (const Bore bore : {kPlanned, kUnplanned, kNone}) {
    PlanMaker k = testing::good_plan();
    const auto* ws = k.plan.model.get<model::MachiningWorkingstep>(k.plan.steps[1].step);
    k.plan.model.get<model::RoundHole>(ws->its_feature)->bottom_condition =
        k.plan.model.add(model::ThroughBottomCondition{});
    if (bore !=
        kNone) {  // 30 mm wide about z = -30: over the hole's 8 mm it reaches up to -30 + sqrt(15^2 - 4^2)
      model::Direction along;
      along.direction_ratios = {{-1.0, 0.0, 0.0}, true};
      model::Axis2Placement3d at;
      at.location = k.point(0, 15, -30);
      at.axis = k.plan.model.add(along);
      model::Direction up;
      up.direction_ratios = {{0.0, 0.0, 1.0}, true};
      at.ref_direction = k.plan.model.add(up);
      const auto cross = k.hole("CROSS", 0, 0, 30, 100);
      k.plan.model.get<model::RoundHole>(cross)->feature_placement = k.plan.model.add(at);
      model::CutterPath p;  // what it cuts is not looked at here
      p.start({0, 0, 10});
      p.line({5, 0, 10}, MoveRole::kCut);
      k.step<model::Drilling>("bore", cross, "d8", p, 225, 1500);
      if (bore == kUnplanned) k.plan.unplanned.push_back({cross, "no drill is long enough"});
    }
    const auto findings = check(k.plan);
    EXPECT_EQ(found(findings, "CHK-LEFT", "drill") == nullptr, bore == kPlanned) << told(findings);
  }
}

TEST(Left, WhatNoCellTellsIsNoted) {
  PlanMaker k = testing::good_plan();
  const auto* ws = k.plan.model.get<model::MachiningWorkingstep>(k.plan.steps[0].step);
  k.plan.model.get<model::ClosedPocket>(ws->its_feature)->slope = 0.1;
  const auto findings = check(k.plan);
  EXPECT_TRUE(std::any_of(findings.begin(), findings.end(), [](const auto& f) {
    return f.code == "CHK-NOT-JUDGED" && f.severity == Severity::kNote &&
           f.message.find("of P, its leaning walls") != std::string::npos;
  })) << told(findings);
}

TEST(Left, AllThatNoCellTellsOfAFeatureIsNoted) {
  for (const double diameter : {8.0, 0.3}) {
    PlanMaker k = testing::good_plan();
    const auto* ws = k.plan.model.get<model::MachiningWorkingstep>(k.plan.steps[1].step);
    auto* hole = k.plan.model.get<model::RoundHole>(ws->its_feature);
    hole->diameter = k.length(diameter);
    model::DiameterTaper taper;  // a cone, as that of a countersink
    taper.final_diameter = k.length(0.5 * diameter);
    hole->change_in_diameter = k.plan.model.add(taper);
    std::string note;
    for (const auto& f : check(k.plan)) {
      if (f.code == "CHK-NOT-JUDGED" && f.step == "drill") note = f.message;
    }
    EXPECT_EQ(note.find("all of it") != std::string::npos, diameter < 1.0) << note;
    EXPECT_EQ(note.find("the cone of its wall: what stays there is not looked at") != std::string::npos,
              diameter > 1.0)
        << note;
  }
}

TEST(Left, AnUnplannedFeatureIsLeftOut) {
  PlanMaker k = testing::good_plan();
  testing::edit_path(k.plan, 0, [](auto& p) {
    for (double& z : p.z) z = z == -10.0 ? -9.5 : z;
  });
  const auto* ws = k.plan.model.get<model::MachiningWorkingstep>(k.plan.steps[0].step);
  k.plan.unplanned.push_back({ws->its_feature, "its finishing is not planned"});
  const auto findings = check(k.plan);
  EXPECT_EQ(found(findings, "CHK-LEFT", "pocket"), nullptr) << told(findings);
}

}  // namespace
}  // namespace capstan::verify

#include <gtest/gtest.h>

#include <algorithm>

#include "planner/proof/verify/verify.h"
#include "tests/proof/verify/checked.h"

namespace capstan::verify {
namespace {

using testing::check;
using testing::PlanMaker;
using testing::replaced;
using testing::told;

std::vector<model::Finding> check(const std::string& text, const model::Plan& plan) {
  Job job;
  return check_program({"part.ngc", text, ""}, &plan, plan.machine, plan.cutters, job);
}

const model::Finding* find(const std::vector<model::Finding>& findings, const std::string& code) {
  const auto at =
      std::find_if(findings.begin(), findings.end(), [&](const auto& f) { return f.code == code; });
  return at == findings.end() ? nullptr : &*at;
}

model::FixtureSolid box(const char* id, double x0, double y0, double x1, double y1, double z0, double z1) {
  return {id, "clamp", {{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}}, z0, z1, true};
}

/// The piece of 100 x 100 x 50 between two jaws that hold its lower 15 mm.
PlanMaker held() {
  PlanMaker k = testing::good_plan();
  auto& h = k.plan.setups[0].holding;
  h.id = "vise";
  h.clearance_mm = 2.0;
  h.solids = {box("vise.fixed_jaw", 0, 100, 100, 120, -75, -35),
              box("vise.moving_jaw", 0, -20, 100, 0, -75, -35)};
  return k;
}

TEST(Fixtures, APieceHeldBelowWhatIsCutHasNoFinding) {
  const auto findings = check(held().plan);
  EXPECT_TRUE(findings.empty()) << told(findings);
}

TEST(Holding, GrippingSolidsInOnePlaceAreFound) {
  PlanMaker k = held();
  auto& solids = k.plan.setups[0].holding.solids;
  solids.push_back(box("clamp 1", 2, 2, 6, 6, 0, 5));
  solids.push_back(box("clamp 2", 6, 2, 10, 6, 0, 5));
  EXPECT_EQ(find(check(k.plan), "CHK-HOLD-OVERLAP"), nullptr) << "they touch only";
  solids.back() = box("clamp 2", 5, 2, 9, 6, 3, 8);
  const auto findings = check(k.plan);
  const auto* f = find(findings, "CHK-HOLD-OVERLAP");
  ASSERT_NE(f, nullptr) << told(findings);
  EXPECT_EQ(f->property, 31);
  EXPECT_EQ(f->severity, Severity::kError);
  EXPECT_NE(f->message.find("1 mm into"), std::string::npos) << f->message;  // across x; 2 mm in height
  solids.back().id = "clamp 1.bolt";
  solids.back().presses = false;
  EXPECT_EQ(find(check(k.plan), "CHK-HOLD-OVERLAP"), nullptr) << "parts of one clamp may";
}

TEST(Holding, AClampAloneIsAWarning) {
  PlanMaker k = held();
  auto& solids = k.plan.setups[0].holding.solids;
  solids = {box("clamp 1", 2, 2, 6, 6, 0, 5)};
  auto findings = check(k.plan);
  const auto* f = find(findings, "CHK-HOLD-ALONE");
  ASSERT_NE(f, nullptr) << told(findings);
  EXPECT_EQ(f->severity, Severity::kWarning);
  solids.push_back(box("clamp 2", 94, 94, 98, 98, 0, 5));
  findings = check(k.plan);
  EXPECT_EQ(find(findings, "CHK-HOLD-ALONE"), nullptr) << told(findings);
}

TEST(Holding, AForceBelowTwiceThatOfTheHeaviestMillingStepIsAWarning) {
  PlanMaker k = held();
  k.plan.steps[0].loads.peak_force_n = 1000;
  k.plan.steps[1].loads.peak_force_n = 5000;  // a drill's thrust does not slide the piece
  for (const auto& [force, told_so] : {std::pair{0.0, false}, {1999.0, true}, {2001.0, false}}) {
    k.plan.setups[0].holding.holding_force_n = force;
    const auto findings = check(k.plan);
    const auto* f = find(findings, "CHK-HOLD-FORCE");
    ASSERT_EQ(f != nullptr, told_so) << force << told(findings);
    if (f != nullptr) {
      EXPECT_EQ(f->step, "pocket");
    }
  }
}

TEST(Fixtures, ARapidIntoAClampIsNamedWithMoveAndClamp) {
  PlanMaker k = held();
  k.plan.setups[0].holding.solids.push_back(box("clamp 7", 10, 10, 20, 20, 0, 6));
  const auto findings = check(k.plan);
  const auto* f = find(findings, "CHK-RAPID-FIXTURE");
  ASSERT_NE(f, nullptr) << told(findings);
  EXPECT_EQ(f->property, 9);
  EXPECT_EQ(f->step, "drill");
  EXPECT_EQ(f->move, 1);  // the rapid down to z = 2, 4 mm into the clamp's top
  EXPECT_NE(f->message.find("'clamp 7'"), std::string::npos) << f->message;
  EXPECT_NE(f->message.find("by 4 mm"), std::string::npos) << f->message;
}

TEST(Fixtures, ACutIntoAClampTouchesIt) {
  PlanMaker k = held();
  // The cutter's axis comes to x = 65; the clamp begins 4 mm further, the radius is 5.
  k.plan.setups[0].holding.solids.push_back(box("clamp 2", 69, 40, 90, 60, -12, 6));
  const auto findings = check(k.plan);
  const auto* f = find(findings, "CHK-CLAMP-CUT");
  ASSERT_NE(f, nullptr) << told(findings);
  EXPECT_EQ(f->property, 31);
  EXPECT_EQ(f->step, "pocket");
  EXPECT_NE(f->message.find("by 1 mm"), std::string::npos) << f->message;
}

TEST(Fixtures, AClampNearerThanTheClearanceIsAWarning) {
  PlanMaker k = held();
  k.plan.setups[0].holding.solids.push_back(box("clamp 2", 71, 40, 90, 60, -2, 6));
  const auto findings = check(k.plan);
  const auto* f = find(findings, "CHK-FIXTURE-NEAR");
  ASSERT_NE(f, nullptr) << told(findings);
  EXPECT_EQ(f->severity, Severity::kWarning);
  EXPECT_NE(f->message.find("passes 1 mm"), std::string::npos) << f->message;
  k.plan.setups[0].holding.clearance_mm = 0.5;
  EXPECT_EQ(find(check(k.plan), "CHK-FIXTURE-NEAR"), nullptr);
}

TEST(Fixtures, TheHolderClearsTheJawsOrIsNamed) {
  PlanMaker k = held();
  // A jaw of 20 mm above the piece; the axis comes to y = 65, so that a holder of 80 reaches y = 105.
  k.plan.setups[0].holding.solids[0].top_mm = 20;
  k.plan.cutters[0].holder_diameter_mm = 80;
  k.plan.cutters[0].stick_out_mm = 40;
  EXPECT_EQ(find(check(k.plan), "CHK-HOLDER-FIXTURE"), nullptr);  // -10 + 40 is 10 mm above the jaw
  k.plan.cutters[0].stick_out_mm = 25;
  const auto findings = check(k.plan);
  const auto* f = find(findings, "CHK-HOLDER-FIXTURE");
  ASSERT_NE(f, nullptr) << told(findings);
  EXPECT_EQ(f->property, 12);
  EXPECT_NE(f->message.find("vise.fixed_jaw"), std::string::npos) << f->message;
}

/// A head of 50 that is 10 high, under an arbor of 22.
model::Cutter wide_head() {
  model::Cutter c = testing::endmill();
  c.id = "head50";
  c.cutting_diameter_mm = 50;
  c.maximum_depth_of_cut_mm = 10;
  c.shank_diameter_mm = 22;
  c.stick_out_mm = 90;
  c.holder_diameter_mm = 22;
  c.pocket = 5;
  return c;
}

TEST(Fixtures, AHeadThatPassesAnOverhangOnItsWayDownIsNamed) {
  PlanMaker k = held();
  k.plan.setups[0].security_z_mm = 80;
  // Down beside a bar that ends 15 or 18 mm from the axis; the head's radius is 25. At its lowest the head is
  // 3 mm under the bar, and the arbor 4 mm or more beside it.
  k.plan.setups[0].holding.solids.push_back(box("bar", -45, 0, -20, 100, 8, 20));
  k.plan.cutters.push_back(wide_head());
  for (const double x : {-5.0, -2.0}) {
    for (const bool rapid : {true, false}) {
      PlanMaker one = k;
      model::CutterPath p;
      p.start({x, -50, 80});
      p.rapid({x, 50, 80});
      if (rapid)
        p.rapid({x, 50, -5});
      else
        p.line({x, 50, -5}, model::MoveRole::kPlunge);
      p.rapid({x, 50, 80}, model::MoveRole::kRetract);
      one.step<model::BottomAndSideRoughMilling>("head", one.pocket("E", 50, 96, 30, 10), "head50", p, 600,
                                                 3000);
      const auto findings = check(one.plan);
      const auto* f = find(findings, rapid ? "CHK-RAPID-FIXTURE" : "CHK-CLAMP-CUT");
      ASSERT_NE(f, nullptr) << told(findings);
      EXPECT_EQ(f->step, "head");
      EXPECT_NE(f->message.find("the cutter enters 'bar'"), std::string::npos) << f->message;
      EXPECT_NE(f->message.find(x < -4 ? "by 10 mm" : "by 7 mm"), std::string::npos) << f->message;
    }
  }
}

TEST(Fixtures, ARampMeetsAnOverhangOnlyWhereItIsAtThatHeight) {
  PlanMaker k = held();
  k.plan.setups[0].security_z_mm = 80;
  k.plan.cutters.push_back(wide_head());
  model::CutterPath p;
  p.start({-70, 50, 80});
  p.line({-70, 50, 60}, model::MoveRole::kRamp);
  p.line({30, 50, 10}, model::MoveRole::kRamp);  // 1 mm down on 2
  p.rapid({30, 50, 80}, model::MoveRole::kRetract);
  k.step<model::BottomAndSideRoughMilling>("ramp", k.pocket("E", 50, 96, 30, 10), "head50", p, 600, 3000);
  // From x = -70 to -40, where the head leaves the low bar, its underside comes down from 60 to 45.
  k.plan.setups[0].holding.solids.push_back(box("low bar", -75, 40, -65, 60, 0, 40));
  EXPECT_EQ(find(check(k.plan), "CHK-CLAMP-CUT"), nullptr) << told(check(k.plan));
  k.plan.setups[0].holding.solids.back() = box("high bar", -45, 40, -35, 60, 40, 50);
  EXPECT_NE(find(check(k.plan), "CHK-CLAMP-CUT"), nullptr) << told(check(k.plan));
}

TEST(Bodies, AToolThatIsNotDescribedIsSaidNotToBeJudged) {
  PlanMaker k = held();
  k.plan.cutters[0].holder_diameter_mm = 0;
  auto findings = check(k.plan);
  ASSERT_EQ(findings.size(), 1U) << told(findings);
  EXPECT_EQ(findings[0].code, "CHK-BODY-UNDECIDED");
  EXPECT_EQ(findings[0].property, 12);
  EXPECT_EQ(findings[0].severity, Severity::kWarning);
  EXPECT_NE(findings[0].message.find("tool 'em10': its holder is not described"), std::string::npos);
  k.plan.cutters[0].stick_out_mm = 0;
  k.plan.cutters[0].shank_diameter_mm = 0;
  findings = check(k.plan);
  const auto* f = find(findings, "CHK-BODY-UNDECIDED");
  ASSERT_NE(f, nullptr) << told(findings);
  EXPECT_NE(f->message.find("stick-out is not stated"), std::string::npos) << f->message;
  EXPECT_NE(f->message.find("taken as thick as its cutter, 10 mm"), std::string::npos) << f->message;
  k.plan.setups[0].holding = {};
  EXPECT_EQ(find(check(k.plan), "CHK-BODY-UNDECIDED")->severity, Severity::kNote);
}

TEST(Bodies, AShankOfUnknownSizeIsAsThickAsTheCutter) {
  PlanMaker k = held();
  k.plan.cutters[0].shank_diameter_mm = 0;
  // The axis comes to x = 65 at z = -10; the flutes end at 12, where the overhang begins 4 mm from it.
  k.plan.setups[0].holding.solids.push_back(box("bridge", 69, 40, 90, 60, 13, 25));
  k.plan.setups[0].security_z_mm = 10;
  EXPECT_NE(find(check(k.plan), "CHK-HOLDER-FIXTURE"), nullptr) << told(check(k.plan));
  k.plan.cutters[0].stick_out_mm = 0;
  EXPECT_NE(find(check(k.plan), "CHK-HOLDER-FIXTURE"), nullptr) << told(check(k.plan));
}

TEST(Holder, ASegmentOfTheHolderThatEntersTheStockIsNamed) {
  PlanMaker k = testing::good_plan();
  k.plan.cutters[0].holder = {{10, 20, 20}, {30, 50, 50}};
  k.plan.cutters[0].stick_out_mm = 40;
  EXPECT_TRUE(check(k.plan).empty()) << told(check(k.plan));
  // The tip goes to -10: at 15 mm stick-out the first segment ends at 15, the second begins there. At 8 the
  // first is 2 mm deep in a pocket that is wide enough for it only later.
  k.plan.cutters[0].stick_out_mm = 8;
  const auto findings = check(k.plan);
  const auto* f = find(findings, "CHK-HOLDER");
  ASSERT_NE(f, nullptr) << told(findings);
  EXPECT_EQ(f->property, 12);
  EXPECT_NE(f->message.find("2 mm into material"), std::string::npos) << f->message;
}

TEST(Holder, AThickShankThatEntersTheStockIsNamed) {
  PlanMaker k = testing::good_plan();
  k.plan.cutters[0].shank_diameter_mm = 16;
  EXPECT_TRUE(check(k.plan).empty()) << told(check(k.plan));  // flutes of 22 in a pocket of 10
  k.plan.cutters[0].maximum_depth_of_cut_mm = 7;
  EXPECT_NE(find(check(k.plan), "CHK-SHANK"), nullptr);
}

TEST(Grip, AJawThatDoesNotTouchThePieceIsNamed) {
  PlanMaker k = held();
  for (auto& p : k.plan.setups[0].holding.solids[1].outline) p.y -= 3.0;
  const auto findings = check(k.plan);
  const auto* f = find(findings, "CHK-HOLD-CONTACT");
  ASSERT_NE(f, nullptr) << told(findings);
  EXPECT_EQ(f->property, 31);
  EXPECT_NE(f->message.find("vise.moving_jaw"), std::string::npos) << f->message;
}

TEST(Grip, MaterialCutAwayInFrontOfAJawIsNamed) {
  PlanMaker k = held();
  auto& jaw = k.plan.setups[0].holding.solids[0];
  jaw.top_mm = -5;
  // A cut along the edge in front of the jaw, 20 mm long and 10 deep: 5 mm of them were held.
  model::CutterPath p;
  p.start({40, 96, 10});
  p.rapid({40, 96, 2});
  p.line({40, 96, -10}, model::MoveRole::kPlunge);
  p.line({60, 96, -10}, model::MoveRole::kCut);
  p.rapid({60, 96, 10}, model::MoveRole::kRetract);
  k.step<model::BottomAndSideRoughMilling>("edge", k.pocket("E", 50, 96, 30, 10), "em10", p, 600, 3000);
  const auto findings = check(k.plan);
  const auto* f = find(findings, "CHK-HOLD-CUT");
  ASSERT_NE(f, nullptr) << told(findings);
  EXPECT_EQ(f->property, 31);
  EXPECT_EQ(f->step, "edge");
  EXPECT_NE(find(findings, "CHK-CLAMP-CUT"), nullptr) << told(findings);
}

TEST(Grip, AClampWhoseSeatIsMilledAwayNoLongerHolds) {
  PlanMaker k = held();
  k.plan.setups[0].holding.solids.push_back(box("clamp 1", 48, 48, 52, 52, 0, 1));
  EXPECT_NE(find(check(k.plan), "CHK-HOLD-LOST"), nullptr) << told(check(k.plan));
}

/// A second set-up in which the piece lies on its top: x stays, y and z are turned.
void flip(PlanMaker& k) {
  model::Axis2Placement3d frame;
  frame.location = k.point(0, 100, -50);
  model::Direction down, x;
  down.direction_ratios = {{0.0, 0.0, -1.0}, true};
  x.direction_ratios = {{1.0, 0.0, 0.0}, true};
  frame.axis = k.plan.model.add(down);
  frame.ref_direction = k.plan.model.add(x);
  model::WorkpieceSetup ws;
  ws.its_origin = k.plan.model.add(frame);
  model::Setup s;
  s.its_id = "flipped";
  s.its_workpiece_setup.push_back(k.plan.model.add(ws));
  k.plan.setups.push_back({k.plan.model.add(s), "G55", 10.0});
}

/// Goes down by rapid where the first set-up may have drilled through: (15, 15) is (15, 85) here.
void rapid_into_the_hole(PlanMaker& k) {
  model::CutterPath p;
  p.start({15, 85, 10});
  p.rapid({15, 85, -20});
  p.rapid({15, 85, 10}, model::MoveRole::kRetract);
  model::Cutter thin = testing::drill();
  thin.id = "d6";
  thin.cutting_diameter_mm = 6;
  thin.shank_diameter_mm = 6;
  thin.pocket = 4;
  k.plan.cutters.push_back(thin);
  k.step<model::Drilling>("second", k.hole("H2", 15, 15, 8, 20), "d6", p, 100, 500).setup = 1;
}

TEST(Carry, ASecondSetupBeginsWithWhatTheFirstLeft) {
  PlanMaker k = testing::good_plan();
  flip(k);
  rapid_into_the_hole(k);
  const auto solid = check(k.plan);
  const auto* f = find(solid, "CHK-RAPID-DOWN");
  ASSERT_NE(f, nullptr) << told(solid);  // the hole of the first set-up is 20 deep of 50
  EXPECT_EQ(f->step, "second");
  testing::edit_path(k.plan, 1, [](auto& p) { p.z[2] = -55.0; });
  const auto through = check(k.plan);
  EXPECT_EQ(find(through, "CHK-RAPID-DOWN"), nullptr) << told(through);
}

TEST(Carry, AHoleFromTheOtherSideEndsWhereTheFirstOneWas) {
  PlanMaker k = testing::good_plan();
  flip(k);
  // The pocket's floor is at -10 in the first set-up, -40 here: a rapid to -41 inside it passes its floor.
  model::CutterPath p;
  p.start({15, 85, 10});
  p.line({15, 85, -35}, model::MoveRole::kDrill);  // meets the blind hole: 20 deep from the other side
  p.rapid({15, 85, 10}, model::MoveRole::kRetract);
  k.step<model::Drilling>("second", k.hole("H2", 15, 15, 8, 20), "d8", p, 225, 1500).setup = 1;
  rapid_into_the_hole(k);
  const auto findings = check(k.plan);
  EXPECT_EQ(find(findings, "CHK-RAPID-DOWN"), nullptr) << told(findings);
}

TEST(Coolant, IsOnWhereTheOperationAsksAndTheMachineHasIt) {
  PlanMaker k = testing::good_plan();
  model::MillingMachineFunctions f;
  f.coolant = true;
  const auto& ws = k.plan.model.at<model::MachiningWorkingstep>(k.plan.steps[0].step);
  k.plan.model.get<model::MachiningOperation>(ws.its_operation)->its_machine_functions = k.plan.model.add(f);
  EXPECT_TRUE(check(k.plan).empty()) << told(check(k.plan));
  k.plan.steps[0].flood = false;
  ASSERT_NE(find(check(k.plan), "CHK-COOLANT"), nullptr);
  EXPECT_EQ(find(check(k.plan), "CHK-COOLANT")->property, 29);
  k.plan.steps[0].flood = true;
  k.plan.machine.has_flood = false;
  EXPECT_NE(find(check(k.plan), "CHK-COOLANT-MACHINE"), nullptr);
  k.plan.machine.has_flood = k.plan.machine.has_through = true;
  k.plan.steps[1].through = true;
  EXPECT_NE(find(check(k.plan), "CHK-COOLANT-TOOL"), nullptr);
  k.plan.cutters[1].coolant_through = true;
  EXPECT_TRUE(check(k.plan).empty()) << told(check(k.plan));
}

TEST(Coolant, IsOnInTheProgramWhereTheStepWantsIt) {
  const model::Plan plan = testing::good_plan().plan;
  const std::string text = testing::program_of(plan);
  EXPECT_EQ(find(check(text, plan), "CHK-COOLANT"), nullptr);
  const auto findings = check(replaced(text, "M8\n", "M9\n"), plan);
  const auto* f = find(findings, "CHK-COOLANT");
  ASSERT_NE(f, nullptr) << told(findings);
  EXPECT_EQ(f->step, "pocket");
  model::Plan dry = plan;
  for (auto& s : dry.steps) s.flood = false;
  EXPECT_NE(find(check(text, dry), "CHK-COOLANT-DRY"), nullptr);
  // Mist that the machine has not, instead of the flood that the step wants: both are said.
  model::Plan none = plan;
  none.machine.has_mist = false;
  const auto both = check(replaced(text, "M8\n", "M7\n"), none);
  EXPECT_NE(find(both, "CHK-COOLANT-MACHINE"), nullptr) << told(both);
  EXPECT_NE(find(both, "CHK-COOLANT"), nullptr) << told(both);
}

TEST(ToolLife, LastsForTheCutsOrIsSaidToRunOut) {
  PlanMaker k = testing::good_plan();
  // The pocket is cut at 600 mm/min along 2 levels of (32 + 64 + 96 + 120) x 4 / 2 mm and more: over a
  // minute.
  k.plan.cutters[0].life_min = 30;
  EXPECT_TRUE(check(k.plan).empty()) << told(check(k.plan));
  k.plan.cutters[0].life_used_min = 29.5;
  const auto findings = check(k.plan);
  const auto* f = find(findings, "CHK-TOOL-LIFE");
  ASSERT_NE(f, nullptr) << told(findings);
  EXPECT_EQ(f->property, 30);
  EXPECT_NE(f->message.find("0.5 min are left"), std::string::npos) << f->message;
  // A sister that is worn out takes no life from another one.
  k.plan.cutters[0].life_used_min = 20;
  k.plan.cutters[0].sisters = {{"em10 b", 7, -60}};
  EXPECT_TRUE(check(k.plan).empty()) << told(check(k.plan));
  k.plan.cutters[0].life_used_min = 29.5;
  k.plan.cutters[0].sisters = {{"em10 b", 7, 20}};
  EXPECT_TRUE(check(k.plan).empty()) << told(check(k.plan));
}

/// A program of one contour with T1, radius 5, `lead` mm of lead-in and a concave arc of `radius`.
std::string compensated(double lead, double radius, const char* after = "G1 G40 X0 Y0\n") {
  const auto n = [](double v) { return trimmed(v, 3); };
  return "%\nG21 G17 G90 G94 G40 G80 G49\nM5\nG53 G0 Z0\nT1 M6\nG54\nG43 H1\nS3000 M3\nM8\nG0 X0 Y0\nG0 Z2\n"
         "G1 Z-1 F600\nG1 G41 D1 X" +
         n(lead) + " Y0\nG1 X40 Y0\nG3 X" + n(40 + radius) + " Y" + n(radius) + " I0 J" + n(radius) +
         "\nG1 Y60\n" + after + "G0 Z50\nM5 M9\nG53 G0 Z0\nM30\n%\n";
}

std::vector<model::Finding> alone(const std::string& text) {
  Job job;
  const model::Plan plan = testing::good_plan().plan;
  return check_program({"hand.ngc", text, ""}, nullptr, plan.machine, plan.cutters, job);
}

TEST(Compensation, ALongLeadInAndWideArcsHaveNoFinding) {
  const auto findings = alone(compensated(8, 6));
  EXPECT_TRUE(std::none_of(findings.begin(), findings.end(), [](const auto& f) { return f.property == 25; }))
      << told(findings);
}

TEST(Compensation, EachWayToGoWrongIsFound) {
  EXPECT_NE(find(alone(compensated(4, 6)), "CHK-COMP-LEAD"), nullptr);
  const auto narrow = alone(compensated(8, 3));
  const auto* f = find(narrow, "CHK-COMP-CONCAVE");
  ASSERT_NE(f, nullptr) << told(narrow);
  EXPECT_EQ(f->property, 25);
  EXPECT_NE(f->message.find("radius 3 mm"), std::string::npos) << f->message;
  EXPECT_NE(find(alone(compensated(8, 6, "")), "CHK-COMP-END"), nullptr);
  EXPECT_NE(find(alone(compensated(8, 6, "G53 G0 Z0\nT2 M6\n")), "CHK-COMP-CHANGE"), nullptr);
  // The same arc seen from the other side is convex: the tool runs round its outside.
  EXPECT_EQ(find(alone(replaced(compensated(8, 3), "G41", "G42")), "CHK-COMP-CONCAVE"), nullptr);
  EXPECT_NE(
      find(alone(replaced(compensated(8, 6), "G1 G41 D1 X8 Y0", "G3 G41 D1 X8 Y0 I4 J0")), "CHK-COMP-ARC"),
      nullptr);
}

}  // namespace
}  // namespace capstan::verify

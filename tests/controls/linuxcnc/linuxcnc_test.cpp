#include "planner/controls/linuxcnc/linuxcnc.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <sstream>
#include <utility>

#include "planner/ground/base/number.h"
#include "tests/controls/control_plans.h"
#include "tests/controls/linuxcnc/written.h"

namespace capstan::controls::linuxcnc {
namespace {

using model::MoveKind;
using std::numbers::pi;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;

std::string failure_of(const Plan& plan) {
  Job job;
  const auto text = kDialect.write_program(plan, job, {});
  return text ? "" : text.error().code;
}

std::size_t position(const std::string& text, const std::string& what, std::size_t from = 0) {
  const auto at = text.find(what, from);
  EXPECT_NE(at, std::string::npos) << what << " in\n" << text;
  return at;
}

TEST(LinuxCnc, StatesEverythingAtAStepAndChangesToolsRetractedWithTheSpindleOff) {
  Plan plan = testing::empty_plan();
  testing::add_step(plan, "rough contour", "em18", contour());
  const std::string expected =
      "(CAPSTAN STEP id=\"rough%20contour\" n=1 tool=1 setup=1)\n"
      "G21 G17 G90 G94 G40 G80\n"
      "G64 P0.01\n"
      "G54\n"
      "T1 M6\n"
      "G43 H1\n"
      "S3000 M3\n"
      "G4 P1.5\n"
      "G0 X-12 Y-12\n"
      "M8\n"
      "G0 Z5\n"
      "G0 Z1\n"
      "G1 Z-3 F600\n"
      "G1 X50.1235\n"
      "G3 X60.1235 Y-2 I-0.000022 J10.000022\n"
      "G1 Y40\n";
  const std::string text = program_of(plan);
  EXPECT_THAT(text, HasSubstr("G53 G0 Z0\nM5\nM9\n\n" + expected));
  EXPECT_THAT(text, ::testing::EndsWith("(end)\nG53 G0 Z0\nM5\nM9\nM2\n"));
  EXPECT_THAT(text, HasSubstr("(part: bracket [left])\n"));
  EXPECT_THAT(text, HasSubstr("(CAPSTAN TOOL T1 H1 length=50 diameter=18 id=\"em18\" endmill)\n"));
}

TEST(LinuxCnc, RestatesTheStateAtAStepWithTheSameToolAndLinksOverTheSecurityPlane) {
  Plan plan = testing::empty_plan();
  testing::add_step(plan, "a", "em18", contour());
  testing::add_step(plan, "b", "em18", contour());
  const std::string text = program_of(plan);
  const auto second = position(text, "id=\"b\"");
  EXPECT_EQ(text.substr(text.find('\n', second) + 1, 100).substr(0, 94),
            std::string(
                "G21 G17 G90 G94 G40 G80\nG64 P0.01\nG54\nG43 H1\nG0 Z20\nS3000 M3\nG0 X-12 Y-12\nM8\nG0 Z5\n"
                "G0 Z1\nG1 Z-3 F600\n")
                .substr(0, 94));
  EXPECT_EQ(text.find("M6", second), std::string::npos);
}

TEST(LinuxCnc, StopsForTheOperatorBetweenSetUps) {
  Plan plan = testing::empty_plan();
  plan.setups.push_back({.setup = {}, .work_offset = "G55", .security_z_mm = 30.0});
  testing::add_step(plan, "a", "em18", contour());
  testing::add_step(plan, "b", "em18", contour()).setup = 1;
  const std::string text = program_of(plan);
  const auto second = position(text, "id=\"b\"");
  EXPECT_EQ(text.substr(position(text, "(CAPSTAN STEP id=\"b\"") - 16, 16), "G53 G0 Z0\nM5\nM9\n");
  const auto stop = position(
      text,
      "(MSG, set-up 2: clamp the workpiece anew, not turned, its +Z up; set G55: X0 at its left side, "
      "Y0 at its front, Z0 at its top, then continue)\nM0\n",
      second);
  EXPECT_LT(stop, position(text, "\nG55\n", second));
  EXPECT_LT(position(text, "\nG55\n", second), position(text, "G0 X-12", second));
}

TEST(LinuxCnc, SaysAtEachSetUpWhereZeroIsAndWhatHoldsThePiece) {
  Plan plan = testing::empty_plan();
  plan.setups.push_back({.setup = {}, .work_offset = "G55", .security_z_mm = 30.0});
  auto& h = plan.setups[1].holding;
  h.description = "plate with strap clamps (M12)";
  h.pickup_text = "lower left corner of the raw piece, Z at its top";
  h.solids.push_back({"clamp 1", "clamp", {{-10, 20}, {15, 20}, {15, 45}, {-10, 45}}, 0.0, 18.5, true});
  h.solids.push_back({std::string(400, '('), "plate", {{0, 0}, {50, 0}, {50, 40}}, -20.0, 0.0, false});
  testing::add_step(plan, "a", "em18", contour());
  testing::add_step(plan, "b", "em18", contour()).setup = 1;
  const std::string text = program_of(plan);
  const auto first = position(text,
                              "(set-up 1: zero G54 on the raw piece as it lies: X0 at its left side, "
                              "Y0 at its front, Z0 at its top; that is the point X0 Y0 Z0 of the part's "
                              "drawing)\n");
  EXPECT_LT(first, position(text, "(set-up 1: what holds the piece is not planned"));
  EXPECT_LT(first, position(text, "(CAPSTAN STEP id=\"a\""));
  const auto zero =
      position(text, "(set-up 2: pick up G55: lower left corner of the raw piece, Z at its top)\n");
  EXPECT_LT(position(text, "(CAPSTAN STEP id=\"b\""), zero);
  EXPECT_LT(zero, position(text, "(MSG, set-up 2"));
  EXPECT_NE(text.find("(set-up 2: held by plate with strap clamps [M12])\n"), std::string::npos);
  EXPECT_NE(text.find("(set-up 2: clamp 1: X -10 to 15, Y 20 to 45, Z 0 to 18.5 mm)\n"), std::string::npos);
  for (std::size_t at = 0, end = 0; (end = text.find('\n', at)) != std::string::npos; at = end + 1)
    EXPECT_LE(end - at, 255U);
}

TEST(LinuxCnc, SaysHowAPieceThatIsTurnedLiesAndWhereZeroIsOnIt) {
  // 100 x 80 x 20 mm, its top at Z0; turned over about its X axis: its -Z up, its -Y to the back, zero at the
  // lower left corner of what lies there.
  Plan plan = testing::empty_plan();
  auto& m = plan.model;
  const auto direction = [&](geometry::Vec3 v) {
    model::Direction d;
    d.direction_ratios = {{v.x, v.y, v.z}, true};
    return m.add(d);
  };
  model::CartesianPoint at;
  at.coordinates = {{0, 80, 0}, true};
  model::Axis2Placement3d lies;
  lies.location = m.add(at);
  lies.axis = direction({0, 0, -1});
  lies.ref_direction = direction({1, 0, 0});
  model::WorkpieceSetup piece;
  piece.its_origin = m.add(lies);
  model::Setup setup;
  setup.its_workpiece_setup.push_back(m.add(piece));
  plan.setups.push_back({.setup = m.add(setup), .work_offset = "G55", .security_z_mm = 30.0});
  testing::add_step(plan, "a", "em18", contour());
  testing::add_step(plan, "b", "em18", contour()).setup = 1;
  const std::string text = program_of(plan);
  for (const char* line :
       {"(set-up 2: the workpiece is turned over, 180 deg about its X axis after set-up 1)\n",
        "(set-up 2: the workpiece's -Z up, its +X to the right, its -Y to the back)\n",
        "(set-up 2: zero G55 on the raw piece as it lies: X0 at its left side, Y0 at its front, Z0 at its "
        "underside; that is the point X0 Y80 Z0 of the part's drawing)\n",
        "(set-up 2: the raw piece reaches from X0 Y0 Z0 to X100 Y80 Z20; a side that was cut before stands "
        "back "
        "by what was cut)\n",
        "(MSG, set-up 2: clamp the workpiece anew, turned over, 180 deg about its X axis, its -Z up; set "
        "G55: X0 "
        "at its left side, Y0 at its front, Z0 at its underside, then continue)\nM0\n"}) {
    EXPECT_NE(text.find(line), std::string::npos) << line << "\n" << text.substr(0, 4000);
  }
  for (std::size_t from = 0, end = 0; (end = text.find('\n', from)) != std::string::npos; from = end + 1)
    EXPECT_LE(end - from, 255U);
}

TEST(LinuxCnc, SaysWhatABoringToolIsSetToBeforeItIsChanged) {
  Plan plan = testing::empty_plan();
  plan.cutters[0].cutter_class = model::CutterClass::kBoringTool;
  plan.cutters[0].cutting_diameter_mm = 18.0105;
  testing::add_step(plan, "a", "em18", contour());
  const std::string text = program_of(plan);
  EXPECT_LT(position(text, "(T1: the boring tool is set to diameter 18.0105 mm)\n"),
            position(text, "T1 M6\n"));
}

TEST(LinuxCnc, SpeaksOfFeedOnlyWhenItChanges) {
  Plan plan = testing::empty_plan();
  auto& step = testing::add_step(plan, "a", "em18", contour());
  auto schedule = *step.schedule;
  schedule.feed_mm_min[5] = 450.04;  // rounds to 450
  schedule.feed_mm_min[6] = 449.96;
  step.schedule = std::make_shared<const model::FeedSchedule>(schedule);
  const std::string text = program_of(plan);
  EXPECT_THAT(text, HasSubstr("G1 Y40 F450\n"));
  std::size_t feeds = 0;
  for (std::size_t at = text.find(" F"); at != std::string::npos; at = text.find(" F", at + 1)) ++feeds;
  EXPECT_EQ(feeds, 3U);
}

TEST(LinuxCnc, TurnsTheSpindleOtherWayRoundOnlyThroughAStop) {
  Plan plan = testing::empty_plan();
  auto& step = testing::add_step(plan, "a", "em18", contour());
  auto schedule = *step.schedule;
  for (std::size_t i = 4; i < schedule.spindle_rpm.size(); ++i) schedule.spindle_rpm[i] = 2500.04;
  schedule.spindle_rpm.back() = -100.0;
  step.schedule = std::make_shared<const model::FeedSchedule>(schedule);
  const std::string text = program_of(plan);
  EXPECT_THAT(text, HasSubstr("S2500 M3\nG3 X60.1235"));
  EXPECT_THAT(text, HasSubstr("M5\nS100 M4\nG4 P1.5\nG0 Z5\n"));
}

TEST(LinuxCnc, DropsMovesThatRoundingLeavesWithoutLength) {
  Plan plan = testing::empty_plan();
  CutterPath p;
  p.start({0, 0, 5});
  p.line({0.00004, 0, 5}, MoveRole::kCut);
  p.line({0.00004, 0.00004, 5.00004}, MoveRole::kCut);
  p.rapid({0.00001, 0, 5});
  p.arc({0.00001, 0, 5}, {0.00002, 0}, true, MoveRole::kCut);  // a circle of 10 nm
  p.line({1, -0.00001, 5}, MoveRole::kCut);
  testing::add_step(plan, "a", "em18", p);
  const std::string text = program_of(plan);
  EXPECT_THAT(text, HasSubstr("G0 X0 Y0\nM8\nG0 Z5\nG1 X1 F600\n\n(end)"));
  EXPECT_THAT(text, Not(HasSubstr("-0\n")));
}

TEST(LinuxCnc, TapsInStepWithTheSpindle) {
  Plan plan = testing::empty_plan();
  CutterPath p;
  p.start({10, 10, 5});
  p.line({10, 10, -12}, MoveRole::kTap);
  p.dwell();
  p.line({10, 10, 5}, MoveRole::kTap);
  p.rapid({20, 10, 5});
  auto& step = testing::add_step(plan, "tap", "tap_m6", p, 500.0, 500.0);
  auto schedule = *step.schedule;
  schedule.spindle_rpm[3] = -500.0;
  step.schedule = std::make_shared<const model::FeedSchedule>(schedule);
  EXPECT_THAT(program_of(plan), HasSubstr("G0 Z5\nG33.1 Z-12 K1\nG0 X20\n"));
  CAPSTAN_NEEDS_RS274();
  const Rs274Run r = run(plan);
  EXPECT_EQ(r.status, 0) << r.output;
  ASSERT_EQ(r.only({"RIGID_TAP"}).size(), 1U);
  EXPECT_EQ(r.only({"RIGID_TAP"})[0].numbers, (std::vector<double>{10, 10, -12}));
  EXPECT_EQ(r.only({"START_SPEED_FEED_SYNC"})[0].numbers[0], 1.0);
}

TEST(LinuxCnc, WritesHolesAsCyclesOnlyWhereTheMachineAsksForThem) {
  Plan plan = plans::holes_plan("linuxcnc");
  EXPECT_THAT(program_of(plan), AllOf(Not(HasSubstr("G81")), HasSubstr("G0 Z2\nG1 Z-18.2 F180\nG0 Z10\n")));
  plans::choose(plan, "cycles", "feature");
  const std::string text = program_of(plan);
  EXPECT_THAT(text, HasSubstr("\nG98 G81 X20 Y20 Z-18.2 R2 F180\nG80\n"));
  EXPECT_THAT(text, HasSubstr("\nG98 G82 X40 Y20 Z-18.2 R2 P0.35 F180\nG80\n"));
  EXPECT_THAT(text, HasSubstr("\nG98 G85 X20 Y20 Z-18.2 R2 F180\nG80\n"));
  EXPECT_THAT(text, HasSubstr("\nG33.1 Z-12 K1\n"));
}

TEST(LinuxCncInterpreter, MakesOfCyclesTheMovesOfThePath) {
  CAPSTAN_NEEDS_RS274();
  // Moves, each with the feed that holds, and dwells; moves to where the tool already is are left out.
  const auto moves = [](const Plan& plan) {
    const Rs274Run r = run(plan);
    EXPECT_EQ(r.status, 0) << r.output;
    std::vector<std::string> out;
    std::string at, feed;
    for (const auto& c :
         r.only({"STRAIGHT_TRAVERSE", "STRAIGHT_FEED", "DWELL", "RIGID_TAP", "SET_FEED_RATE"})) {
      if (c.name == "SET_FEED_RATE") {
        feed = " F" + c.text;
        continue;
      }
      if (c.name.starts_with("STRAIGHT") && std::exchange(at, c.text) == c.text) continue;
      out.push_back(c.name + "(" + c.text + ")" + (c.name == "STRAIGHT_FEED" ? feed : ""));
    }
    return out;
  };
  Plan plan = plans::holes_plan("linuxcnc");
  const auto by_moves = moves(plan);
  plans::choose(plan, "cycles", "feature");
  auto by_cycles = moves(plan);
  // The reamer comes out at feed to R, and from there by rapid; along the path at feed all the way.
  const auto differs = std::mismatch(by_moves.begin(), by_moves.end(), by_cycles.begin(), by_cycles.end());
  ASSERT_NE(differs.first, by_moves.end());
  ASSERT_NE(differs.second, by_cycles.end());
  EXPECT_THAT(*differs.first, StartsWith("STRAIGHT_FEED(20.0000, 20.0000, 10.0000"));
  EXPECT_THAT(*differs.second, StartsWith("STRAIGHT_FEED(20.0000, 20.0000, 2.0000"));
  by_cycles.erase(differs.second);
  const std::size_t rapid = static_cast<std::size_t>(differs.first - by_moves.begin());
  EXPECT_THAT(by_cycles[rapid], StartsWith("STRAIGHT_TRAVERSE(20.0000, 20.0000, 10.0000"));
  by_cycles[rapid] = by_moves[rapid];
  EXPECT_EQ(by_cycles, by_moves);
}

TEST(LinuxCnc, PecksAreACycleWhereTheyAreEqualFromROnAndABarWithTheSpindleStoppedIsG86) {
  const auto by_cycles = [](Plan plan) {
    plans::choose(plan, "cycles", "feature");
    return program_of(plan);
  };
  EXPECT_THAT(by_cycles(plans::pecked_plan("linuxcnc", {-4, -14, -22.4}, true)),
              HasSubstr("\nG98 G83 Q10 X20 Y20 Z-22.4 R6 F180\nG80\n"));
  EXPECT_THAT(by_cycles(plans::pecked_plan("linuxcnc", {-8, -18, -22.4}, true)), Not(HasSubstr("G83")));
  // G73 comes up by 0.254 mm; the plan by 0.5.
  EXPECT_THAT(by_cycles(plans::pecked_plan("linuxcnc", {-6, -14, -22}, false)), Not(HasSubstr("G73")));
  EXPECT_THAT(by_cycles(plans::bored_plan("linuxcnc")),
              HasSubstr("\nG98 G86 X20 Y20 Z-18.2 R2 P0 F180\nG80\nM5\n"));
}

TEST(LinuxCncInterpreter, PecksFromRAndComesBackTo0254AboveTheLastBottom) {
  CAPSTAN_NEEDS_RS274();
  Plan plan = plans::pecked_plan("linuxcnc", {-4, -14, -22.4}, true);
  plans::choose(plan, "cycles", "feature");
  const Rs274Run r = run(plan);
  EXPECT_EQ(r.status, 0) << r.output;
  std::vector<double> heights;
  for (const auto& c : r.only({"STRAIGHT_TRAVERSE", "STRAIGHT_FEED"})) {
    const double way = c.name == "STRAIGHT_FEED" ? 1000.0 : 0.0;  // of a feed
    if (c.numbers[0] == 20.0 && c.numbers[1] == 20.0) heights.push_back(c.numbers[2] + way);
  }
  const std::vector<double> cycle{6, 996, 6, -3.746, 986, 6, -13.746, 977.6, 10};
  EXPECT_NE(std::search(heights.begin(), heights.end(), cycle.begin(), cycle.end(),
                        [](double a, double b) { return std::abs(a - b) < kCanonUnit; }),
            heights.end())
      << r.output;
}

TEST(LinuxCncInterpreter, G86StopsTheSpindleAtTheBottomAndStartsItAgainAbove) {
  CAPSTAN_NEEDS_RS274();
  Plan plan = plans::bored_plan("linuxcnc");
  plans::choose(plan, "cycles", "feature");
  const Rs274Run r = run(plan);
  EXPECT_EQ(r.status, 0) << r.output;
  std::vector<std::string> names;
  for (const auto& c : r.calls) names.push_back(c.name);
  const std::vector<std::string> cycle{"STRAIGHT_FEED", "DWELL", "STOP_SPINDLE_TURNING", "STRAIGHT_TRAVERSE",
                                       "START_SPINDLE_CLOCKWISE"};
  EXPECT_NE(std::search(names.begin(), names.end(), cycle.begin(), cycle.end()), names.end()) << r.output;
}

TEST(LinuxCnc, RefusesATapWhoseFeedIsNotItsPitch) {
  Plan plan = testing::empty_plan();
  CutterPath p;
  p.start({10, 10, 5});
  p.line({10, 10, -12}, MoveRole::kTap);
  p.line({10, 10, 5}, MoveRole::kTap);
  testing::add_step(plan, "tap", "tap_m6", p, 500.0, 600.0);
  EXPECT_EQ(failure_of(plan), "OUT-TAP");
  plan.steps.clear();
  p.line({10, 10, -12}, MoveRole::kTap);  // and never back
  testing::add_step(plan, "tap", "tap_m6", p, 500.0, 500.0);
  EXPECT_EQ(failure_of(plan), "OUT-TAP");
}

TEST(LinuxCnc, AFeedThatNoProgramCanSayIsToldWithItsNumberAndTheLimits) {
  Plan plan = testing::empty_plan();
  testing::add_step(plan, "a", "em18", contour());
  model::FeedSchedule f = *plan.steps[0].schedule;
  f.feed_mm_min[3] = 1e9;
  plan.steps[0].schedule = std::make_shared<const model::FeedSchedule>(f);
  Job job;
  const auto out = kDialect.write_program(plan, job, {});
  ASSERT_FALSE(out);
  EXPECT_NE(out.error().message.find("a feed of 1000000000 mm/min"), std::string::npos)
      << out.error().message;
  EXPECT_NE(out.error().message.find("0.1 to 1000000"), std::string::npos) << out.error().message;
}

TEST(LinuxCnc, WritesNothingForAPlanThatCannotBeRun) {
  const auto broken = [](auto&& change) {
    Plan plan = testing::empty_plan();
    testing::add_step(plan, "a", "em18", contour());
    change(plan);
    return failure_of(plan);
  };
  const auto with_path = [](Plan& plan, auto&& change) {
    CutterPath p = *plan.steps[0].path;
    change(p);
    plan.steps[0].path = std::make_shared<const CutterPath>(p);
  };
  const auto with_schedule = [](Plan& plan, auto&& change) {
    model::FeedSchedule f = *plan.steps[0].schedule;
    change(f);
    plan.steps[0].schedule = std::make_shared<const model::FeedSchedule>(f);
  };
  EXPECT_EQ(broken([](Plan&) {}), "");
  EXPECT_EQ(broken([](Plan& p) { p.steps.clear(); }), "OUT-EMPTY");
  EXPECT_EQ(broken([](Plan& p) { p.steps[0].path = nullptr; }), "OUT-OPEN");
  EXPECT_EQ(broken([](Plan& p) { p.steps[0].cutter_id = "none"; }), "OUT-TOOL");
  EXPECT_EQ(broken([](Plan& p) { p.cutters[0].pocket = 0; }), "OUT-TOOL");
  EXPECT_EQ(broken([](Plan& p) { p.cutters[0].pocket = 2; }), "OUT-TOOL");
  EXPECT_EQ(broken([](Plan& p) { p.steps[0].setup = 7; }), "OUT-SETUP");
  EXPECT_EQ(broken([](Plan& p) { p.setups[0].work_offset = "G92"; }), "OUT-SETUP");
  EXPECT_EQ(broken([](Plan& p) { p.setups[0].security_z_mm = std::nan(""); }), "OUT-NUMBER");
  EXPECT_EQ(broken([&](Plan& p) { with_path(p, [](CutterPath& c) { c.z[3] = std::nan(""); }); }),
            "OUT-NUMBER");
  EXPECT_EQ(broken([&](Plan& p) { with_path(p, [](CutterPath& c) { c.x[3] = 1e300; }); }), "OUT-NUMBER");
  EXPECT_EQ(broken([&](Plan& p) { with_path(p, [](CutterPath& c) { c.cx[4] += 0.1; }); }), "OUT-ARC");
  EXPECT_EQ(broken([&](Plan& p) { with_schedule(p, [](auto& f) { f.feed_mm_min[3] = 0.04; }); }), "OUT-FEED");
  EXPECT_EQ(broken([&](Plan& p) { with_schedule(p, [](auto& f) { f.feed_mm_min[3] = 1e9; }); }), "OUT-FEED");
  EXPECT_EQ(broken([&](Plan& p) { with_schedule(p, [](auto& f) { f.feed_mm_min.pop_back(); }); }),
            "OUT-SCHEDULE");
  EXPECT_EQ(broken([&](Plan& p) { with_schedule(p, [](auto& f) { f.spindle_rpm[2] = INFINITY; }); }),
            "OUT-NUMBER");
}

TEST(LinuxCnc, WarnsOfAToolWithoutAKnownLength) {
  Plan plan = testing::empty_plan();
  testing::add_step(plan, "a", "em18", contour());
  plan.cutters[0].functional_length_mm = 0.0;
  Job job;
  ASSERT_TRUE(kDialect.write_program(plan, job, {}));
  ASSERT_EQ(job.diagnostics().size(), 1U);
  EXPECT_EQ(job.diagnostics()[0].code, "OUT-TOOL-LENGTH");
}

TEST(LinuxCnc, GivesTheSameBytesForTheSamePlan) {
  Plan plan = testing::empty_plan();
  testing::add_step(plan, "a", "em18", contour());
  EXPECT_EQ(program_of(plan), program_of(Plan(plan)));
}

TEST(LinuxCnc, GivesEachStepItsOwnPathTolerance) {
  Plan plan = testing::empty_plan();
  testing::add_step(plan, "rough", "em18", contour());
  testing::add_step(plan, "finish", "em18", contour());
  plan.steps[0].contour_tolerance_mm = 0.05;
  plan.steps[1].contour_tolerance_mm = 0.0021;
  const std::string text = program_of(plan);
  const auto rough = text.find("G64 P0.05"), finish = text.find("G64 P0.0021");
  ASSERT_NE(rough, std::string::npos);
  ASSERT_NE(finish, std::string::npos);
  EXPECT_LT(rough, finish);
}

TEST(LinuxCnc, SurvivesNamesThatWouldEndAComment) {
  Plan plan = testing::empty_plan();
  testing::add_step(plan, "evil) G0 Z-100 (\"\n%;" + std::string(400, 'x'), "em18", contour());
  testing::add_step(plan, "bohrung \xC3\xBC (1)\nM3", "em18", contour());
  plan.file_name = "a)\nG0 Z-50\n(" + std::string(1000, 'y');
  const std::string text = program_of(plan);
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    EXPECT_LT(line.size(), 250U);
    EXPECT_EQ(line.find("Z-100"), std::string::npos);
    EXPECT_NE(line, "G0 Z-50");
  }
  CAPSTAN_NEEDS_RS274();
  EXPECT_EQ(run(plan).status, 0);
}

TEST(ToolTable, HoldsLengthAndDiameterInMillimetres) {
  EXPECT_EQ(write_tool_table(testing::empty_plan()),
            "T1 P1 Z+50.000000 D+18.000000 ;end mill, 18 mm ?\nT2 P2 Z+80.000000 D+6.000000 ;tap_m6\n");
}

}  // namespace
}  // namespace capstan::controls::linuxcnc

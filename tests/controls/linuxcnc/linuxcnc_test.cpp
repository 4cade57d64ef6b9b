#include "planner/controls/linuxcnc/linuxcnc.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>
#include <sstream>

#include "planner/ground/base/number.h"
#include "tests/support/empty_plan.h"
#include "tests/support/rs274.h"

namespace capstan::controls::linuxcnc {
namespace {

using model::CutterPath;
using model::MoveKind;
using model::MoveRole;
using model::Plan;
using std::numbers::pi;
using testing::CanonCall;
using ::testing::HasSubstr;
using ::testing::Not;
using testing::Rs274Run;

constexpr double kCanonUnit = 1e-4;  // the interpreter prints four decimals

std::string program_of(const Plan& plan) {
  Job job;
  const auto text = kDialect.write_program(plan, job, {});
  EXPECT_TRUE(text) << (text ? "" : to_text(text.error()));
  return text.value_or("");
}

std::string failure_of(const Plan& plan) {
  Job job;
  const auto text = kDialect.write_program(plan, job, {});
  return text ? "" : text.error().code;
}

Rs274Run run(const Plan& plan) { return testing::run_rs274(write_tool_table(plan), program_of(plan)); }

/// A square with a rounded corner, a helix, a full circle, a diagonal rapid: 3 mm deep.
CutterPath contour() {
  CutterPath p;
  p.start({-12, -12, 5});
  p.rapid({-12, -12, 1});
  p.line({-12, -12, -3}, MoveRole::kPlunge);
  p.line({50.123456, -12, -3}, MoveRole::kCut);
  p.arc({60.123456, -2, -3}, {50.123456, -2}, false, MoveRole::kCut);
  p.line({60.123456, 40, -3}, MoveRole::kCut);
  p.arc({60.123456, 40, -5}, {50.123456, 40}, true, MoveRole::kRamp);
  p.arc({60.123456, 40, -5}, {50.123456, 40}, false, MoveRole::kCut);
  p.line({-12, 40, -5}, MoveRole::kCut);
  p.rapid({-12, 40, 5}, MoveRole::kRetract);
  return p;
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

// What the plan asks for, as the interpreter should name it: at most half a turn per arc.
struct Expected {
  bool rapid, arc;
  double x, y, z, cx, cy;
};
std::vector<Expected> expected_moves(const CutterPath& p) {
  std::vector<Expected> out;
  for (std::size_t i = 1; i < p.size(); ++i) {
    const bool arc = p.kind[i] == MoveKind::kArcCw || p.kind[i] == MoveKind::kArcCcw;
    const int n = arc && model::arc_sweep(p, i) > pi + 1e-6 ? 2 : 1;
    for (int k = 1; k <= n; ++k) {
      const auto to = model::point_on_move(p, i, double(k) / n);
      out.push_back({p.kind[i] == MoveKind::kRapid, arc, to.x, to.y, to.z, p.cx[i], p.cy[i]});
    }
  }
  return out;
}

void expect_same_motion(const std::vector<CanonCall>& got, std::size_t skip,
                        const std::vector<Expected>& want) {
  ASSERT_EQ(got.size(), want.size() + skip);
  for (std::size_t i = 0; i < want.size(); ++i) {
    const CanonCall& c = got[i + skip];
    const Expected& w = want[i];
    SCOPED_TRACE(std::to_string(i) + ": " + c.name + "(" + c.text + ")");
    ASSERT_EQ(c.name, w.arc ? "ARC_FEED" : w.rapid ? "STRAIGHT_TRAVERSE" : "STRAIGHT_FEED");
    EXPECT_NEAR(c.numbers[0], w.x, 1.01 * kCanonUnit);
    EXPECT_NEAR(c.numbers[1], w.y, 1.01 * kCanonUnit);
    EXPECT_NEAR(c.numbers[w.arc ? 5 : 2], w.z, 1.01 * kCanonUnit);
    if (!w.arc) continue;
    EXPECT_NEAR(c.numbers[2], w.cx, 3.0 * kCanonUnit);
    EXPECT_NEAR(c.numbers[3], w.cy, 3.0 * kCanonUnit);
  }
}

const std::vector<std::string> kMotion = {"STRAIGHT_TRAVERSE", "STRAIGHT_FEED", "ARC_FEED"};

TEST(LinuxCncInterpreter, MovesAsThePlanSays) {
  CAPSTAN_NEEDS_RS274();
  Plan plan = testing::empty_plan();
  testing::add_step(plan, "a", "em18", contour());
  const Rs274Run r = run(plan);
  EXPECT_EQ(r.status, 0) << r.output;
  auto motion = r.only(kMotion);
  motion.pop_back();                                         // the retract at the end
  expect_same_motion(motion, 3, expected_moves(contour()));  // retract, X Y, Z
  const auto spindle =
      r.only({"CHANGE_TOOL", "SET_SPINDLE_SPEED", "START_SPINDLE_CLOCKWISE", "FLOOD_ON", "STRAIGHT_FEED"});
  ASSERT_GE(spindle.size(), 5U);
  EXPECT_EQ(spindle[0].name, "CHANGE_TOOL");
  EXPECT_EQ(spindle[1].numbers[1], 3000.0);
  EXPECT_EQ(spindle[2].name, "START_SPINDLE_CLOCKWISE");
  EXPECT_EQ(spindle[3].name, "FLOOD_ON");
}

TEST(LinuxCncInterpreter, AgreesOnRandomPathsWhateverTheDecimals) {
  CAPSTAN_NEEDS_RS274();
  std::mt19937 random(14649);
  std::uniform_real_distribution<double> at(-80.0, 80.0), angle(0.02, 2.0 * pi), size(0.5, 60.0);
  Plan plan = testing::empty_plan();
  CutterPath p;
  p.start({at(random), at(random), 10.0});
  for (int i = 0; i < 400; ++i) {
    const auto here = p.point(p.size() - 1);
    if (random() % 3 == 0) {
      p.line({at(random), at(random), -0.1 * at(random)}, MoveRole::kCut);
      continue;
    }
    const double from = angle(random);
    const double radius = size(random);
    const bool clockwise = random() % 2 == 0;
    const double to = from + (clockwise ? -1.0 : 1.0) * (random() % 5 == 0 ? 2.0 * pi : angle(random));
    const geometry::Vec2 c{here.x - radius * std::cos(from), here.y - radius * std::sin(from)};
    const double z = here.z + (random() % 2 == 0 ? 0.0 : 0.01 * at(random));
    p.arc({c.x + radius * std::cos(to), c.y + radius * std::sin(to), z}, c, clockwise, MoveRole::kCut);
  }
  testing::add_step(plan, "a", "em18", p);
  for (const int decimals : {4, 6}) {
    plan.machine.control.decimals = decimals;
    const Rs274Run r = run(plan);
    EXPECT_EQ(r.status, 0) << r.output;
    auto motion = r.only(kMotion);
    motion.pop_back();
    ASSERT_EQ(motion.size(), expected_moves(p).size() + 3);
    const auto want = expected_moves(p);
    for (std::size_t i = 0; i < want.size(); ++i) {
      const bool arc = motion[i + 3].name == "ARC_FEED";
      EXPECT_NEAR(motion[i + 3].numbers[0], want[i].x, 1.01 * kCanonUnit);
      EXPECT_NEAR(motion[i + 3].numbers[1], want[i].y, 1.01 * kCanonUnit);
      EXPECT_NEAR(motion[i + 3].numbers[arc ? 5 : 2], want[i].z, 1.01 * kCanonUnit);
    }
  }
}

// The written arcs, read back by a reader of its own: radii agree, direction and sweep are the plan's.
TEST(LinuxCncProperty, ArcsAgreeWithThePlanAfterRounding) {
  std::mt19937 random(238);
  std::uniform_real_distribution<double> at(-80.0, 80.0), angle(0.001, 2.0 * pi), exponent(-3.0, 3.0);
  for (const int decimals : {3, 4}) {
    const double unit = std::pow(10.0, -decimals);
    for (int round = 0; round < 2000; ++round) {
      const double radius = std::pow(10.0, exponent(random));
      const double from = angle(random), swept = round % 7 == 0 ? 2.0 * pi : angle(random);
      const bool clockwise = random() % 2 == 0;
      const geometry::Vec2 c{at(random), at(random)};
      const double to = clockwise ? from - swept : from + swept;
      CutterPath p;
      p.start({c.x + radius * std::cos(from), c.y + radius * std::sin(from), 0});
      p.arc({c.x + radius * std::cos(to), c.y + radius * std::sin(to), 0}, c, clockwise, MoveRole::kCut);
      Plan plan = testing::empty_plan();
      plan.machine.control.decimals = decimals;
      testing::add_step(plan, "a", "em18", p);
      std::istringstream text(program_of(plan));
      geometry::Vec2 here{rounded(p.x[0], decimals), rounded(p.y[0], decimals)};
      double total = 0.0;
      bool lines = false;
      for (std::string line; std::getline(text, line);) {
        std::istringstream words(line);
        std::string g;
        words >> g;
        if (g == "G1") lines = true;
        if (g != "G2" && g != "G3") continue;
        EXPECT_EQ(g, clockwise ? "G2" : "G3");
        geometry::Vec2 next = here, i;
        for (std::string w; words >> w;) {
          const double v = *parse_double(w.substr(1));
          if (w[0] == 'X') next.x = v;
          if (w[0] == 'Y') next.y = v;
          if (w[0] == 'I') i.x = v;
          if (w[0] == 'J') i.y = v;
        }
        EXPECT_NEAR(norm(i), norm(here + i - next), unit);
        EXPECT_NEAR(norm(i), radius, 3.0 * unit + 1e-3 * radius);
        CutterPath piece;
        piece.start({here.x, here.y, 0});
        piece.arc({next.x, next.y, 0}, here + i, clockwise, MoveRole::kCut);
        const double sweep = model::arc_sweep(piece, 1);
        EXPECT_LT(sweep, 1.1 * pi);  // never an accidental full turn
        total += sweep;
        // Half way round, the written arc is where the plan's is.
        const auto middle = model::point_on_move(piece, 1, 0.5);
        EXPECT_NEAR(std::hypot(middle.x - c.x, middle.y - c.y), radius, 3.0 * unit);
        here = next;
      }
      if (!lines && total > 0.0) {
        EXPECT_NEAR(total * radius, swept * radius, 8.0 * unit);
      }
    }
  }
}

}  // namespace
}  // namespace capstan::controls::linuxcnc

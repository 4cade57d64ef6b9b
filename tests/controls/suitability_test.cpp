#include "planner/controls/suitability.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <memory>
#include <string>
#include <vector>

#include "planner/controls/controls.h"
#include "tests/support/empty_plan.h"

namespace capstan::controls {
namespace {

using namespace ::testing;
using model::CutterPath;
using model::MoveRole;

constexpr double kFeed = 6000.0;      // mm/min: 100 mm/s
constexpr double kBlockS = 0.001;     // 0.1 mm at that feed
constexpr double kAccelerate = 1000;  // mm/s^2: 5 mm to stop from it

/// A plan with one step of that path at kFeed, on a machine of those figures.
model::Plan with(const CutterPath& path) {
  model::Plan plan = testing::empty_plan();
  for (auto& axis : plan.machine.axes) axis.acceleration_mm_s2 = kAccelerate;
  plan.machine.control.block_time_s = kBlockS;
  model::StepResult step;
  step.cutter_id = "em18";
  step.feed_mm_min = kFeed;
  step.path = std::make_shared<CutterPath>(path);
  plan.steps.push_back(step);
  return plan;
}

/// A straight path of that many equal moves.
CutterPath straight(int moves, double length_mm) {
  CutterPath p;
  p.start({0, 0, 0});
  for (int i = 1; i <= moves; ++i) p.line({i * length_mm, 0, 0}, MoveRole::kCut);
  return p;
}

CutterPath with_arc(double down_mm) {
  CutterPath p;
  p.start({10, 0, 0});
  p.arc({-10, 0, -down_mm}, {0, 0}, true, MoveRole::kCut);
  return p;
}

std::vector<std::string> codes(const model::Plan& plan, const Conformance& control) {
  std::vector<std::string> out;
  for (const auto& f : suitability(plan, control)) out.push_back(f.code);
  return out;
}

TEST(Suitability, APlanThatTheControlIsMadeForHasNoFinding) {
  EXPECT_THAT(codes(with(with_arc(3.0)), {}), IsEmpty());
  EXPECT_THAT(suitability(with(straight(100, 1.0))), IsEmpty());
}

TEST(Suitability, NamesWhatTheControlCannotDoAsErrors) {
  EXPECT_THAT(codes(with(with_arc(0.0)), {.arcs = false}), ElementsAre("FIT-ARC"));
  EXPECT_THAT(codes(with(with_arc(0.0)), {.helices = false}), IsEmpty());
  EXPECT_THAT(codes(with(with_arc(3.0)), {.helices = false}), ElementsAre("FIT-HELIX"));
  EXPECT_EQ(suitability(with(with_arc(3.0)), {.helices = false})[0].severity, Severity::kError);
  CutterPath tap;
  tap.start({0, 0, 5});
  tap.line({0, 0, -10}, MoveRole::kTap);
  EXPECT_THAT(codes(with(tap), {.rigid_tapping = false}), ElementsAre("FIT-TAP"));
  EXPECT_THAT(codes(with(tap), {}), IsEmpty());
  // T2 is the greater of the plan's tools.
  EXPECT_THAT(codes(with(straight(2, 1.0)), {.largest_tool_number = 1}), ElementsAre("FIT-TOOL-NUMBER"));
  EXPECT_THAT(codes(with(straight(2, 1.0)), {.largest_tool_number = 2}), IsEmpty());
}

TEST(Suitability, AToleranceThatTheProgramCannotSayIsAWarning) {
  model::Plan plan = with(straight(2, 1.0));
  plan.steps[0].contour_tolerance_mm = 0.05;
  EXPECT_THAT(codes(plan, {}), IsEmpty());
  const auto found = suitability(plan, {.path_tolerance = false});
  ASSERT_EQ(found.size(), 2u);  // the assumed figure of the plan, then the step's
  EXPECT_EQ(found[1].code, "FIT-TOLERANCE");
  EXPECT_EQ(found[1].severity, Severity::kWarning);
  EXPECT_THAT(found[1].message, HasSubstr("the step may be rounded by 0.05 mm"));
  plan.machine.control.decimals = 1;  // 0.1 mm
  EXPECT_THAT(codes(plan, {}), ElementsAre("FIT-TOLERANCE"));
}

TEST(Suitability, AToleranceThatOnlyTheControlsParameterSetsIsSaidOnceToBeAssumed) {
  model::Plan plan = with(straight(2, 1.0));
  plan.steps.push_back(plan.steps.front());
  plan.machine.control.path_tolerance_mm = 0.02;
  plan.machine = with_control(plan.machine, "haas");  // its programs state it: G187 E
  EXPECT_THAT(suitability(plan), IsEmpty());
  plan.machine = with_control(plan.machine, "fanuc");
  const auto found = suitability(plan);
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].code, "FIT-TOLERANCE");
  EXPECT_EQ(found[0].severity, Severity::kWarning);
  EXPECT_EQ(found[0].step, "");
  EXPECT_THAT(found[0].message, HasSubstr("0.02 mm of the machine's file is assumed"));
  plan.machine.control_options = model::ControlOptions{{{"path_tolerance", "set"}}};
  EXPECT_THAT(suitability(plan), IsEmpty());
  plan.machine.control_options.reset();
  plan.machine.control.path_tolerance_mm = 0.0;  // exact stop (G61): nothing is rounded
  EXPECT_THAT(suitability(plan), IsEmpty());
}

TEST(Suitability, MovesShorterThanABlockTakesAreNotedAtTheWorst) {
  EXPECT_THAT(codes(with(straight(3, 0.1)), {}), IsEmpty());
  CutterPath p = straight(3, 0.08);
  p.line({0.28, 0, 0}, MoveRole::kCut);  // 0.04 mm long, move 4
  const auto found = suitability(with(p), {});
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].code, "FIT-BLOCK-TIME");
  EXPECT_EQ(found[0].severity, Severity::kNote);
  EXPECT_EQ(found[0].move, 4);
  // 0.1 mm in a block time over 0.04 mm.
  EXPECT_THAT(found[0].message, HasSubstr("2.5 times shorter"));
  EXPECT_THAT(found[0].message, HasSubstr("3 more such moves"));
}

TEST(Suitability, AFeedFromWhichItCannotStopInSightIsNoted) {
  // 5 mm to stop: 50 moves of 0.2 mm are 10 mm, 20 of them are 4 mm.
  const model::Plan plan = with(straight(200, 0.2));
  EXPECT_THAT(codes(plan, {.look_ahead_moves = 50}), IsEmpty());
  EXPECT_THAT(codes(plan, {}), IsEmpty());
  const auto found = suitability(plan, {.look_ahead_moves = 20});
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].code, "FIT-LOOK-AHEAD");
  EXPECT_THAT(found[0].message, HasSubstr("1.25 times as long"));
  // The last 20 moves end in a stop that it sees: moves 1 to 180 are slower.
  EXPECT_THAT(found[0].message, HasSubstr("179 more such moves"));
}

TEST(Suitability, NamesAxesRadiiAndFeedsThatTheControlDoesNotHave) {
  CutterPath slope;
  slope.start({0, 0, 0});
  slope.line({3, 4, -1}, MoveRole::kCut);
  EXPECT_THAT(codes(with(slope), {}), IsEmpty());
  EXPECT_THAT(codes(with(slope), {.axes = 2}), ElementsAre("FIT-AXES"));
  EXPECT_THAT(codes(with(straight(2, 5.0)), {.axes = 2}), IsEmpty());
  // The arc's radius is 10 mm, the feed 6000 mm/min.
  EXPECT_THAT(codes(with(with_arc(0.0)), {.largest_radius_mm = 10.0}), IsEmpty());
  EXPECT_THAT(codes(with(with_arc(0.0)), {.largest_radius_mm = 9.9}), ElementsAre("FIT-RADIUS"));
  EXPECT_THAT(codes(with(with_arc(0.0)), {.largest_feed_mm_min = kFeed}), IsEmpty());
  const auto fast = suitability(with(straight(3, 5.0)), {.largest_feed_mm_min = 5999.0});
  ASSERT_EQ(fast.size(), 1u);
  EXPECT_EQ(fast[0].code, "FIT-FEED");
  EXPECT_EQ(fast[0].severity, Severity::kError);
  EXPECT_THAT(fast[0].message, HasSubstr("2 more such moves"));
}

TEST(Suitability, NamesOffsetsAndToolChangesOfThePlanThatItDoesNotHave) {
  model::Plan plan = with(straight(3, 5.0));
  plan.setups = {{.setup = {}, .work_offset = "G54"}, {.setup = {}, .work_offset = "G55"}};
  plan.steps.push_back(plan.steps.front());
  EXPECT_THAT(codes(plan, {.work_offsets = 2, .tool_changes = false}), IsEmpty());
  plan.steps.back().cutter_id = "another";
  EXPECT_THAT(codes(plan, {.work_offsets = 1, .tool_changes = false}),
              UnorderedElementsAre("FIT-OFFSETS", "FIT-TOOL-CHANGE"));
}

TEST(Suitability, AProgramThatDoesNotStopForToolsChangedByHandIsAnError) {
  model::Plan plan = with(straight(3, 5.0));
  plan.steps.push_back(plan.steps.front());
  plan.steps.back().cutter_id = "another";
  plan.machine.magazine_pockets = 1;
  EXPECT_THAT(codes(plan, {}), IsEmpty()) << "LinuxCNC's M6 waits";
  for (const char* dialect : {"fanuc", "haas", "siemens", "heidenhain"}) {
    plan.machine.control.dialect = dialect;
    plan.machine.control_options = {};
    EXPECT_THAT(codes(plan, {}), Contains("FIT-TOOL-CHANGE")) << dialect;
    plan.machine.control_options = model::ControlOptions{{{"prove_out", "m0"}}};
    EXPECT_THAT(codes(plan, {}), Not(Contains("FIT-TOOL-CHANGE"))) << dialect;
    plan.machine.magazine_pockets = 8;
    plan.machine.control_options = {};
    EXPECT_THAT(codes(plan, {}), Not(Contains("FIT-TOOL-CHANGE"))) << dialect;
    plan.machine.magazine_pockets = 1;
  }
}

TEST(Suitability, TheProfilesBlockTimeGoesBeforeTheMachines) {
  // 0.1 mm in a block time of the machine, 1 mm in one of the profile.
  const model::Plan plan = with(straight(5, 0.5));
  EXPECT_THAT(codes(plan, {}), IsEmpty());
  EXPECT_THAT(codes(plan, {.block_time_s = 0.01}), ElementsAre("FIT-BLOCK-TIME"));
}

TEST(Suitability, EachControlStatesHowFarItLooksAhead) {
  for (const Dialect* d : dialects()) EXPECT_GT(d->conformance.look_ahead_moves, 0u) << d->id;
}

}  // namespace
}  // namespace capstan::controls

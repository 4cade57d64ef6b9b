#include <gtest/gtest.h>

#include <cmath>
#include <memory>

#include "planner/model/nouns/all.h"
#include "planner/physics/motion/time.h"

// How long a whole plan takes (plan_time.cpp).

namespace capstan::motion {
namespace {

using model::CutterPath;
using model::MoveRole;

// 500 mm/s2 everywhere; rapids 12 m/min (200 mm/s), feeds to 6 m/min; no path tolerance.
constexpr double kA = 500.0;
constexpr double kRapid = 200.0;

/// 100 mm at 50 mm/s with each of these cutters, all at 5000 1/min, from x = 0 at z = 10; the security plane
/// is at z = 20. The spindle takes 2 s to its 10,000 1/min.
model::Plan plan_with(const std::vector<const char*>& cutters) {
  model::Plan plan;
  for (auto& axis : plan.machine.axes) {
    axis.rapid_mm_min = 60.0 * kRapid;
    axis.feed_max_mm_min = 6000.0;
    axis.acceleration_mm_s2 = kA;
  }
  plan.machine.control.path_tolerance_mm = 0.0;
  plan.machine.spindle.rpm_max = 10000.0;
  plan.machine.spindle.spin_up_s = 2.0;
  plan.machine.tool_change_s = 6.0;
  plan.setups.push_back({.setup = {}, .work_offset = "G54", .security_z_mm = 20.0});
  auto path = std::make_shared<CutterPath>();
  path->start({0, 0, 10});
  path->line({100, 0, 10}, MoveRole::kCut);
  for (const char* cutter : cutters) {
    model::StepResult step;
    step.cutter_id = cutter;
    step.path = path;
    step.spindle_rpm = 5000.0;
    step.feed_mm_min = 3000.0;
    plan.steps.push_back(step);
  }
  return plan;
}

/// From rest to rest at rapid.
double rapid_s(double mm) {
  const bool reached = mm >= kRapid * kRapid / kA;
  return reached ? 2.0 * kRapid / kA + (mm - kRapid * kRapid / kA) / kRapid : 2.0 * std::sqrt(mm / kA);
}

TEST(PlanTime, CountsToolChangesSpinUpsAndTheWayBetweenSteps) {
  const auto t = time_of(plan_with({"a", "a", "b"}));
  ASSERT_TRUE(t) << to_text(t.error());
  EXPECT_EQ(t->tool_changes, 2);
  EXPECT_EQ(t->tool_change_s, 12.0);
  EXPECT_NEAR(t->spin_up_s, 4.0, 1e-12);  // two starts and two stops of 1 s each: 5000 of 10000, 2 s
  EXPECT_NEAR(t->cutting_s, 3.0 * 2.1, 1e-9);
  // 10 mm up, 100 mm back, 10 mm down, stopping at each corner (no tolerance).
  EXPECT_NEAR(t->link_s, 2.0 * rapid_s(10.0) + rapid_s(100.0), 1e-9);
  EXPECT_NEAR(t->total_s(), 12.0 + 4.0 + 6.3 + t->link_s, 1e-9);
}

TEST(PlanTime, IsSharedAmongTheStepsWithoutRest) {
  auto plan = plan_with({"a", "a", "b"});
  plan.steps.push_back({});  // without a path it takes none
  const auto t = time_of(plan);
  ASSERT_TRUE(t) << to_text(t.error());
  ASSERT_EQ(t->steps.size(), 4U);
  double all = 0.0;
  for (const StepShare& share : t->steps) all += share.total_s();
  EXPECT_NEAR(all, t->total_s(), 1e-9);
  // The first begins with a change and a start; the second with a way; the third with a stop, a change and a
  // start, and the last stop is its own.
  EXPECT_EQ(t->steps[0].tool_change_s, 6.0);
  EXPECT_NEAR(t->steps[0].spindle_s, 1.0, 1e-12);
  EXPECT_EQ(t->steps[0].link_s, 0.0);
  EXPECT_EQ(t->steps[1].tool_change_s, 0.0);
  EXPECT_EQ(t->steps[1].spindle_s, 0.0);
  EXPECT_NEAR(t->steps[1].link_s, t->link_s, 1e-12);
  EXPECT_EQ(t->steps[2].tool_change_s, 6.0);
  EXPECT_NEAR(t->steps[2].spindle_s, 3.0, 1e-12);
  EXPECT_EQ(t->steps[3].total_s(), 0.0);
}

TEST(PlanTime, OfStepsThatGoOnWhereTheOneBeforeEndedHasNoWayBetween) {
  model::Plan plan = plan_with({"a", "a"});
  auto on = std::make_shared<CutterPath>();
  on->start({100, 0, 10});
  on->line({200, 0, 10}, MoveRole::kCut);
  plan.steps[1].path = on;
  const auto t = time_of(plan);
  ASSERT_TRUE(t);
  EXPECT_EQ(t->link_s, 0.0);
}

TEST(PlanTime, CountsOnlyTheDifferenceOfSpeedsWhereTheToolStays) {
  model::Plan plan = plan_with({"a", "a"});
  plan.steps[1].spindle_rpm = 6000.0;
  const auto t = time_of(plan);
  ASSERT_TRUE(t);
  EXPECT_NEAR(t->spin_up_s, 1.0 + 0.2 + 1.2, 1e-12);
}

TEST(PlanTime, StartsTheSpindleForTheFirstMoveWhateverTheStartSays) {
  model::Plan plan = plan_with({"a"});
  plan.steps[0].schedule =
      std::make_shared<const model::FeedSchedule>(model::FeedSchedule{{0, 3000}, {0, 5000}, {0, 0}});
  const auto t = time_of(plan);
  ASSERT_TRUE(t);
  EXPECT_NEAR(t->spin_up_s, 1.0 + 1.0, 1e-12);
}

TEST(PlanTime, StopsTheSpindleAndTakesNoWayBetweenSetUpsWithTheSameTool) {
  model::Plan plan = plan_with({"a", "a"});
  plan.setups.push_back(plan.setups.front());
  plan.steps[1].setup = 1;
  const auto t = time_of(plan);
  ASSERT_TRUE(t);
  EXPECT_EQ(t->tool_changes, 1);
  EXPECT_EQ(t->link_s, 0.0);
  EXPECT_NEAR(t->spin_up_s, 4.0, 1e-12);
}

TEST(PlanTime, PassesOverStepsWithoutAPath) {
  model::Plan plan = plan_with({"a", "b", "a"});
  plan.steps[1].path = nullptr;
  const auto t = time_of(plan);
  ASSERT_TRUE(t);
  EXPECT_EQ(t->tool_changes, 1);
  EXPECT_NEAR(t->cutting_s, 2.0 * 2.1, 1e-9);
}

TEST(PlanTime, NamesTheStepThatHasNone) {
  model::Plan plan = plan_with({"a", "a"});
  model::MachiningWorkingstep step;
  step.its_id = "SLOT rough";
  plan.steps[1].step = model::Ref<model::Executable>(model::AnyRef(plan.model.add(std::move(step))));
  plan.steps[1].feed_mm_min = 0.0;
  const auto t = time_of(plan);
  ASSERT_FALSE(t);
  EXPECT_EQ(t.error().code, "MOT-FEED");
  EXPECT_TRUE(t.error().path.starts_with("SLOT rough ")) << t.error().path;
}

TEST(ScheduleOf, IsTheStepsOwnOrItsOneFeedAndSpeedAllAlong) {
  model::StepResult step = plan_with({"a"}).steps.front();
  EXPECT_EQ(schedule_of(step), (model::FeedSchedule{{3000, 3000}, {5000, 5000}, {0, 0}}));
  const model::FeedSchedule own{{0, 1200}, {5000, 4000}, {0, 0}};
  step.schedule = std::make_shared<const model::FeedSchedule>(own);
  EXPECT_EQ(schedule_of(step), own);
  EXPECT_EQ(schedule_of(model::StepResult{}), model::FeedSchedule{}) << "no path, no schedule";
}

TEST(DurationText, IsInMinutesFromAMinuteOnAndRoundedBeforeItIsSplit) {
  EXPECT_EQ(duration_text(0.0), "0 s");
  EXPECT_EQ(duration_text(59.94), "59.9 s");
  EXPECT_EQ(duration_text(59.96), "1 min 0 s");
  EXPECT_EQ(duration_text(250.6), "4 min 10.6 s");
  EXPECT_EQ(duration_text(119.97), "2 min 0 s");
}

TEST(TextOf, AddsUpToItsTotal) {
  PlanTime t;
  t.cutting_s = 160.0;
  t.dwell_s = 1.4;
  t.rapid_s = 17.7;
  t.link_s = 2.8;
  t.tool_change_s = 50.0;
  t.tool_changes = 10;
  t.spin_up_s = 18.7;
  EXPECT_EQ(text_of(t),
            "4 min 10.6 s: cutting 2 min 41.4 s, rapids 17.7 s, between steps 2.8 s, 10 tool changes 50 s, "
            "spindle 18.7 s");
  t.tool_changes = 1;
  EXPECT_NE(text_of(t).find(" 1 tool change 50 s"), std::string::npos);
}

}  // namespace
}  // namespace capstan::motion

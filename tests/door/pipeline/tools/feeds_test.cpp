#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "planner/door/pipeline/profit.h"
#include "tests/support/corpus.h"
#include "tests/support/shop.h"

// What planning makes of the ways to choose feeds, and of what is wanted most, on the bracket.

namespace capstan::pipeline {
namespace {

const Inputs& shop() {
  static const Inputs kShop = [] {
    Job job;
    auto in = load_shop({}, job);
    return in ? *std::move(in) : Inputs{};
  }();
  return kShop;
}

model::Plan bracket(const Inputs& in) {
  Job job;
  auto plan =
      read_plan(testing::slurp(capstan::testing::source_dir() + "/examples/bracket.p21"), "bracket.p21", job);
  EXPECT_TRUE(plan);
  if (!plan) return {};
  auto out = bind(*std::move(plan), in, {}, job);
  EXPECT_TRUE(out.has_value());
  return out ? *std::move(out) : model::Plan{};
}

double cutting_s(const model::Plan& plan) {
  double s = 0.0;
  for (const auto& step : plan.steps) s += step.cutting_s;
  return s;
}

TEST(ConstantFeeds, AreOneOverAllCuttingMovesOfAStepAndNeverFasterOverall) {
  Inputs in = shop();
  const model::Plan scheduled = bracket(in);
  in.constant_feeds = true;
  const model::Plan constant = bracket(in);
  ASSERT_EQ(constant.steps.size(), scheduled.steps.size());
  std::size_t mills_compared = 0;
  for (const auto& s : constant.steps) {
    ASSERT_TRUE(s.path && s.schedule);
    double lo = 1e300;
    double hi = 0.0;
    for (std::size_t i = 1; i < s.path->size(); ++i) {
      const auto kind = s.path->kind[i];
      if (s.path->role[i] != model::MoveRole::kCut || kind == model::MoveKind::kRapid ||
          kind == model::MoveKind::kDwell)
        continue;
      lo = std::min(lo, s.schedule->feed_mm_min[i]);
      hi = std::max(hi, s.schedule->feed_mm_min[i]);
    }
    const auto* c = model::find_cutter(constant, s.cutter_id);
    const bool mills = c != nullptr && (c->cutter_class == model::CutterClass::kEndmill ||
                                        c->cutter_class == model::CutterClass::kFacemill);
    if (mills && hi > 0.0) {
      ++mills_compared;
      EXPECT_EQ(lo, hi) << model::step_id(constant, s);
    }
  }
  EXPECT_GT(mills_compared, 0U);
  EXPECT_GE(cutting_s(constant), cutting_s(scheduled));
  Job job;
  for (const auto& f : findings_of(constant, job)) EXPECT_NE(f.severity, Severity::kError) << f.message;
}

TEST(Profit, OfThePlanMadeForItIsNoLessThanOfThoseForTimeAndCost) {
  Inputs in = shop();
  constexpr double kRevenue = 40.0;
  const auto rate = [&](Objective o) {
    in.objective = o;
    in.revenue.reset();
    if (o == Objective::kProfit) in.revenue = kRevenue;
    const Economy e = economy_of(bracket(in));
    EXPECT_GT(e.time_min, 0.0);
    return (kRevenue - e.cost) / e.time_min;
  };
  const double of_profit = rate(Objective::kProfit);
  EXPECT_GE(of_profit, rate(Objective::kCost) * (1.0 - 1e-9));
  // Each step is made best by itself, and tools are chosen before: a thousandth is left to that.
  EXPECT_GE(of_profit, rate(Objective::kTime) * (1.0 - 1e-3));
}

TEST(LastSolver, PlansTheSameWhereASpindleIsWeak) {
  Inputs in = shop();
  for (auto& p : in.machine.spindle.curve) {
    p.power_w *= 0.1;
    p.torque_nm *= 0.1;
  }
  const model::Plan plan = bracket(in);
  EXPECT_FALSE(plan.steps.empty());
  for (const auto& s : plan.steps) {
    for (const auto& h : s.held_by) EXPECT_LT(h.limit, 1e9) << model::step_id(plan, s) << " " << h.name;
    for (const auto& a : s.active) EXPECT_LT(a.limit, 1e9) << model::step_id(plan, s) << " " << a.name;
  }
}

}  // namespace
}  // namespace capstan::pipeline

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "planner/physics/mechanics/loads/margin.h"
#include "tests/support/corpus.h"
#include "tests/support/shop.h"

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

model::Plan pocket() {
  Job job;
  auto plan = read_plan(testing::slurp(capstan::testing::source_dir() + "/examples/reference_pocket.p21"),
                        "reference_pocket.p21", job);
  EXPECT_TRUE(plan) << (plan ? "" : to_text(plan.error()));
  return plan ? *std::move(plan) : model::Plan{};
}

Result<model::Plan> bound(model::Plan plan, const Inputs& in) {
  Job job;
  return bind(std::move(plan), in, {}, job);
}

std::string margin_of(const model::Plan& plan) {
  const auto at = std::find_if(plan.provenance.begin(), plan.provenance.end(),
                               [](const auto& p) { return p.what == "margin"; });
  return at == plan.provenance.end() ? "" : at->value;
}

TEST(Margin, IsTheUsualOneWhereNoneIsNamed) {
  const auto plan = bound(pocket(), shop());
  ASSERT_TRUE(plan);
  EXPECT_EQ(margin_of(*plan), mechanics::kUsualMargin.name);
}

TEST(Margin, OfACarefulPlanHoldsWhenItIsPlannedAgain) {
  Inputs careful = shop();
  careful.margin = mechanics::margin_policy("careful");
  const auto plan = bound(pocket(), careful);
  ASSERT_TRUE(plan);
  ASSERT_FALSE(plan->steps.empty());
  auto again = *plan;
  const auto second = bound(std::move(again), shop());
  ASSERT_TRUE(second);
  EXPECT_EQ(margin_of(*second), "careful");
}

TEST(Margin, GivesHigherLoadsForTheSameCutTheMoreCarefulItIs) {
  // The path and the chip are the cutter's; the expected load of a cut is the same whatever the margin.
  double last = 0.0;
  for (const char* name : {"bold", "usual", "careful"}) {
    Inputs in = shop();
    in.margin = mechanics::margin_policy(name);
    const auto plan = bound(pocket(), in);
    ASSERT_TRUE(plan);
    ASSERT_FALSE(plan->steps.empty());
    const double factor = plan->steps.front().loads.force_margin;
    EXPECT_GT(factor, last) << name;
    last = factor;
  }
}

TEST(Margin, OfAPlanThatNobodyKnowsIsRefusedWithTheNames) {
  model::Plan plan = pocket();
  plan.provenance.push_back({"margin", "reckless", "--margin"});
  const auto out = bound(std::move(plan), shop());
  ASSERT_FALSE(out);
  EXPECT_EQ(out.error().code, "NAME-UNKNOWN");
  EXPECT_NE(out.error().hint.find("--margin"), std::string::npos) << out.error().hint;
}

}  // namespace
}  // namespace capstan::pipeline

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
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

// 1.28 standard deviations: nine of ten cuts stay below, between the usual and the careful.
TEST(Margin, OfTheShopsOwnNumberOfDeviationsLiesBetweenThoseOfItsNeighboursAndHolds) {
  const auto factor = [](const char* name) {
    Inputs in = shop();
    in.margin = mechanics::margin_policy(name);
    const auto plan = bound(pocket(), in);
    return plan && !plan->steps.empty() ? plan->steps.front().loads.force_margin : 0.0;
  };
  EXPECT_GT(factor("1.28"), factor("usual"));
  EXPECT_LT(factor("1.28"), factor("careful"));
  // The factor is exp(k s): its logarithm goes with the deviations.
  EXPECT_NEAR(std::log(factor("1.28")), 1.28 * std::log(factor("usual")), 1e-6);
  Inputs in = shop();
  in.margin = mechanics::margin_policy("1.280");
  const auto plan = bound(pocket(), in);
  ASSERT_TRUE(plan);
  EXPECT_EQ(margin_of(*plan), "1.28");
  const auto second = bound(model::Plan(*plan), shop());
  ASSERT_TRUE(second);
  EXPECT_EQ(margin_of(*second), "1.28");
}

TEST(Margin, OfNoDeviationsOrOfTooManyIsNone) {
  for (const char* wrong : {"0", "-1", "3.01", "1e9", "nan", "inf", "", "1,28", "reckless"})
    EXPECT_FALSE(mechanics::margin_policy(wrong)) << wrong;
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

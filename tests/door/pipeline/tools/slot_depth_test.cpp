#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "planner/model/nouns/all.h"
#include "tests/support/corpus.h"
#include "tests/support/shop.h"

// A level between walls begins with a slot or a bore, whose chips must come out: no deeper than 1 D in
// stainless steel and titanium (Tungaloy catalogue 2020-21 p. 1084).

namespace capstan::pipeline {
namespace {

/// examples/reference_pocket.p21, of another depth.
std::string pocket(const std::string& depth_mm) {
  std::string text = testing::slurp(testing::source_dir() + "/examples/reference_pocket.p21");
  const std::string depth = "(0.,0.,-10.)";
  return text.replace(text.find(depth), depth.size(), "(0.,0.,-" + depth_mm + ".)");
}

model::Plan planned(const std::string& part, const std::string& material) {
  Job job;
  ShopFiles names;
  names.material = material;
  auto in = load_shop(names, job);
  EXPECT_TRUE(in) << (in ? "" : to_text(in.error()));
  auto plan = read_plan(part, "part.p21", job);
  EXPECT_TRUE(plan) << (plan ? "" : to_text(plan.error()));
  if (!in || !plan) return {};
  auto made = bind(*std::move(plan), *in, {}, job);
  EXPECT_TRUE(made) << (made ? "" : to_text(made.error()));
  return made ? *std::move(made) : model::Plan{};
}

const model::BottomAndSideMilling* milling_of(const model::Plan& plan, const model::StepResult& step) {
  const auto* ws = plan.model.get<model::MachiningWorkingstep>(step.step);
  return ws == nullptr ? nullptr : plan.model.get<model::BottomAndSideMilling>(ws->its_operation);
}

/// Of the first step, the roughing of the pocket, in diameters.
double level_in_d(const model::Plan& plan) {
  if (plan.steps.empty() || milling_of(plan, plan.steps.front()) == nullptr) return 1e9;
  const auto& rough = plan.steps.front();
  return rough.axial_depth_mm / model::find_cutter(plan, rough.cutter_id)->cutting_diameter_mm;
}

TEST(LevelsBetweenWalls, ByRingsAreNoDeeperThanSlotsOfTheMaterialMayBe) {
  constexpr double kRounding = 1e-6;
  for (const char* material : {"X5CrNi18-10", "Ti6Al4V"})
    EXPECT_LE(level_in_d(planned(pocket("12"), material)), 1.0 + kRounding) << material;
}

TEST(LevelsBetweenWalls, ByConstantEngagementAreNoDeeperThanABoreMayBe) {
  const auto plan = planned(pocket("20"), "X5CrNi18-10");
  ASSERT_FALSE(plan.steps.empty());
  const auto* ws = plan.model.get<model::MachiningWorkingstep>(plan.steps.front().step);
  const auto* d = plan.ledger.find(ws->its_operation, "its_machining_strategy");
  ASSERT_NE(d, nullptr);
  ASSERT_EQ(d->rejected.size(), 2u);
  EXPECT_THAT(d->rejected[1].what, ::testing::MatchesRegex("constant engagement .* 9.9 mm deep"));
}

// A step is cut from its open side: nothing of it is a slot.
TEST(LevelsOfAStep, MayBeDeeperThanASlot) {
  std::string text = testing::slurp(testing::source_dir() + "/tests/door/pipeline/parts/open_ends.p21");
  const std::string depth = "(0.,0.,-6.)";
  const auto plan = planned(text.replace(text.find(depth), depth.size(), "(0.,0.,-14.)"), "X5CrNi18-10");
  const auto rough = std::find_if(plan.steps.begin(), plan.steps.end(), [&](const auto& s) {
    return model::step_id(plan, s) == "STEP area_rough";
  });
  ASSERT_NE(rough, plan.steps.end());
  EXPECT_GT(rough->axial_depth_mm, model::find_cutter(plan, rough->cutter_id)->cutting_diameter_mm);
}

TEST(FinishedWalls, AreAsWideACutAsTheBentRoughCutterLeft) {
  const auto plan = planned(pocket("20"), "X5CrNi18-10");
  ASSERT_GE(plan.steps.size(), 2u);
  const auto& rough = plan.steps[plan.steps.size() - 2];
  const auto& finish = plan.steps.back();
  const auto* roughing = milling_of(plan, rough);
  ASSERT_NE(roughing, nullptr);
  const double left = roughing->allowance_side.value_or(0.0);
  ASSERT_GT(left, 0.0);
  ASSERT_GT(rough.loads.deflection_mm, 0.0);
  EXPECT_NEAR(finish.radial_depth_mm, left + std::min(left, rough.loads.deflection_mm), 1e-6);
}

}  // namespace
}  // namespace capstan::pipeline

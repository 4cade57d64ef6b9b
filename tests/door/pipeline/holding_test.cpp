#include <gtest/gtest.h>

#include "planner/ground/base/file.h"
#include "planner/model/nouns/all.h"
#include "tests/support/corpus.h"
#include "tests/support/shop.h"

namespace capstan::pipeline {
namespace {

Inputs shop(const std::string& workholding) {
  Job job;
  auto in = load_shop({}, job);
  in->workholding = workholding;
  return *std::move(in);
}

model::Plan part(const std::string& name) {
  Job job;
  const std::string path = capstan::testing::source_dir() + "/examples/" + name;
  return *read_plan(*read_file(path), path, job);
}

TEST(Hold, SaysThatNothingIsPlannedWhenNobodyAsks) {
  Job job;
  const auto plan = bind(part("two_setups.p21"), shop(""), {}, job);
  ASSERT_TRUE(plan);
  ASSERT_EQ(plan->setups.size(), 2U);
  EXPECT_TRUE(plan->setups[0].holding.solids.empty());
  bool said = false;
  for (const auto& p : plan->provenance) said = said || (p.what == "workholding" && p.value == "none");
  EXPECT_TRUE(said);
}

TEST(Hold, AutoHoldsBothSidesOfAPlateInAViseAndKeepsItWhenBoundAgain) {
  Job job;
  const auto plan = bind(part("two_setups.p21"), shop("auto"), {}, job);
  ASSERT_TRUE(plan);
  ASSERT_TRUE(plan->unplanned.empty());
  for (const auto& s : plan->setups) EXPECT_EQ(s.holding.id, "vise_125");
  const auto again = bind(*plan, shop(""), {}, job);
  ASSERT_TRUE(again);
  for (std::size_t i = 0; i < plan->setups.size(); ++i)
    EXPECT_EQ(again->setups[i].holding, plan->setups[i].holding);
  // One instruction for each set-up, not one more each time.
  EXPECT_EQ(again->model.all(model::TypeId::kWorkpieceSetup).size(), 2U);
  for (const auto r : again->model.all(model::TypeId::kWorkpieceSetup))
    EXPECT_EQ(again->model.get<model::WorkpieceSetup>(r)->its_instructions.items.size(), 1U);
  for (const auto& f : findings_of(*again, job)) EXPECT_NE(f.severity, Severity::kError) << f.message;
}

TEST(Hold, ASetUpWithoutAHoldingAmongOthersIsNamed) {
  Job job;
  auto plan = bind(part("two_setups.p21"), shop("auto"), {}, job);
  ASSERT_TRUE(plan);
  plan->setups[1].holding = {};
  Job second;
  const auto again = bind(*plan, shop(""), {}, second);
  ASSERT_TRUE(again);
  EXPECT_FALSE(again->setups[0].holding.solids.empty());
  bool said = false;
  for (const auto& d : second.diagnostics())
    said = said || (d.code == "PIP-HOLDING" && d.message.find("set-up 2") != std::string::npos);
  EXPECT_TRUE(said);
}

TEST(Hold, AClampIsRefusedWhereAViseIsMeant) {
  Job job;
  const auto plan = bind(part("two_setups.p21"), shop("strap_clamp_m8"), {}, job);
  ASSERT_FALSE(plan);
  EXPECT_EQ(plan.error().code, "HOLD-KIND");
}

}  // namespace
}  // namespace capstan::pipeline

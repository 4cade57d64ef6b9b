#include "planner/model/plan/order/step_ids.h"

#include <gtest/gtest.h>

#include "planner/model/nouns/all.h"

namespace capstan::model {
namespace {

TEST(StepIds, AreThoseOfEachStepAskedForItself) {
  Plan plan;
  const auto add = [&](std::optional<std::string> id, std::optional<std::string> persistent) {
    MachiningWorkingstep ws;
    ws.its_id = std::move(id);
    ws.persistent_id = std::move(persistent);
    StepResult step;
    step.step = Ref<Executable>(plan.model.add(std::move(ws)));
    plan.steps.push_back(step);
  };
  add("drill", std::nullopt);
  add("drill", std::nullopt);
  add("ream", "drill");
  add(std::nullopt, std::nullopt);
  plan.steps.push_back(plan.steps.front());  // once more, as when a step is done in two set-ups
  add("drill", std::nullopt);
  plan.steps.push_back({});  // of no executable
  plan.steps.push_back(plan.steps[1]);
  const std::vector<std::string> ids = step_ids(plan);
  ASSERT_EQ(ids.size(), plan.steps.size());
  for (std::size_t i = 0; i < ids.size(); ++i) EXPECT_EQ(ids[i], step_id(plan, plan.steps[i])) << i;
  EXPECT_EQ(ids[0], "drill");
  EXPECT_EQ(ids[2], "drill~3");
}

}  // namespace
}  // namespace capstan::model

#include "planner/model/plan/decision/contradicted.h"

#include <gtest/gtest.h>

#include "tests/door/pipeline/block.h"

namespace capstan::pipeline {
namespace {

TEST(Contradictions, AreSettledByWhatTheCallerNamesAndNotByWhatThePlanWasMadeWith) {
  model::Plan plan = block::read(block::kTwoHoles);
  const model::AnyRef piece = plan.model.all(model::TypeId::kWorkpiece).front();
  model::set_contradicted(plan, piece, "its_material", "said twice");
  model::set_contradicted(plan, piece, "its_rawpiece", "said twice");
  const auto left = [&](const Inputs& in) {
    return model::contradictions(block::bound(plan, in).plan).size();
  };
  Inputs in = block::shop();
  EXPECT_EQ(left(in), 2U);
  in.material_name = "wrought_aluminium";
  EXPECT_EQ(left(in), 1U);
  in.stock = geometry::Box3{{0, 0, -20}, {100, 100, 0}};
  EXPECT_EQ(left(in), 0U);
  in.material_of_plan = in.stock_of_plan = true;
  EXPECT_EQ(left(in), 2U);
}

}  // namespace
}  // namespace capstan::pipeline

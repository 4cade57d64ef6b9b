#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "planner/door/pipeline/shop.h"
#include "planner/files/exchange/exchange.h"
#include "planner/model/nouns/all.h"
#include "planner/model/nouns/arena/walk.h"
#include "tests/support/corpus.h"

// A tool of one name is one tool, all through a plan.

namespace capstan::pipeline {
namespace {

const Inputs& shop() {
  static const Inputs one = [] {
    Job job;
    return load_shop({}, job).value();
  }();
  return one;
}

const model::Plan& bracket() {
  static const model::Plan one = [] {
    Job job;
    const std::string path = std::string(CAPSTAN_SOURCE_DIR) + "/examples/bracket.p21";
    auto read = read_plan(testing::slurp(path), "bracket.p21", job);
    return bind(*std::move(read), shop(), {}, job).value();
  }();
  return one;
}

const model::StepResult* step_of(const model::Plan& plan, const std::string& id) {
  for (const auto& s : plan.steps) {
    if (model::step_id(plan, s) == id) return &s;
  }
  return nullptr;
}

std::vector<model::AnyRef>& elements(model::Plan& plan) {
  const auto main = plan.model.at<model::Project>(plan.project).main_workplan;
  return plan.model.at<model::Workplan>(main).its_elements.items;
}

/// The steps of a feature are gone: they are proposed anew.
void forget(model::Plan& plan, const std::string& feature) {
  model::AnyRef at;
  std::erase_if(elements(plan), [&](model::AnyRef e) {
    const auto* ws = plan.model.get<model::MachiningWorkingstep>(e);
    const auto* f = ws == nullptr ? nullptr : plan.model.get<model::MachiningFeature>(ws->its_feature);
    if (f == nullptr || f->its_id != feature) return false;
    at = ws->its_feature;
    return true;
  });
  plan.model.at<model::MachiningFeature>(at).its_operations.items.clear();
}

TEST(OneTool, StandsOutAlikeInProposedStepsAndInThoseOfTheFile) {
  model::Plan plan = bracket();
  forget(plan, "SLOT");
  const std::string given = step_of(plan, "CAP SCREW HOLE[1] mill_finish")->cutter_id;
  double wanted = 0.0;
  for (model::Cutter& c : plan.cutters) {
    if (c.id != given) continue;
    // A finger longer than the library has it.
    for (double* length : {&c.stick_out_mm, &c.usable_length_mm, &c.functional_length_mm}) *length += 10.0;
    wanted = c.stick_out_mm;
  }
  Job job;
  const auto out = bind(plan, shop(), {}, job);
  ASSERT_TRUE(out) << to_text(out.error());
  const auto* anew = step_of(*out, "SLOT area_finish");
  const auto* before = step_of(bracket(), "SLOT area_finish");
  ASSERT_NE(anew, nullptr);
  if (anew->cutter_id != given) GTEST_SKIP() << "planned with another tool";
  EXPECT_DOUBLE_EQ(model::find_cutter(*out, given)->stick_out_mm, wanted);
  // The same cut with a tool that is 37 mm out instead of 27 bends more, or is cut with less.
  EXPECT_TRUE(anew->loads.deflection_mm > before->loads.deflection_mm ||
              anew->feed_mm_min < before->feed_mm_min)
      << anew->loads.deflection_mm << " after " << before->loads.deflection_mm;
}

TEST(OneTool, WhichOfTwoKeepsTheirNameDoesNotDependOnTheOrderOfTheSteps) {
  const auto names = [](bool other_order) {
    model::Plan plan = bracket();
    const std::string first = "M6 CORE drill", second = "CAP SCREW HOLE[1] mill_rough";
    for (const std::string& id : {first, second}) {
      const auto& ws = plan.model.at<model::MachiningWorkingstep>(step_of(plan, id)->step);
      const auto& op = plan.model.at<model::MachiningOperation>(ws.its_operation);
      auto& tool = plan.model.at<model::MillingCuttingTool>(op.its_tool);
      auto& usage = plan.model.at<model::ToolUsage>(tool.its_usage);
      tool.its_id = usage.its_id = usage.its_library_reference = "T";
    }
    if (other_order) {
      auto& all = elements(plan);
      const auto at = [&](const std::string& id) {
        return std::find(all.begin(), all.end(), model::AnyRef(step_of(plan, id)->step));
      };
      std::iter_swap(at(first), at(second));
    }
    Job job;
    const auto out = bind(plan, shop(), {}, job);
    if (!out) return std::string("no plan");
    return step_of(*out, first)->cutter_id + ", " + step_of(*out, second)->cutter_id;
  };
  // The drill of 5 mm is smaller than the mill of 6.
  EXPECT_EQ(names(false), "T, T~2");
  EXPECT_EQ(names(true), "T, T~2");
}

}  // namespace
}  // namespace capstan::pipeline

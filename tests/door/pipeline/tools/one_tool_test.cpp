#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <string>

#include "planner/files/exchange/exchange.h"
#include "planner/making/given/magazine.h"
#include "planner/model/nouns/all.h"
#include "planner/model/nouns/arena/walk.h"
#include "tests/support/corpus.h"
#include "tests/support/shop.h"

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
    const std::string path = capstan::testing::source_dir() + "/examples/bracket.p21";
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
  ASSERT_EQ(anew->cutter_id, given) << "else this shows nothing: take another step of the bracket";
  EXPECT_DOUBLE_EQ(model::find_cutter(*out, given)->stick_out_mm, wanted);
  // The same cut with a tool that is 37 mm out instead of 27 bends more, or is cut with less.
  EXPECT_TRUE(anew->loads.deflection_mm > before->loads.deflection_mm ||
              anew->feed_mm_min < before->feed_mm_min)
      << anew->loads.deflection_mm << " after " << before->loads.deflection_mm;
}

TEST(OneTool, WhichOfTwoKeepsTheirNameDoesNotDependOnTheOrderOfTheSteps) {
  const auto names = [](bool other_order) {
    model::Plan plan = bracket();
    const std::string first = "M6 CORE drill", second = "CAP SCREW HOLE[1] mill_finish";
    for (const std::string& id : {first, second}) {
      if (step_of(plan, id) == nullptr) return "no step '" + id + "': take another of the bracket";
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
  // The drill of 5 mm is smaller than the mill of 8.
  EXPECT_EQ(names(false), "T, T~2");
  EXPECT_EQ(names(true), "T, T~2");
}

/// plate_bound.p21, whose step 'DRILL PLAIN HOLE' names its own drill: 'DRILL 9', 9 mm, 110 mm long.
model::Plan plate_with(const model::Cutter& also_in_library) {
  Inputs in = shop();
  in.library.push_back(also_in_library);
  Job job;
  const std::string path = capstan::testing::source_dir() + "/examples/plate_bound.p21";
  auto read = read_plan(testing::slurp(path), "plate_bound.p21", job);
  return bind(*std::move(read), in, {}, job).value();
}

/// A drill of this diameter that is loaded as T3 and 125 mm long, and has the name of the file's.
model::Cutter loaded_drill(double diameter_mm) {
  for (const model::Cutter& c : shop().library) {
    if (c.cutter_class != model::CutterClass::kTwistDrill || c.cutting_diameter_mm != diameter_mm) continue;
    model::Cutter out = c;
    out.id = "DRILL 9";
    out.pocket = 3;
    out.loaded = true;
    out.functional_length_mm = 125.0;
    return out;
  }
  return {};
}

const model::Cutter* drill_of(const model::Plan& plan) {
  const auto* step = step_of(plan, "DRILL PLAIN HOLE");
  return step == nullptr ? nullptr : model::find_cutter(plan, step->cutter_id);
}

TEST(OneTool, OfTheFileLeavesItsNameToTheLibrarysOfAnotherSize) {
  const model::Cutter other = loaded_drill(8.5);
  ASSERT_EQ(other.id, "DRILL 9");
  const model::Plan plan = plate_with(other);
  const auto* drill = drill_of(plan);
  ASSERT_NE(drill, nullptr);
  EXPECT_EQ(drill->id, "DRILL 9~2");
  EXPECT_DOUBLE_EQ(drill->cutting_diameter_mm, 9.0);
  EXPECT_DOUBLE_EQ(drill->functional_length_mm, 110.0) << "not the length of the drill of 8.5 mm";
  EXPECT_FALSE(drill->loaded);
}

TEST(OneTool, OfTheFileThatIsTheLibrarysInAllThatItStatesIsTheLoadedOne) {
  model::Cutter same = loaded_drill(9.0);
  ASSERT_EQ(same.id, "DRILL 9");
  const model::Plan before = plate_with(loaded_drill(8.5));
  same.maximum_depth_of_cut_mm = drill_of(before)->maximum_depth_of_cut_mm;
  same.point_angle_rad = drill_of(before)->point_angle_rad;
  same.teeth = drill_of(before)->teeth;
  const model::Plan plan = plate_with(same);
  const auto* drill = drill_of(plan);
  ASSERT_NE(drill, nullptr);
  EXPECT_EQ(drill->id, "DRILL 9");
  EXPECT_EQ(drill->pocket, 3);
  EXPECT_TRUE(drill->loaded);
  EXPECT_DOUBLE_EQ(drill->functional_length_mm, 125.0);
}

TEST(OneTool, ALoadedToolThatThePlanDoesNotNameGetsANameOfItsOwn) {
  // The plan's drill of 9 mm is loaded under another name; what the table calls 'DRILL 9' has 8.5 mm.
  Job job;
  const std::string path = capstan::testing::source_dir() + "/examples/plate_bound.p21";
  model::Plan plan = read_plan(testing::slurp(path), "plate_bound.p21", job).value();
  model::Cutter nine = loaded_drill(9.0);
  nine.id = "T7";
  nine.pocket = 7;
  nine.point_angle_rad = 0.0;  // as a table has it: it does not say
  Inputs in = shop();
  in.library = {nine, loaded_drill(8.5)};
  ASSERT_TRUE(given::match_loaded(plan, in.library, job));
  std::map<std::string, double> diameters;
  for (const model::Cutter& c : in.library)
    EXPECT_TRUE(diameters.emplace(c.id, c.cutting_diameter_mm).second);
  EXPECT_DOUBLE_EQ(diameters["DRILL 9"], 9.0);
  EXPECT_DOUBLE_EQ(diameters["DRILL 9~2"], 8.5);
}

}  // namespace
}  // namespace capstan::pipeline

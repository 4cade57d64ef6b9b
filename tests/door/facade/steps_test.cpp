#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <vector>

#include "capstan/capstan.h"
#include "tests/support/corpus.h"

// The steps of a plan's JSON as other programs read them: what each is, how long it takes, what it is called.

namespace capstan {
namespace {

using Json = nlohmann::json;

const std::string kBracket = capstan::testing::source_dir() + "/examples/bracket.p21";

/// The plan of the bracket, made once.
const PlanOutput& bracket() {
  static const PlanOutput kPlan = plan_file(kBracket, {});
  return kPlan;
}

std::vector<std::string> ids_of(const PlanOutput& plan) {
  std::vector<std::string> out;
  const Json tree = Json::parse(plan.json);
  for (const Json& step : tree.at("steps")) out.push_back(step.at("id"));
  return out;
}

TEST(PlanSteps, SayToolOperationAndFeatureWithoutAReferenceToFollow) {
  const Json plan = Json::parse(bracket().json);
  std::map<std::string, int> numbers;
  for (const Json& cutter : plan.at("cutters")) numbers[cutter.at("id")] = cutter.at("pocket");
  ASSERT_FALSE(plan.at("steps").empty());
  for (const Json& step : plan.at("steps")) {
    EXPECT_EQ(step.at("tool_number"), numbers.at(step.at("cutter_id"))) << step.at("id");
    EXPECT_GT(step.at("tool_number"), 0);
    EXPECT_TRUE(plan.at("objects").contains(step.at("operation").get<std::string>())) << step.at("operation");
    EXPECT_TRUE(step.at("id").get<std::string>().starts_with(step.at("feature").get<std::string>()))
        << step.at("id") << " of " << step.at("feature");
  }
}

TEST(PlanSteps, TakeTogetherTheTimeThatIsPrinted) {
  const Json plan = Json::parse(bracket().json);
  double all = 0.0, changes = 0.0;
  for (const Json& step : plan.at("steps")) {
    for (const char* part : {"cutting_s", "rapid_s", "link_s", "tool_change_s", "spindle_s"})
      all += step.at(part).get<double>();
    changes += step.at("tool_change_s").get<double>();
  }
  EXPECT_GT(changes, 0.0);
  EXPECT_NEAR(all, plan.at("summary").at("total_s").get<double>(), 1e-6);
  EXPECT_NEAR(all, bracket().time_s, 1e-6);  // as the last line of `capstan plan` says it
}

TEST(PlanSteps, KeepTheirIdsWhenThePlanIsEdited) {
  const std::vector<std::string> before = ids_of(bracket());
  EXPECT_EQ(std::set<std::string>(before.begin(), before.end()).size(), before.size());
  // Another feed, another tool, another order, and the plan's own JSON planned anew.
  PlanOptions slower;
  slower.limit = {"feed<=1200"};
  EXPECT_EQ(ids_of(plan_file(kBracket, slower)), before);
  PlanOptions pinned;
  pinned.pin = {"SLOT*/tool"};
  EXPECT_EQ(ids_of(plan_bytes(bracket().json, "plan.json", pinned)), before);
  PlanOptions without;
  without.forbid = {"tool=generic/reamer*"};
  const std::vector<std::string> other = ids_of(plan_file(kBracket, without));
  EXPECT_NE(other, before);
  // A step that is still there is called as it was; others are left out or new.
  std::vector<std::string> kept;
  std::ranges::copy_if(other, std::back_inserter(kept),
                       [&](const std::string& id) { return std::ranges::find(before, id) != before.end(); });
  std::size_t of_others = 0;
  for (const std::string& id : before) of_others += id.starts_with("DOWEL") ? 0 : 1;
  EXPECT_GE(kept.size(), of_others);
}

TEST(PlanSteps, AreTheSameWithoutTheirCrossSections) {
  PlanOptions options;
  options.without = "sections";
  const PlanOutput bare = plan_file(kBracket, options);
  ASSERT_TRUE(bare.planned);
  EXPECT_LT(bare.json.size(), bracket().json.size());
  Json with = Json::parse(bracket().json), without = Json::parse(bare.json);
  EXPECT_FALSE(with.at("sections").empty());
  EXPECT_TRUE(without.at("sections").empty());
  for (Json* plan : {&with, &without}) {
    plan->erase("sections");
    plan->erase("seals");
    for (Json& step : plan->at("steps")) {
      EXPECT_TRUE(step.contains("peak"));
      step.erase("sections");
    }
  }
  EXPECT_EQ(with, without);
  EXPECT_EQ(bare.linuxcnc, bracket().linuxcnc);
  // It is a plan: read, checked, and nobody is said to have edited it.
  const CheckOutput checked = check_bytes({{"bare.json", bare.json}, {"bare.ngc", bare.linuxcnc}});
  EXPECT_TRUE(checked.checked && checked.clean);
  for (const PlanMessage& m : checked.diagnostics) EXPECT_NE(m.code, "JSON-EDITED") << m.text;
}

TEST(PlanSteps, WithoutWhatNoPlanHasIsRefused) {
  PlanOptions options;
  options.without = "paths";
  const PlanOutput none = plan_file(kBracket, options);
  EXPECT_FALSE(none.planned);
  ASSERT_FALSE(none.diagnostics.empty());
  EXPECT_EQ(none.diagnostics.front().code, "OPTION-VALUE");
}

}  // namespace
}  // namespace capstan

#include "planner/door/app/show/query.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <random>
#include <regex>

#include "planner/door/app/show/inspect.h"
#include "planner/door/app/show/node.h"
#include "planner/door/app/show/paths.h"
#include "tests/door/app/plans.h"
#include "tests/support/corpus.h"

namespace capstan::app {
namespace {

using ::testing::HasSubstr;

model::Plan bracket() {
  Job job;
  auto plan = exchange::read(testing::example("bracket.p21"), job);
  EXPECT_TRUE(plan) << to_text(plan.error());
  return plan ? *std::move(plan) : model::Plan{};
}

std::string ask(const model::Plan& plan, const std::string& path) {
  const auto text = inspect(plan, path);
  return text ? *text : "error: " + to_text(text.error());
}
std::string at(const std::string& path) {
  static const model::Plan kPlan = testing::read_text(testing::drilled_plate());
  return ask(kPlan, path);
}

TEST(Query, FindsEverythingOfAKindWhereverItStands) {
  EXPECT_EQ(at("//round_hole/its_id"), "'HOLE'\n");
  EXPECT_EQ(at("//ROUND_HOLE#size"), "1\n");
  EXPECT_EQ(at("/project//cartesian_point#size"), at("/project//CARTESIAN_POINT#size"));
  EXPECT_EQ(at("//compound_feature"), "(none)\n");
  EXPECT_EQ(at("//compound_feature#size"), "0\n");
}

TEST(Query, SearchesBelowAnObjectOnly) {
  EXPECT_EQ(at("#17//toleranced_length_measure/theoretical_size"), "10 mm\n");
  EXPECT_EQ(at("#58//round_hole#size"), "0\n");
}

TEST(Query, ComparesNumbersInTheUnitsOfTheModel) {
  for (const auto& [condition, holds] : std::vector<std::pair<std::string, bool>>{
           {"diameter.theoretical_size = 10", true},
           {"diameter.theoretical_size=10.0000000000001", true},
           {"diameter.theoretical_size != 10", false},
           {"diameter.theoretical_size > 9.5", true},
           {"diameter.theoretical_size > 10", false},
           {"diameter.theoretical_size >= 10", true},
           {"diameter.theoretical_size <= 1e1", true},
           {"diameter.theoretical_size < -3", false},
           {"its_id = 'HOLE'", true},
           {"its_id = 'hole'", false},
           {"its_id != 'X'", true},
           {"its_id", true},
           {"change_in_diameter", false},
           {"change_in_diameter.angle > 0", false},
           {"not change_in_diameter", true},
           {"bottom_condition is through_bottom_condition or its_id = 'X'", true},
           {". is round_hole", true},
           {". is pocket", false},
           {"its_id = 'X' or its_id = 'HOLE' and diameter.theoretical_size = 10", true},
           {"(its_id = 'X' or its_id = 'HOLE') and not (diameter.theoretical_size = 10)", false},
           {"its_operations#size > 0", true},
           {"its_operations is drilling_type_operation", true},
           {"its_operations[0].its_id", true},
           {"its_operations[7].its_id", false},
       }) {
    EXPECT_EQ(at("//round_hole[" + condition + "]#size"), holds ? "1\n" : "0\n") << condition;
  }
}

TEST(Query, FiltersListsAndGoesOn) {
  EXPECT_EQ(at("/project/main_workplan/its_elements[its_feature is round_hole]/its_feature/its_id"),
            "'HOLE'\n");
  EXPECT_EQ(at("/project/main_workplan//machining_workingstep[its_feature is round_hole]/its_feature#size"),
            "1\n");
  EXPECT_EQ(at("/ROUND_HOLE[its_id='HOLE'][0]/its_id"), "'HOLE'\n");
}

TEST(Query, TellsWhereTheObjectsStandThatItFinds) {
  const auto plan = bracket();
  const std::string text = ask(plan, "//round_hole");
  EXPECT_THAT(text, HasSubstr("ROUND_HOLE"));
  EXPECT_THAT(text, HasSubstr("/ROUND_HOLE[0]  #"));
}

TEST(Query, NamesTheCharacterAtWhichAPathIsWrong) {
  for (const auto& [path, what] : std::vector<std::pair<std::string, std::string>>{
           {"//", "'//' is not followed by a kind of object (character 3)"},
           {"//rund_hole", "there is no kind of object 'rund_hole' (character 3)"},
           {"/project//its_id", "there is no kind of object 'its_id' (character 11)"},
           {"//round_hole[", "a bracket is not closed (character 14)"},
           {"//round_hole[its_id='x]", "a text is not closed (character 21)"},
           {"//round_hole[its_id=]", "there is nothing to compare with (character 21)"},
           {"//round_hole[its_id is rund]", "there is no kind of object 'rund' (character 24)"},
           {"//round_hole[its_id = 'X' und its_id]", "'u' has no meaning here (character 27)"},
           {"//round_hole[(its_id]", "a bracket is not closed (character 21)"},
           {"//round_hole[its_name]", "no object here has an attribute 'its_name' (character 14)"},
           {"//round_hole[its_id > 3]", "a text is compared with what is no text: 3 (character 14)"},
           {"//round_hole[diameter > 3]", "is an object and cannot be compared (character 14)"},
           {"//round_hole[diameter.theoretical_size = 'x']", "a number is compared with 'x' (character 14)"},
           {"//round_hole[diameter.theoretical_size = 1.2.3]", "'1.2.3' is not a number (character 42)"},
           {"//round_hole[and]", "no object here has an attribute 'and'"},
           {"//round_hole/its_matter", "has no attribute 'its_matter' (character 14)"},
           {"/project/its_workpieces[0]x", "has no attribute 'x'"},
           {"/project/its workpieces", "' ' has no meaning here (character 13)"},
       }) {
    EXPECT_THAT(at(path), HasSubstr(what)) << path;
  }
}

TEST(Query, RefusesHostilePathsWithoutHarm) {
  EXPECT_THAT(at("//round_hole[" + std::string(100000, '(') + "its_id"), HasSubstr("nested too deep"));
  std::string nots = "//round_hole[";
  for (int i = 0; i < 100000; ++i) nots += "not ";
  EXPECT_THAT(at(nots + "its_id]"), HasSubstr("nested too deep"));
  std::string ors = "//round_hole[its_id";
  for (int i = 0; i < 100000; ++i) ors += " or its_id";
  EXPECT_THAT(at(ors + "]"), HasSubstr("256 parts"));
  std::string dots = "//round_hole[its_id";
  for (int i = 0; i < 100000; ++i) dots += ".its_id";
  EXPECT_THAT(at(dots + "]"), HasSubstr("256 parts"));
}

TEST(Query, AnyTextGivesAnAnswerOrAFault) {
  std::mt19937 random(238);
  const std::vector<std::string> words = {
      "/",  "//", "[",        "]",   "project", "round_hole", "its_id", "'x'", "=",
      "10", ".",  "#size",    "not", "and",     " ",          "is",     "(",   ")",
      "*",  "#1", "diameter", "0",   "<",       "ROUND_HOLE", "or",     "-1e5"};
  for (int i = 0; i < 5000; ++i) {
    std::string path;
    for (auto n = random() % 12; n != 0; --n) path += words[random() % words.size()];
    EXPECT_FALSE(at(path).empty()) << path;
  }
}

// Every object has a path, and the path leads to that object and no other.
void every_path_leads_back(const model::Plan& plan) {
  const Paths paths(plan);
  for (std::size_t t = 1; t < model::kTypeCount; ++t) {
    for (const auto object : plan.model.all(static_cast<model::TypeId>(t))) {
      const std::string path = paths.of(object);
      const auto nodes = nodes_at(plan, path);
      ASSERT_TRUE(nodes) << path << ": " << to_text(nodes.error());
      ASSERT_EQ(nodes->size(), 1U) << path;
      EXPECT_EQ(object_of(plan.model, nodes->front()), object) << path;
    }
  }
}

TEST(Paths, LeadBackToTheirObject) {
  every_path_leads_back(testing::read_text(testing::drilled_plate()));
  every_path_leads_back(bracket());
}

TEST(Paths, LeadBackInRealFiles) {
  for (const char* name :
       {"iso14649/nist_ex1.stp", "ap238/ap238e4dis_annexJ_cc2.stp", "ap238/ap238e4dis_annexJ_cc3.stp"}) {
    CAPSTAN_CORPUS_FILE(path, name);
    Job job;
    const auto plan = exchange::read(path, job);
    ASSERT_TRUE(plan) << to_text(plan.error());
    every_path_leads_back(*plan);
  }
}

// Instance numbers are a file's own.
std::string without_numbers(const std::string& text) {
  return std::regex_replace(text, std::regex("#[0-9]+ "), "");
}

TEST(Query, GivesTheSameAnswerOnBothForms) {
  CAPSTAN_CORPUS_FILE(path, "iso14649/nist_ex1.stp");
  Job job;
  const auto plan = exchange::read(path, job);
  ASSERT_TRUE(plan) << to_text(plan.error());
  const auto written = exchange::write_ap238(*plan, job);
  ASSERT_TRUE(written) << to_text(written.error());
  const auto other = exchange::read_bytes(written->bytes, "nist_ex1.stpnc", {}, job);
  ASSERT_TRUE(other) << to_text(other.error());
  for (const char* query :
       {"/project/its_id", "/project/main_workplan/its_elements#size",
        "/project/main_workplan/its_elements[*]/its_id", "/project/its_workpieces[0]/its_id",
        "//workplan/its_id", "//machining_workingstep[its_id]/its_id"}) {
    EXPECT_EQ(without_numbers(ask(*plan, query)), without_numbers(ask(*other, query))) << query;
  }
}

}  // namespace
}  // namespace capstan::app

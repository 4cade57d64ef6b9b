#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "planner/files/exchange/exchange.h"
#include "planner/files/json/json.h"
#include "planner/ground/base/file.h"
#include "planner/model/plan/range/positions.h"
#include "rules/engine/table.h"
#include "tests/support/corpus.h"
#include "tooling/library/formats/all.h"
#include "tooling/shop/machine/machine.h"

// Inputs that were once too much: each ends soon, with an error that names what is wrong.

namespace capstan {
namespace {

using ::testing::HasSubstr;

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const auto at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return at == std::string::npos ? text : text.replace(at, from.size(), to);
}

TEST(HostileFile, ADeviceThatNeverEndsIsRefused) {
  const auto bytes = read_file("/dev/zero");
  ASSERT_FALSE(bytes);
  EXPECT_EQ(bytes.error().code, "FILE-TOO-LARGE");
  EXPECT_THAT(bytes.error().message, HasSubstr("no regular file"));
}

TEST(HostileMesh, AVertexBeyondTheReachOfGeometryIsNamed) {
  const std::string stl =
      "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1e9 0 0\nvertex 0 10 "
      "-2\nendloop\nendfacet\n"
      "endsolid a\n";
  Job job;
  const auto plan = exchange::read_bytes(stl, "a.stl", {}, job);
  ASSERT_FALSE(plan);
  EXPECT_EQ(plan.error().code, "STL-NUMBER");
  EXPECT_EQ(plan.error().line, 5U);
  EXPECT_EQ(plan.error().message, "a coordinate is 1000000000; it can be -100000 to 100000 mm");
}

TEST(HostileMachine, ValuesNextToZeroAreRefused) {
  const std::string text =
      testing::slurp(capstan::testing::source_dir() + "/tooling/data/machines/generic_vmc.yaml");
  Job job;
  ASSERT_TRUE(tooling::read_machine(text, "m.yaml", job));
  const auto tiny =
      tooling::read_machine(replaced(text, "efficiency: 0.85", "efficiency: 1e-320"), "m.yaml", job);
  ASSERT_FALSE(tiny);
  EXPECT_EQ(tiny.error().code, "MACHINE-RANGE");
  EXPECT_THAT(tiny.error().message, HasSubstr("efficiency is 1e-320"));
  EXPECT_EQ(tiny.error().expected, "0.05 to 1");
  EXPECT_EQ(tiny.error().line, 14U);
  const auto huge =
      tooling::read_machine(replaced(text, "efficiency: 0.85", "efficiency: 1e300"), "m.yaml", job);
  ASSERT_FALSE(huge);
  EXPECT_THAT(huge.error().message, HasSubstr("efficiency is 1e+300"));
  const auto none =
      tooling::read_machine(replaced(text, "efficiency: 0.85", "efficiency: 1e999"), "m.yaml", job);
  ASSERT_FALSE(none);
  EXPECT_THAT(none.error().message, HasSubstr("'1e999' is beyond what a number can be"));
}

// Once without end, and 24 GB: the YAML library makes an empty document of the comma, and again.
TEST(HostileRules, AStrayCommaAtTheTopIsRefused) {
  const auto read = rules::rules_from_texts({{"r.yaml", "# shop\n,table: coolant\nrows: []\n"}});
  ASSERT_FALSE(read);
  EXPECT_EQ(read.error().code, "RULE-SYNTAX");
  EXPECT_EQ(read.error().line, 2U);
}

// Each key was once held against all before it. The runner's TIMEOUT stops what takes without end.
TEST(HostileMachine, AHundredThousandUnknownKeysAreRefused) {
  std::string text = "capstan_machine: 1\n";
  for (int i = 0; i < 100'000; ++i) text += "k" + std::to_string(i) + ": 1\n";
  Job job;
  EXPECT_FALSE(tooling::read_machine(text, "m.yaml", job));
}

TEST(HostilePlan, ANumberBeyondRangeIsNamedWithItsLine) {
  Job job;
  const auto read = json::read_json("{\"capstan_plan\": 1,\n\"summary\": {\"a\": 1e999}}", "p.json", job);
  ASSERT_FALSE(read);
  EXPECT_EQ(read.error().message, "'1e999' is beyond what a number can be (1.8e308 either way)");
  EXPECT_EQ(read.error().line, 2U);
}

TEST(HostileTechnology, ASpindleThatHardlyTurnsIsTold) {
  const std::string plate = testing::slurp(capstan::testing::source_dir() + "/examples/plate_bound.p21");
  Job job;
  (void)exchange::read_bytes(replaced(plate, "-21.", "-1.E-320"), "plate.p21", {}, job);
  EXPECT_FALSE(job.diagnostics().empty());
}

// Once "a fault of the program itself": a feed by a speed of next to nothing is a chip without end.
TEST(HostileTechnology, ASpindleThatHardlyTurnsIsNotPlannedWith) {
  const std::string plate = testing::slurp(capstan::testing::source_dir() + "/examples/plate_bound.p21");
  Job job;
  const auto plan = exchange::read_bytes(replaced(plate, "-21.", "-1.E-320"), "plate.p21", {}, job);
  ASSERT_TRUE(plan);
  // In 1/min: sixty times what the file says.
  EXPECT_THAT(model::beyond_range(*plan),
              ::testing::AllOf(HasSubstr("#61 MILLING_TECHNOLOGY.spindle is -5.9999"),
                               HasSubstr("it can be 0, or 0.001 to 1000000, either way")));
}

// Once quadratic: 48 s for these.
TEST(HostileLibrary, TwentyThousandEqualNamesKeepNamesOfTheirOwn) {
  std::string text = "{\"data\": [";
  for (int i = 0; i < 20000; ++i) {
    text += std::string(i == 0 ? "" : ",") +
            R"({"type":"flat end mill","unit":"millimeters","guid":"g","description":"same",)"
            R"("geometry":{"DC":6,"NOF":3,"LCF":20,"OAL":60},"post-process":{"number":1}})";
  }
  Job job;
  const auto read = tooling::fusion_json_format().read(text + "], \"version\": 1}", "a.json", {}, job);
  ASSERT_TRUE(read) << to_text(read.error());
  EXPECT_EQ(read->library.items.size(), 20000U);
  EXPECT_EQ(read->library.items.back().id, "g (20000)");
}

}  // namespace
}  // namespace capstan

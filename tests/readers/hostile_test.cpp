#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>

#include "planner/files/exchange/exchange.h"
#include "planner/ground/base/file.h"
#include "tests/support/corpus.h"
#include "tooling/catalogue/machine.h"
#include "tooling/formats/all.h"

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
}

TEST(HostileMachine, ValuesNextToZeroAreRefused) {
  const std::string text = testing::slurp(CAPSTAN_SOURCE_DIR "/tooling/data/machines/generic_vmc.yaml");
  Job job;
  ASSERT_TRUE(tooling::read_machine(text, "m.yaml", job));
  const auto tiny =
      tooling::read_machine(replaced(text, "efficiency: 0.85", "efficiency: 1e-320"), "m.yaml", job);
  ASSERT_FALSE(tiny);
  EXPECT_EQ(tiny.error().code, "MACHINE-RANGE");
}

TEST(HostileTechnology, ASpindleThatHardlyTurnsIsTold) {
  const std::string plate = testing::slurp(CAPSTAN_SOURCE_DIR "/examples/plate_bound.p21");
  Job job;
  (void)exchange::read_bytes(replaced(plate, "-21.", "-1.E-320"), "plate.p21", {}, job);
  EXPECT_FALSE(job.diagnostics().empty());
}

// Once quadratic: 48 s for these.
TEST(HostileLibrary, TwentyThousandEqualNamesAreReadInTime) {
  std::string text = "{\"data\": [";
  for (int i = 0; i < 20000; ++i) {
    text += std::string(i == 0 ? "" : ",") +
            R"({"type":"flat end mill","unit":"millimeters","guid":"g","description":"same",)"
            R"("geometry":{"DC":6,"NOF":3,"LCF":20,"OAL":60},"post-process":{"number":1}})";
  }
  Job job;
  const auto begin = std::chrono::steady_clock::now();
  const auto read = tooling::fusion_json_format().read(text + "], \"version\": 1}", "a.json", {}, job);
  const std::chrono::duration<double> took = std::chrono::steady_clock::now() - begin;
  ASSERT_TRUE(read) << to_text(read.error());
  EXPECT_EQ(read->library.items.size(), 20000U);
  EXPECT_EQ(read->library.items.back().id, "g (20000)");
  EXPECT_LT(took.count(), 10.0);
}

}  // namespace
}  // namespace capstan

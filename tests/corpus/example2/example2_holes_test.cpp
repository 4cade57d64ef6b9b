#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <regex>

#include "tests/corpus/session.h"

// The holes of the standard's example 2, planned anew: what each member is made by.

namespace capstan::corpus {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

/// Example 2 with its face and its holes alone. HOLE6, which stands on the floor of the step, is lifted to
/// the top, and the iron has its European name.
std::string holes_of_example_2(const std::string& path) {
  std::string text = testing::slurp(path);
  const auto replace = [&](const std::string& what, const std::string& by) {
    text = std::regex_replace(text, std::regex(what), by);
  };
  for (const char* feature : {"62", "64", "66", "123", "124", "125", "126", "199"}) {
    const std::regex step("#([0-9]+)= MACHINING_WORKINGSTEP\\('[^']*',#[0-9]+,#" + std::string(feature) +
                          ",#[0-9]+,\\$\\);");
    for (std::smatch found; std::regex_search(text, found, step);) {
      const std::string id = found[1];
      replace("#" + id + "= MACHINING_WORKINGSTEP[^\n]*\n", "");
      replace("([(,])#" + id + ",", "$1");
      replace(",#" + id + "\\)", ")");
    }
    replace("#" + std::string(feature) + "= [A-Z_]+\\([^\n]*\n", "");
  }
  replace("\\(245\\.,110\\.,-20\\.\\)", "(245.,110.,0.)");
  replace("MATERIAL\\('FC200'", "MATERIAL('EN-GJL-200'");
  return text;
}

/// What is done to each member of each compound, in its order: "HOLE2[1]" and the actions.
std::map<std::string, std::vector<std::string>> made(const model::Plan& plan) {
  std::map<std::string, std::vector<std::string>> out;
  const std::regex name("(HOLE[0-9]\\[[0-9]\\]) ([a-z_]+)");
  for (const std::string& id : step_ids(plan)) {
    std::smatch found;
    if (std::regex_search(id, found, name)) out[found[1]].push_back(found[2]);
  }
  return out;
}

class CorpusExample2Holes : public ::testing::Test {
 protected:
  static const Session& session(const std::string& path) {
    static const Session kSession =
        planned_bytes(holes_of_example_2(path), "fdis_ex2_holes.p21", Reopen::kAll, 2);
    return kSession;
  }
};

TEST_F(CorpusExample2Holes, AreEachPlannedByTheChainThatAMachinistWouldTake) {
  CAPSTAN_CORPUS_FILE(path, "iso14649/fdis_ex2_mended.p21");
  const Session& s = session(path);
  EXPECT_THAT(reasons_unplanned(s.plan), IsEmpty());
  auto chains = made(s.plan);
  // 40 H7 through: drilled in two steps that 48 Nm turn, opened by an end mill, bored. Its edge is
  // toleranced. Carbide drills start by their own points: no spot before them up to five diameters.
  EXPECT_THAT(chains["HOLE1[1]"], ElementsAre("pilot", "pilot", "mill_rough", "bore"));
  EXPECT_THAT(chains["HOLE1[2]"], ElementsAre("countersink_mill"));
  for (const std::string hole : {"HOLE2", "HOLE3"}) {
    EXPECT_THAT(chains[hole + "[1]"], ElementsAre("mill_rough", "mill_finish", "bore")) << "25 IT7 over 15";
    EXPECT_THAT(chains[hole + "[2]"], ElementsAre("drill", "ream"));
    EXPECT_THAT(chains[hole + "[3]"], ElementsAre("countersink_mill", "countersink_mill"));
  }
  EXPECT_THAT(chains["HOLE4[1]"], ElementsAre("drill", "ream"));
  EXPECT_THAT(chains["HOLE4[2]"], ElementsAre("countersink_mill", "countersink_mill"));
  // 8.3 IT8 has no reamer; the thread's length lies in its core; the cone's foot is wider than the core.
  EXPECT_THAT(chains["HOLE5[1]"], ElementsAre("drill", "bore"));
  EXPECT_EQ(chains.count("HOLE5[2]"), 0U);
  EXPECT_THAT(chains["HOLE5[3]"], ElementsAre("taper_rough", "countersink_mill", "countersink_mill"));
  EXPECT_THAT(chains["HOLE6[1]"], ElementsAre("drill", "ream"));
  EXPECT_THAT(chains["HOLE6[2]"], ElementsAre("countersink_mill", "countersink_mill"));
}

TEST_F(CorpusExample2Holes, HaveNothingFoundAgainstThem) {
  CAPSTAN_CORPUS_FILE(path, "iso14649/fdis_ex2_mended.p21");
  CAPSTAN_NEEDS_RS274();
  const Session& s = session(path);
  EXPECT_THAT(codes(s.bound, Severity::kError), IsEmpty());
  EXPECT_THAT(findings_of_plan(s), IsEmpty()) << all_findings(s);
  EXPECT_THAT(findings_of_program(s), IsEmpty()) << all_findings(s);
  EXPECT_GT(interpreted(s).moves.size(), 50U);
  // The generic machine: 47.7 Nm up to 1500 1/min, of which 85 % reach the tool.
  for (const auto& step : s.plan.steps)
    EXPECT_LE(step.loads.torque_nm, 0.85 * 47.746 * (1.0 + 1e-6)) << model::step_id(s.plan, step);
}

TEST_F(CorpusExample2Holes, AreOpenedBeforeAnyOfThemHasItsSize) {
  CAPSTAN_CORPUS_FILE(path, "iso14649/fdis_ex2_mended.p21");
  const Session& s = session(path);
  std::map<model::AnyRef, std::string> sized;
  for (const auto& step : s.plan.steps) {
    const auto* ws = s.plan.model.get<model::MachiningWorkingstep>(step.step);
    ASSERT_NE(ws, nullptr);
    const bool sizes = s.plan.model.holds<model::BoringOperation>(ws->its_operation);
    const std::string id = model::step_id(s.plan, step);
    EXPECT_TRUE(sizes || !sized.contains(ws->its_feature)) << id << " comes after " << sized[ws->its_feature];
    if (sizes) sized[ws->its_feature] = id;
  }
}

TEST_F(CorpusExample2Holes, SayThatAThreadIsLostWhichOnlyAnOperationMade) {
  CAPSTAN_CORPUS_FILE(path, "iso14649/fdis_ex2_mended.p21");
  EXPECT_THAT(codes(session(path).bound, Severity::kWarning), ::testing::Contains("PIP-THREAD-LOST"));
}

}  // namespace
}  // namespace capstan::corpus

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>

#include "casebase/casebase.h"
#include "tests/door/app/command/command.h"
#include "tests/support/corpus.h"

// `capstan cases tune`, run as a user runs it: a plan's pocket, and parts that were cut after it.

namespace capstan::app {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;

constexpr const char* kStep = "POCKET area_rough";

class CasesTune : public CommandTest {
 protected:
  void SetUp() override {
    CommandTest::SetUp();
    ASSERT_EQ(run("plan '" + capstan::testing::source_dir() + "/examples/bracket.p21' -o plan.json").code, 0);
    ASSERT_EQ(run("cases add simulated.db plan.json").code, 0);
    const auto cases = casebase::from_csv(run("cases export simulated.db").out, "export");
    ASSERT_TRUE(cases);
    for (const casebase::Case& c : *cases) {
      if (c.from.workingstep == kStep) planned_ = c;
      if (c.from.workingstep == "SLOT area_rough") other_ = c;
    }
    ASSERT_GT(planned_.predicted.peak_force_n, 0.0);
  }
  /// A part that was cut as planned, at two fifths of the force and power that planning allows for; three
  /// parts an edge.
  [[nodiscard]] casebase::Case cut(int part, double speed = 1.0, double feed = 1.0) const {
    casebase::Case c = planned_;
    c.origin = casebase::Origin::kMeasured;
    c.id.clear();
    c.observed = {};
    c.bound.vc_m_min *= speed;
    c.bound.fz_mm *= feed;
    c.observed.time_s = casebase::Figure{.value = planned_.predicted.time_s / speed / feed};
    c.observed.peak_force_n = casebase::Figure{.value = 0.4 * planned_.predicted.peak_force_n};
    c.observed.power_w = casebase::Figure{.value = 0.4 * planned_.predicted.power_w * speed};
    c.observed.verdict = casebase::Verdict::kGood;
    c.from.tool_instance = "E" + std::to_string(part / 3);
    c.from.part = std::to_string(part);
    c.from.source = "log";
    c.from.time_utc = "2026-03-0" + std::to_string(1 + part / 8) + "T08:00:00Z";
    return c;
  }
  void keep(const std::vector<casebase::Case>& cases) {
    put("cases.csv", casebase::to_csv(cases));
    const Ran added = run("cases add base.db cases.csv");
    ASSERT_EQ(added.code, 0) << added.err;
  }
  [[nodiscard]] static nlohmann::json step_of(const std::string& text) {
    const nlohmann::json all = nlohmann::json::parse(text);
    for (const auto& step : all["steps"]) {
      if (step["step"] == kStep) return step;
    }
    return {};
  }
  std::vector<casebase::Case> good(int count) const {
    std::vector<casebase::Case> out;
    for (int i = 0; i < count; ++i) out.push_back(cut(i));
    return out;
  }
  casebase::Case planned_, other_;  ///< other_: a second step, whose cases are not near the first
};

TEST_F(CasesTune, SaysThatTheHandbookHoldsWhereNothingWasCut) {
  const Ran ran = run("cases tune simulated.db plan.json");
  EXPECT_EQ(ran.code, 0) << ran.err;
  EXPECT_THAT(ran.out, HasSubstr(std::string(kStep) + "\n  no case is near: the handbook's values hold"));
}

TEST_F(CasesTune, ProposesATrialWithinTheTrustRegionAndSaysHowSureItIs) {
  keep(good(12));
  const Ran ran = run("cases tune base.db plan.json -o tune.svg");
  EXPECT_EQ(ran.code, 0) << ran.err;
  EXPECT_THAT(ran.out, HasSubstr("12 cases on 4 edges and 2 days"));
  EXPECT_THAT(ran.out, HasSubstr("try next"));
  EXPECT_THAT(ran.out, HasSubstr("cutting force: 12 cases"));
  EXPECT_THAT(slurp(folder_ / "tune.svg"), StartsWith("<svg"));
  const nlohmann::json step = step_of(run("cases tune base.db plan.json --json").out);
  EXPECT_EQ(step["proven"]["vc_m_min"], step["handbook"]["vc_m_min"]);
  EXPECT_LE(step["trial"]["vc_m_min"].get<double>(), 1.16 * planned_.bound.vc_m_min);
  EXPECT_LE(step["trial"]["planner_load_over_limit"].get<double>(), 1.0 + 1e-9);
}

TEST_F(CasesTune, TakesAFasterSettingThatRepeatsHaveProven) {
  std::vector<casebase::Case> cases = good(12);
  for (int i = 12; i < 18; ++i) cases.push_back(cut(i, 1.1));
  keep(cases);
  const nlohmann::json step = step_of(run("cases tune base.db plan.json --json").out);
  EXPECT_NEAR(step["proven"]["vc_m_min"].get<double>(), 1.1 * planned_.bound.vc_m_min, 1e-6);
}

TEST_F(CasesTune, NamesACaseThatIsNotHeardAndWhy) {
  std::vector<casebase::Case> cases = good(12);
  cases.push_back(cut(12, 1.0, 10.0));
  keep(cases);
  const Ran ran = run("cases tune base.db plan.json");
  EXPECT_THAT(ran.out,
              HasSubstr("its feed per tooth is 10 times the handbook's; within a factor of 2 is heard"));
  const nlohmann::json step = step_of(run("cases tune base.db plan.json --json").out);
  EXPECT_LE(step["trial"]["planner_load_over_limit"].get<double>(), 1.0 + 1e-9);
}

TEST_F(CasesTune, DrawsAPictureForEachStepBesideTheFirstsName) {
  std::vector<casebase::Case> cases = good(3);
  planned_ = other_;
  for (const casebase::Case& c : good(3)) cases.push_back(c);
  keep(cases);
  std::filesystem::create_directory(folder_ / "a.folder");
  const Ran ran = run("cases tune base.db plan.json -o a.folder/pic.svg");
  EXPECT_EQ(ran.code, 0) << ran.err;
  EXPECT_THAT(slurp(folder_ / "a.folder" / "pic.svg"), StartsWith("<svg"));
  EXPECT_THAT(slurp(folder_ / "a.folder" / "pic-2.svg"), StartsWith("<svg"));
  // The second cannot be written: neither is.
  std::filesystem::create_directory(folder_ / "b-2.svg");
  EXPECT_NE(run("cases tune base.db plan.json -o b.svg").code, 0);
  EXPECT_FALSE(std::filesystem::exists(folder_ / "b.svg"));
  EXPECT_EQ(run("cases tune base.db plan.json -o c.svg -o d.svg").code, 2);
  for (const char* name : {"t.foo", "pic", "t.png"}) {
    const Ran other = run("cases tune base.db plan.json -o " + std::string(name));
    EXPECT_EQ(other.code, 2) << name;
    EXPECT_THAT(other.err, HasSubstr("OUT-KIND")) << name;
    EXPECT_FALSE(std::filesystem::exists(folder_ / name));
  }
}

TEST_F(CasesTune, DoesNotHearACaseOfAnotherMachine) {
  std::vector<casebase::Case> cases = good(12);
  for (casebase::Case& c : cases) c.asked.machine_class = "another_mill";
  keep(cases);
  EXPECT_EQ(step_of(run("cases tune base.db plan.json --json").out)["cases"], 0);
}

TEST_F(CasesTune, ADayAfterTodayIsNoDay) {
  keep(good(12));
  EXPECT_THAT(run("cases tune base.db plan.json --today 2026-01-01").out,
              HasSubstr("12 cases lie in the future: no day of its own"));
  EXPECT_THAT(run("cases tune base.db plan.json --today 2026-12-01").out, Not(HasSubstr("in the future")));
  EXPECT_EQ(run("cases tune base.db plan.json --today tomorrow").code, 2);
}

TEST_F(CasesTune, WithoutAPlanCorrectsTheModelsAlone) {
  keep(good(12));
  const Ran ran = run("cases tune base.db");
  EXPECT_EQ(ran.code, 0) << ran.err;
  EXPECT_THAT(ran.out, HasSubstr("margin of forces:"));
  EXPECT_THAT(ran.out, Not(HasSubstr(kStep)));
}

}  // namespace
}  // namespace capstan::app

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <vector>

#include "casebase/casebase.h"
#include "planner/door/service/reading.h"
#include "tests/door/app/command/command.h"
#include "tests/support/corpus.h"

// What measured cases expect of the next plan's time and bores: through the whole command.

namespace capstan::app {
namespace {

using casebase::Case;
using ::testing::HasSubstr;
using ::testing::Not;

class CaseModels : public CommandTest {
 protected:
  void SetUp() override {
    CommandTest::SetUp();
    ASSERT_EQ(run("plan '" + part() + "' -o plain.json").code, 0);
    plain_ = plan("plain.json");
    Job job;
    planned_ = casebase::cases_of(plain_, job);
  }
  static std::string part() { return capstan::testing::source_dir() + "/examples/bracket.p21"; }
  model::Plan plan(const std::string& name) {
    Job job;
    auto read = service::read_plan(slurp(folder_ / name), name, job);
    EXPECT_TRUE(read) << name;
    return read ? *std::move(read) : model::Plan{};
  }
  /// The steps of the plan as cut on so many parts in so much of the time planned, a hundredth more each.
  std::vector<Case> timed(int parts, double share) const {
    std::vector<Case> out;
    for (int part = 0; part < parts; ++part) {
      for (Case c : planned_) {
        c.origin = casebase::Origin::kMeasured;
        c.observed = {};
        c.observed.time_s = casebase::Figure{.value = (share + 0.01 * part) * c.predicted.time_s};
        c.from.part = std::to_string(part);
        c.from.source = "log " + std::to_string(share);
        out.push_back(c);
      }
    }
    return out;
  }
  /// The bores that the plan mills, on four parts, so far from the size asked.
  std::vector<Case> bored(double off_mm) const {
    std::vector<Case> out;
    for (int part = 0; part < 4; ++part) {
      for (Case c : planned_) {
        if (!c.asked.operation.ends_with("MILLING") || !(c.asked.diameter_mm > 0.0)) continue;
        c.origin = casebase::Origin::kMeasured;
        c.observed = {};
        c.observed.size_deviation_mm = casebase::Figure{.value = off_mm + 0.001 * part};
        c.from.part = std::to_string(part);
        c.from.source = "gauge " + std::to_string(off_mm);
        out.push_back(c);
      }
    }
    EXPECT_FALSE(out.empty()) << "the bracket mills no bore";
    return out;
  }
  Ran planned_with(const std::vector<Case>& cases) {
    Job job;
    auto base = casebase::CaseBase::open_or_create((folder_ / "base.db").string(), job);
    EXPECT_TRUE(base && base->add(cases));
    return run("plan '" + part() + "' --reopen all --cases base.db -o tuned.json");
  }
  model::Plan plain_;
  std::vector<Case> planned_;
};

TEST_F(CaseModels, TimesOfThreePartsAreToldWithTheirIntervalAndChangeNoPath) {
  Ran ran = planned_with(timed(2, 1.25));
  EXPECT_THAT(ran.err, Not(HasSubstr("CASE-TIME")));
  ran = planned_with(timed(4, 1.25));
  ASSERT_EQ(ran.code, 0) << ran.err;
  EXPECT_THAT(ran.err, HasSubstr("[CASE-TIME]"));
  EXPECT_THAT(ran.err, HasSubstr("of 4 parts measured on this machine"));
  EXPECT_THAT(run("explain tuned.json").out, HasSubstr("steps' time by cases"));
  const model::Plan tuned = plan("tuned.json");
  ASSERT_EQ(tuned.steps.size(), plain_.steps.size());
  for (std::size_t i = 0; i < tuned.steps.size(); ++i)
    EXPECT_EQ(tuned.steps[i].cutting_s, plain_.steps[i].cutting_s);
}

TEST_F(CaseModels, TimesOfCutsThatBrokeChatteredOrWereJudgedBadSayNothing) {
  const auto with = [&](void (*change)(casebase::Observed&)) {
    auto cases = timed(4, 1.25);
    for (Case& c : cases) change(c.observed);
    std::filesystem::remove(folder_ / "base.db");
    return planned_with(cases).err;
  };
  for (const auto change : {+[](casebase::Observed& o) { o.breakage = casebase::Figure{.value = 1.0}; },
                            +[](casebase::Observed& o) { o.chatter = casebase::Figure{.value = 1.0}; },
                            +[](casebase::Observed& o) { o.verdict = casebase::Verdict::kBad; }})
    EXPECT_THAT(with(change), Not(HasSubstr("CASE-TIME")));
  EXPECT_THAT(with([](casebase::Observed&) {}), HasSubstr("CASE-TIME"));
}

TEST_F(CaseModels, TimesOfAnotherMachineSayNothing) {
  auto cases = timed(4, 1.25);
  for (Case& c : cases) c.asked.machine_class = "another_machine";
  const Ran ran = planned_with(cases);
  ASSERT_EQ(ran.code, 0) << ran.err;
  EXPECT_THAT(ran.err, Not(HasSubstr("CASE-TIME")));
}

TEST_F(CaseModels, APlanThatIsPlannedAgainStatesItsTimeOnce) {
  ASSERT_EQ(planned_with(timed(4, 1.25)).code, 0);
  ASSERT_EQ(run("plan tuned.json --reopen all --cases base.db -o again.json").code, 0);
  int stated = 0;
  for (const model::Provenance& p : plan("again.json").provenance) stated += p.what == "steps' time by cases";
  EXPECT_EQ(stated, 1);
}

TEST_F(CaseModels, ABoreThatCasesExpectBeyondItsZoneIsAWarning) {
  const Ran ran = planned_with(bored(2.0));
  EXPECT_THAT(ran.err, HasSubstr("warning: step 'CAP SCREW HOLE"));
  EXPECT_THAT(ran.err, HasSubstr("[CASE-BORE]"));
  EXPECT_THAT(run("explain tuned.json").out, HasSubstr("by cases"));
}

TEST_F(CaseModels, ABoreThatWasJudgedBadForItsSizeIsHeard) {
  auto cases = bored(2.0);
  for (Case& c : cases) c.observed.verdict = casebase::Verdict::kBad;
  EXPECT_THAT(planned_with(cases).err, HasSubstr("[CASE-BORE]"));
}

TEST_F(CaseModels, BoresOfAnotherMaterialOrToolClassSayNothing) {
  for (const bool material : {true, false}) {
    auto cases = bored(2.0);
    for (Case& c : cases)
      (material ? c.asked.material_group : c.asked.tool_class) = material ? "K/grey_iron" : "hss/endmill";
    std::filesystem::remove(folder_ / "base.db");
    EXPECT_THAT(planned_with(cases).err, Not(HasSubstr("CASE-BORE"))) << material;
  }
}

}  // namespace
}  // namespace capstan::app

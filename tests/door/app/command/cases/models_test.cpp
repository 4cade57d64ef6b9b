#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "casebase/casebase.h"
#include "planner/door/service/reading.h"
#include "tests/door/app/command/command.h"
#include "tests/support/corpus.h"

// What measured cases say of the planner's models, in the next plan: through the whole command.

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
  /// The milled steps of the plan as cut on so many edges, with so much of the force expected.
  std::vector<Case> cut(int edges, double share) const {
    std::vector<Case> out;
    for (int edge = 0; edge < edges; ++edge) {
      for (Case c : planned_) {
        if (!(c.predicted.specific_force_n_mm2 > 0.0)) continue;
        c.origin = casebase::Origin::kMeasured;
        c.observed = {};
        const double expected = c.predicted.peak_force_n / c.predicted.force_margin;
        c.observed.peak_force_n = casebase::Figure{.value = share * (1.0 + 0.01 * edge) * expected};
        c.from.tool_instance = "E" + std::to_string(edge);
        c.from.part = std::to_string(edge);
        c.from.source = "log";
        out.push_back(c);
      }
    }
    return out;
  }
  Ran planned_with(const std::vector<Case>& cases) {
    Job job;
    auto base = casebase::CaseBase::open_or_create((folder_ / "base.db").string(), job);
    EXPECT_TRUE(base && base->add(cases));
    return run("plan '" + part() + "' --reopen all --cases base.db -o tuned.json");
  }
  /// Factor of the margin in the forces of a milled step.
  static double margin_of(const model::Plan& plan) {
    for (const model::StepResult& s : plan.steps) {
      if (model::step_id(plan, s) == "POCKET area_rough") return s.loads.force_margin;
    }
    return 0.0;
  }

  model::Plan plain_;
  std::vector<Case> planned_;
};

TEST_F(CaseModels, ForcesThatWereMeasuredReplaceTheCardsAndNarrowTheMargin) {
  const Ran ran = planned_with(cut(6, 0.9));
  ASSERT_EQ(ran.code, 0) << ran.err;
  EXPECT_THAT(ran.err, HasSubstr("[CASE-MODEL]"));
  const model::Plan tuned = plan("tuned.json");
  ASSERT_FALSE(tuned.material.mechanistic.empty());
  EXPECT_THAT(tuned.material.mechanistic.front().source, HasSubstr("on 6 edges"));
  EXPECT_LT(margin_of(tuned), margin_of(plain_));
  const Ran checked = run("check tuned.json");
  EXPECT_EQ(checked.code, 0) << checked.out << checked.err;
  const Ran told = run("explain tuned.json 'POCKET area_rough'");
  EXPECT_THAT(told.out, HasSubstr("cutting force of carbide mills: 0.9"));
  EXPECT_THAT(run("explain tuned.json").out, HasSubstr("cutting force of carbide mills: 0.9"));
}

TEST_F(CaseModels, LargerForcesRaiseThoseOfThePlan) {
  const Ran ran = planned_with(cut(6, 1.4));
  ASSERT_LE(ran.code, 1) << ran.err;
  const model::Plan tuned = plan("tuned.json");
  ASSERT_FALSE(tuned.material.mechanistic.empty());
  ASSERT_FALSE(plain_.material.mechanistic.empty());
  EXPECT_GT(tuned.material.mechanistic.front().ktc_n_mm2,
            1.3 * plain_.material.mechanistic.front().ktc_n_mm2);
}

TEST_F(CaseModels, TwoEdgesNarrowNothing) {
  const Ran ran = planned_with(cut(2, 0.9));
  ASSERT_EQ(ran.code, 0) << ran.err;
  EXPECT_THAT(ran.err, HasSubstr("not taken, for it is measured on 2 edges"));
  EXPECT_EQ(plan("tuned.json").material, plain_.material);
}

TEST_F(CaseModels, AForceTenTimesTooLowIsNamedAndNotTaken) {
  const Ran ran = planned_with(cut(6, 0.1));
  ASSERT_EQ(ran.code, 0) << ran.err;
  EXPECT_THAT(ran.err, HasSubstr("further from the card than 2 standard deviations"));
  EXPECT_EQ(plan("tuned.json").material, plain_.material);
}

TEST_F(CaseModels, TimesOfThreePartsAreToldWithTheirIntervalAndChangeNoPath) {
  const auto timed = [&](int parts) {
    std::vector<Case> out;
    for (int part = 0; part < parts; ++part) {
      for (Case c : planned_) {
        c.origin = casebase::Origin::kMeasured;
        c.observed = {};
        c.observed.time_s = casebase::Figure{.value = (1.25 + 0.01 * part) * c.predicted.time_s};
        c.from.part = std::to_string(part);
        c.from.source = "log";
        out.push_back(c);
      }
    }
    return out;
  };
  Ran ran = planned_with(timed(2));
  EXPECT_THAT(ran.err, Not(HasSubstr("CASE-TIME")));
  ran = planned_with(timed(4));
  ASSERT_EQ(ran.code, 0) << ran.err;
  EXPECT_THAT(ran.err, HasSubstr("[CASE-TIME]"));
  EXPECT_THAT(ran.err, HasSubstr("of 4 parts measured on this machine"));
  EXPECT_THAT(run("explain tuned.json").out, HasSubstr("steps' time by cases"));
  const model::Plan tuned = plan("tuned.json");
  ASSERT_EQ(tuned.steps.size(), plain_.steps.size());
  for (std::size_t i = 0; i < tuned.steps.size(); ++i)
    EXPECT_EQ(tuned.steps[i].cutting_s, plain_.steps[i].cutting_s);
}

TEST_F(CaseModels, ABoreThatCasesExpectBeyondItsZoneIsAWarning) {
  const auto bored = [&](double off_mm) {
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
    return out;
  };
  ASSERT_FALSE(bored(0.5).empty()) << "the bracket mills no bore";
  const Ran ran = planned_with(bored(2.0));
  EXPECT_THAT(ran.err, HasSubstr("warning: step 'CAP SCREW HOLE"));
  EXPECT_THAT(ran.err, HasSubstr("[CASE-BORE]"));
  EXPECT_THAT(run("explain tuned.json").out, HasSubstr("by cases"));
}

TEST_F(CaseModels, ForcesOfAnotherMachineChangeNothing) {
  auto cases = cut(6, 0.9);
  for (Case& c : cases) c.asked.machine_class = "another_machine";
  const Ran ran = planned_with(cases);
  ASSERT_EQ(ran.code, 0) << ran.err;
  EXPECT_THAT(ran.err, Not(HasSubstr("CASE-MODEL")));
  EXPECT_EQ(plan("tuned.json").material, plain_.material);
}

}  // namespace
}  // namespace capstan::app

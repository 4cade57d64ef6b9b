#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <string>
#include <vector>

#include "casebase/casebase.h"
#include "planner/making/step/record/expected_by_cases.h"
#include "planner/physics/motion/time.h"
#include "tests/casebase/sample.h"
#include "tests/door/app/command/cases/case_models.h"

// What measured cases say of the times of steps and of bores, and which cases: through the whole command.

namespace capstan::app {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

using CaseExpected = CaseModels;

TEST_F(CaseExpected, TheTimeOfAStepIsToldBesideItsOwnWithTheCasesAndWhatIsWithoutThem) {
  ASSERT_EQ(planned_with(timed(4, 1.25)).code, 0);
  const model::Plan tuned = plan("tuned.json");
  const std::string step = "POCKET area_rough";
  const auto* row = step::row_of(tuned, step::time_row_of(step));
  ASSERT_NE(row, nullptr);
  const auto planned = std::find_if(planned_.begin(), planned_.end(),
                                    [&](const Case& c) { return c.from.workingstep == step; });
  ASSERT_NE(planned, planned_.end());
  // Its parts took 1.25 to 1.28 times the planned time.
  double s = 0.0;
  ASSERT_EQ(std::sscanf(row->value.c_str(), "%lf s +- ", &s), 1) << row->value;
  EXPECT_GT(s, 1.22 * planned->predicted.time_s);
  EXPECT_LT(s, 1.31 * planned->predicted.time_s);
  const Ran told = run("explain tuned.json '" + step + "'");
  EXPECT_THAT(told.out, HasSubstr("time_by_cases"));
  EXPECT_THAT(told.out, HasSubstr(row->value));
  EXPECT_THAT(told.out,
              HasSubstr("without them " + motion::duration_text(planned->predicted.time_s) + ", as planned"));
  EXPECT_THAT(told.out, HasSubstr("of 4 parts: "));
  // A case by its id and what came of it.
  Job job;
  const auto base = casebase::CaseBase::open((folder_ / "base.db").string(), job);
  ASSERT_TRUE(base);
  bool named = false;
  for (const Case& c : base->cases()) {
    if (c.from.workingstep != step) continue;
    const std::string words = c.id.substr(0, 12) + " (not judged, " +
                              motion::duration_text(c.observed.time_s->value) + " for " +
                              motion::duration_text(c.predicted.time_s) + ")";
    named = named || told.out.find(words) != std::string::npos;
  }
  EXPECT_TRUE(named) << told.out;
  EXPECT_THAT(run("explain tuned.json").out, HasSubstr("by cases"));
  EXPECT_THAT(run("explain tuned.json '" + step + "' time_by_cases").out, HasSubstr(row->value));
}

TEST_F(CaseExpected, StepsUnlikeThoseMeasuredHaveNoTimeByCases) {
  auto cases = timed(4, 1.25);
  std::erase_if(cases, [](const Case& c) { return !c.asked.operation.ends_with("DRILLING"); });
  ASSERT_FALSE(cases.empty());
  ASSERT_EQ(planned_with(cases).code, 0);
  const model::Plan tuned = plan("tuned.json");
  EXPECT_EQ(step::row_of(tuned, step::time_row_of("POCKET area_rough")), nullptr);
  EXPECT_THAT(run("explain tuned.json 'POCKET area_rough'").out, Not(HasSubstr("time_by_cases")));
}

TEST_F(CaseExpected, TimesOfABaseThatLostCasesAreToldWithAWarning) {
  ASSERT_THAT(planned_with(timed(5, 1.25)).err, Not(HasSubstr("CASE-LOST")));
  casebase::tamper((folder_ / "base.db").string(), "DELETE FROM capstan_head WHERE number = 2");
  EXPECT_THAT(run("plan '" + part() + "' --reopen all --cases base.db -o tuned.json").err,
              HasSubstr("times and bores by cases are those of the cases that are left"));
}

TEST_F(CaseExpected, ABoreIsToldWithTheCasesAndWhatIsWithoutThem) {
  ASSERT_LE(planned_with(bored(0.01)).code, 1);
  const model::Plan tuned = plan("tuned.json");
  const std::string step = bore_of(tuned).from.workingstep;
  const Ran told = run("explain tuned.json '" + step + "' bore_by_cases");
  EXPECT_THAT(told.out, HasSubstr("without them +0.000 mm, the middle of its zone"));
  EXPECT_THAT(told.out, HasSubstr("of 4 parts: "));
  EXPECT_THAT(told.out, HasSubstr("(not judged, +0.01"));
}

}  // namespace
}  // namespace capstan::app

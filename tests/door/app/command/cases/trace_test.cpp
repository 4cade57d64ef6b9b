#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "casebase/casebase.h"
#include "tests/door/app/command/cases/case_models.h"

// Which cases `capstan cases trace` shows of a plan, through the whole command.

namespace capstan::app {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

using CasesOfPlan = CaseModels;

TEST_F(CasesOfPlan, AreCountedWhereAnotherPlanWasCutByOfThePartsThatAreAskedFor) {
  std::vector<Case> cases = timed(1, 1.0);  // of part 0
  ASSERT_FALSE(cases.empty());
  Case other = cases.front();
  other.from.plan_hash = "0123456789abcdef";
  other.from.part = "4";
  cases.push_back(other);
  Job job;
  auto base = casebase::CaseBase::open_or_create((folder_ / "base.db").string(), job);
  ASSERT_TRUE(base && base->add(cases));
  EXPECT_THAT(run("cases trace base.db plain.json").err, HasSubstr("1 case of steps of these names"));
  EXPECT_THAT(run("cases trace base.db plain.json --part 4").err, HasSubstr("CASE-PLAN"));
  EXPECT_THAT(run("cases trace base.db plain.json --part 0").err, Not(HasSubstr("CASE-PLAN")));
}

}  // namespace
}  // namespace capstan::app

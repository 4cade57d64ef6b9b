#pragma once

#include <gtest/gtest.h>

#include "tests/removal/planned.h"
#include "tests/support/rs274.h"

namespace capstan::testing::removal {

/// Every feature is planned, no finding is an error, and the program makes the part.
inline void expect_made(const Part& part) {
  const Outcome o = plan_and_simulate(part);
  ASSERT_TRUE(o.written()) << part.name << ":\n" << o.text();
  EXPECT_EQ(o.plan.unplanned, 0U) << o.text();
  EXPECT_TRUE(o.verdict.agrees()) << part.name << ":\n" << o.text();
  for (const PlanMessage& f : o.plan.findings) EXPECT_NE(f.severity, "error") << f.text;
  EXPECT_GT(o.verdict.steps, 0U);
}

}  // namespace capstan::testing::removal

#define CAPSTAN_MADE(Suite, Claim, part) \
  TEST(Suite, Claim) {                   \
    CAPSTAN_NEEDS_RS274();               \
    expect_made(part);                   \
  }

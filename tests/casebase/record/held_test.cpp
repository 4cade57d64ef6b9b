#include "casebase/record/held.h"

#include <gtest/gtest.h>

namespace capstan::casebase {
namespace {

TEST(HeldLongest, TheValueOfTheMostSecondsIsTheLongestHeld) {
  Held held;
  held.add(600.0, 3.0);
  held.add(900.0, 2.0);
  held.add(20000.0, 1.0);
  held.add(900.0, 2.0);
  EXPECT_NEAR(held.longest().value, 900.0, 1e-9);
  EXPECT_NEAR(held.longest().seconds, 4.0, 1e-12);
}

TEST(HeldLongest, ValuesThatHardlyDifferAreOne) {
  Held held;
  held.add(600.0, 3.0);
  held.add(1000.0, 2.0);
  held.add(1001.0, 2.0);  // 0.1 %
  EXPECT_NEAR(held.longest().value, 1000.5, 1e-9);
}

TEST(HeldLongest, NothingHeldIsZero) { EXPECT_EQ(Held().longest().value, 0.0); }

}  // namespace
}  // namespace capstan::casebase

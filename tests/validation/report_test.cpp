#include "tests/validation/report.h"

#include <gtest/gtest.h>

namespace capstan::validation {
namespace {

TEST(Spread, CountsWhatIsWithinAndKeepsTheSignOfTheWorst) {
  const Spread s = spread_of({0.05, -0.2, 0.1}, 0.1);
  EXPECT_EQ(s.n, 3);
  EXPECT_EQ(s.within, 2);
  EXPECT_DOUBLE_EQ(s.median, 0.1);
  EXPECT_DOUBLE_EQ(s.worst, -0.2);
  EXPECT_EQ(spread_of({}, 0.1).n, 0);
}

TEST(Table, IsWrittenForReadersAndForPlots) {
  const Table t{{"a", "b"}, {{"1", "two words"}}};
  EXPECT_EQ(markdown(t), "| a | b |\n|---|---|\n| 1 | two words |\n");
  EXPECT_EQ(columns(t), "# a b\n1 \"two words\"\n");
}

TEST(Percent, HasASign) {
  EXPECT_EQ(percent(0.123), "+12.3 %");
  EXPECT_EQ(percent(-0.05, 0), "-5 %");
}

}  // namespace
}  // namespace capstan::validation

#include "planner/ground/base/no_number.h"

#include <gtest/gtest.h>

namespace capstan {
namespace {

TEST(NoNumber, SaysWhatIsWrongWithAText) {
  EXPECT_EQ(no_number("ab"), "'ab' is not a number");
  EXPECT_EQ(no_number(""), "'' is not a number");
  EXPECT_EQ(no_number("1e999"), "'1e999' is beyond what a number can be (1.8e308 either way)");
  EXPECT_EQ(no_number("-1E999"), "'-1E999' is beyond what a number can be (1.8e308 either way)");
  EXPECT_EQ(no_number("1e-999"), "'1e-999' is nearer to 0 than a number can be (4.9e-324)");
}

TEST(NoNumber, OutOfRangeWithSomethingBehindIsNoNumberAtAll) {
  EXPECT_EQ(no_number("1e999mm"), "'1e999mm' is not a number");
}

TEST(NoNumber, ShowsTheFirstSixtyLettersOfALongText) {
  EXPECT_EQ(no_number(std::string(500, 'x')), "'" + std::string(60, 'x') + "' is not a number");
}

}  // namespace
}  // namespace capstan

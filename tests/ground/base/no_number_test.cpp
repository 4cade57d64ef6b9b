#include "planner/ground/base/no_number.h"

#include <gtest/gtest.h>

#include <string>

#include "planner/ground/base/number.h"

namespace capstan {
namespace {

TEST(NoNumber, SaysThatATextIsNone) {
  EXPECT_EQ(no_number("ab"), "'ab' is not a number");
  EXPECT_EQ(no_number(""), "'' is not a number");
  EXPECT_EQ(no_number("12 mm"), "'12 mm' is not a number");
  EXPECT_EQ(no_number("1e999x"), "'1e999x' is not a number");
}

TEST(NoNumber, SaysWhichEndOfTheRangeANumberIsBeyond) {
  for (const char* text : {"1e999", "-1e999", "1E309", "+1e400", "1e+999"}) {
    const std::string shown = text[0] == '+' ? text + 1 : text;
    EXPECT_EQ(no_number(text), "'" + shown + "' is beyond what a number can be (1.8e308 either way)");
  }
  for (const char* text : {"1e-999", "-1E-400"})
    EXPECT_EQ(no_number(text), "'" + std::string(text) + "' is nearer to 0 than a number can be (4.9e-324)");
}

TEST(NoNumber, ShowsTheBeginningOfALongText) {
  const std::string text(1000, 'x');
  EXPECT_EQ(no_number(text), "'" + text.substr(0, 60) + "' is not a number");
}

TEST(NoNumber, IsSaidOfWhatTheReaderOfNumbersRefuses) {
  for (const char* text : {"ab", "", "12 mm", "1e999x", "1e999", "-1e999", "1e-999"})
    EXPECT_FALSE(parse_double(text)) << text;
}

}  // namespace
}  // namespace capstan

#include "planner/ground/base/number.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace capstan {
namespace {

TEST(Number, NeverPrintsNegativeZero) {
  EXPECT_EQ(shortest(-0.0), "0");
  EXPECT_EQ(fixed(-0.0004, 3), "0.000");
  EXPECT_EQ(trimmed(-0.0, 4), "0");
  EXPECT_EQ(part21_real(-0.0), "0.");
}

TEST(Number, ShortestReadsBackToTheSameDouble) {
  std::mt19937_64 random(20240501);
  std::uniform_real_distribution<double> mantissa(-1.0, 1.0);
  std::uniform_int_distribution<int> exponent(-300, 300);
  for (int i = 0; i < 20000; ++i) {
    const double value = std::ldexp(mantissa(random), exponent(random));
    ASSERT_EQ(parse_double(shortest(value)), value);
    const std::string real = part21_real(value);
    ASSERT_NE(real.find('.'), std::string::npos) << real;
    ASSERT_EQ(parse_double(real), value) << real;
  }
}

TEST(Number, FixedKeepsAndTrimmedDropsTrailingZeros) {
  EXPECT_EQ(fixed(1.5, 3), "1.500");
  EXPECT_EQ(trimmed(1.5, 3), "1.5");
  EXPECT_EQ(trimmed(100.0, 3), "100");
  EXPECT_EQ(rounded(1.23456, 3), 1.235);
}

TEST(Number, UnconvertedGivesBackTheDecimalThatWasRead) {
  // 0.04 m/s is 2400 mm/min; dividing naively need not give back 0.04.
  for (int thousandth = 1; thousandth < 5000; ++thousandth) {
    const double read = thousandth / 1000.0;
    for (const double factor : {60000.0, 60.0, 0.017453292519943295}) {
      EXPECT_EQ(unconverted(read * factor, factor), read) << read << " x " << factor;
    }
  }
}

TEST(Number, RefusesWhatIsNotExactlyOneFiniteNumber) {
  for (const char* text : {"", "x", "1 ", "1e400", "nan", "inf", "1,5", "--1"}) {
    EXPECT_FALSE(parse_double(text)) << text;
  }
}

}  // namespace
}  // namespace capstan

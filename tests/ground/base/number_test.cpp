#include "planner/ground/base/number.h"

#include <gtest/gtest.h>

#include <array>
#include <charconv>
#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "planner/ground/base/append_number.h"

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

TEST(Number, ShortestIsThatOfTheStandardLibrary) {
  std::mt19937_64 random(20261124);
  const auto standard = [](double v) {
    std::array<char, 40> buffer{};
    return std::string(buffer.data(), std::to_chars(buffer.data(), buffer.data() + buffer.size(), v).ptr);
  };
  for (int i = 0; i < 200000; ++i) {
    // Decimals of 0 to 8 places and up to 12 digits, and their neighbours.
    const double ten = std::pow(10.0, static_cast<double>(random() % 9));
    const auto digits = static_cast<double>(random() % (std::uint64_t{1} << (random() % 41)));
    const double value = (random() % 2 == 0 ? 1.0 : -1.0) * digits / ten;
    for (const double v : {value, std::nextafter(value, 1e300), std::nextafter(value, -1e300)}) {
      if (v != 0.0) {
        ASSERT_EQ(shortest(v), standard(v));
      }
      std::string out = "x";
      append_part21_real(out, v);
      ASSERT_EQ(out, "x" + part21_real(v));
    }
  }
  for (const double v : {1e-3, 0.00099999, 99999.999999, 1e5, 123456.0, 1e15, 5e-324, 0.1 + 0.2})
    EXPECT_EQ(shortest(v), standard(v));
  EXPECT_EQ(part21_real(1e30), "1.E+30");
  EXPECT_EQ(part21_real(1.5e-30), "1.5E-30");
}

TEST(Number, ManyAreAppendedAsOneByOne) {
  std::mt19937_64 random(20261128);
  std::vector<double> values;
  std::string wanted = "(";
  for (int i = 0; i < 1000; ++i) {
    std::string out = "(";
    append_part21_reals(out, values);
    ASSERT_EQ(out, wanted) << i << " numbers";
    // Of every length that a number has, the longest among them.
    const double ten = std::pow(10.0, static_cast<double>(random() % 9));
    const auto digits = static_cast<double>(random() % 100000000);
    values.push_back(i % 3 == 0 ? -1.7976931348623157e+308 / ten : digits / ten);
    wanted += (i == 0 ? "" : ",") + part21_real(values.back());
  }
}

TEST(Number, FixedKeepsAndTrimmedDropsTrailingZeros) {
  EXPECT_EQ(fixed(1.5, 3), "1.500");
  EXPECT_EQ(trimmed(1.5, 3), "1.5");
  EXPECT_EQ(trimmed(100.0, 3), "100");
  EXPECT_EQ(rounded(1.23456, 3), 1.235);
}

// Ties and their neighbours, decimals of few digits, and any number: what is quick has to give the very same.
TEST(Number, FixedAndRoundedAreThoseOfTheStandardLibrary) {
  std::mt19937_64 random(20261125);
  const auto standard = [](double v, int decimals) {
    std::array<char, 400> buffer{};
    std::string out(buffer.data(), std::to_chars(buffer.data(), buffer.data() + buffer.size(), v,
                                                 std::chars_format::fixed, decimals)
                                       .ptr);
    if (out.front() == '-' && out.find_first_not_of("-0.") == std::string::npos) out.erase(0, 1);
    return out;
  };
  const auto holds = [&](double v) {
    for (int decimals = 0; decimals <= 14; ++decimals) {
      const std::string wanted = standard(v, decimals);
      ASSERT_EQ(fixed(v, decimals), wanted) << decimals << " decimals of " << shortest(v);
      const double back = rounded(v, decimals);
      ASSERT_EQ(back, parse_double(wanted)) << decimals << " decimals of " << shortest(v);
      ASSERT_FALSE(std::signbit(back) && back == 0.0);
    }
  };
  for (int i = 0; i < 20000; ++i) {
    const double sign = random() % 2 == 0 ? 1.0 : -1.0;
    const double ten = std::pow(10.0, static_cast<double>(random() % 9));
    const auto digits = static_cast<double>(random() % (std::uint64_t{1} << (random() % 50)));
    const double tie = sign * (digits + 0.5) / ten, decimal = sign * digits / ten;
    const double binary_tie = sign * (2.0 * digits + 1.0) / static_cast<double>(2U << (random() % 12));
    const double any =
        std::ldexp(sign * static_cast<double>(random() % 1000003), static_cast<int>(random() % 80) - 60);
    for (const double v : {tie, decimal, binary_tie, any}) {
      for (const double near : {v, std::nextafter(v, 1e300), std::nextafter(v, -1e300)}) holds(near);
      if (HasFatalFailure()) return;
    }
  }
  for (const double v : {0.0, -0.0, 5e-324, -5e-324, 999999999999999.0, 1e15, 1e15 + 0.5, 1e17, -1e300})
    holds(v);
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

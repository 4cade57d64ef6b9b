#include <gtest/gtest.h>

#include <cmath>

#include "planner/model/features/fit/deviation.h"
#include "planner/model/features/fit/fit.h"

namespace capstan::model {
namespace {

TEST(Fit, RefusesWhatTheStandardDoesNotStateNamingWhatItDoes) {
  const auto why = [](double nominal_mm, const char* name) {
    const auto d = fit(nominal_mm, name);
    EXPECT_FALSE(d) << nominal_mm << name;
    if (d) return std::string();
    EXPECT_EQ(d.error().code, "MDL-FIT");
    return d.error().expected;
  };
  EXPECT_EQ(why(20.0, "t6"), "t is stated above 24 mm up to 3150 mm");
  EXPECT_EQ(why(14.0, "V7"), "V is stated above 14 mm up to 500 mm");
  EXPECT_EQ(why(600.0, "c11"), "c is stated above 0 mm up to 500 mm");
  EXPECT_EQ(why(600.0, "j6"), "j is stated above 0 mm up to 500 mm");
  EXPECT_EQ(why(1.0, "a11"), "a is stated above 1 mm up to 500 mm");
  EXPECT_EQ(why(1.0, "N9"), "above 1 mm only");
  EXPECT_EQ(why(1.0, "H14"), "above 1 mm only");
  EXPECT_EQ(why(0.0, "H7"), "ISO 286 speaks of sizes above 0 up to 3150 mm");
  EXPECT_EQ(why(std::nan(""), "H7"), "ISO 286 speaks of sizes above 0 up to 3150 mm");
  EXPECT_EQ(why(HUGE_VAL, "g6"), "ISO 286 speaks of sizes above 0 up to 3150 mm");
  EXPECT_EQ(why(4000.0, "H7"), "ISO 286 speaks of sizes above 0 up to 3150 mm");
  EXPECT_EQ(why(600.0, "H01"), "IT01 is stated up to 500 mm");
  EXPECT_EQ(why(20.0, "J9"), "J is stated for IT6 to IT8");
  EXPECT_EQ(why(20.0, "j8"), "j is stated for IT5 to IT7, and for IT8 up to 3 mm");
  EXPECT_EQ(why(20.0, "K9"), "K is stated to IT8, above that up to 3 mm only");
  EXPECT_EQ(why(20.0, "P2"), "the value delta that raises P is stated from IT3");
  for (const char* name :
       {"", "H", "7", "H19", "H07", "h-7", "L7", "i6", "Q7", "Js9", "H7/g6", "H7g6", "H 7"}) {
    const auto d = fit(20.0, name);
    ASSERT_FALSE(d) << name;
    EXPECT_EQ(d.error().code, "MDL-FIT");
    EXPECT_NE(d.error().message.find(name), std::string::npos);
  }
}

TEST(Fit, NamesAreReadAsTheyAreWritten) {
  for (const double end : {8.0, 40.0, 600.0}) {
    for (int grade = kFinestGrade; grade <= kCoarsestGrade; ++grade) {
      for (const auto letter : fit_letters()) {
        for (const bool hole : {true, false}) {
          const FitClass c{letter, hole, grade};
          const auto again = parse_fit(to_text(c));
          ASSERT_TRUE(again) << to_text(c);
          EXPECT_EQ(to_text(*again), to_text(c));
          EXPECT_EQ(fit(end, c).has_value(), fit(end, to_text(c)).has_value());
        }
      }
    }
  }
  EXPECT_EQ(to_text(*parse_fit(" ZC01 ")), "ZC01");
}

}  // namespace
}  // namespace capstan::model

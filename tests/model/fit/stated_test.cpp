#include "planner/model/features/fit/stated.h"

#include <gtest/gtest.h>

#include <cmath>

#include "planner/model/features/fit/deviation.h"
#include "planner/model/nouns/support.h"

namespace capstan::model {
namespace {

PlusMinusValue plus_minus(double upper_mm, double lower_mm) {
  PlusMinusValue t;
  t.upper_limit = upper_mm;
  t.lower_limit = lower_mm;
  return t;
}

LimitsAndFits numbers(double deviation_mm, double grade, std::optional<FittingType> type) {
  LimitsAndFits t;
  t.deviation = deviation_mm;
  t.grade = grade;
  if (type) t.its_fitting_type = *type;
  return t;
}
constexpr auto kHole = FittingType::kHole;
constexpr auto kShaft = FittingType::kShaft;

LimitsAndFits letters(const char* letter, const char* zone, const char* grade) {
  LimitsAndFits t;
  t.form_variance = letter;
  t.zone_variance = zone;
  t.tolerance_grade = grade;
  return t;
}

void expect_zone(const Result<std::optional<Deviations>>& r, double lower_mm, double upper_mm) {
  ASSERT_TRUE(r) << to_text(r.error());
  ASSERT_TRUE(*r);
  EXPECT_NEAR((*r)->lower_mm, lower_mm, 1e-12);
  EXPECT_NEAR((*r)->upper_mm, upper_mm, 1e-12);
}

void expect_refused(const Result<std::optional<Deviations>>& r, const char* says) {
  ASSERT_FALSE(r) << (*r ? (*r)->lower_mm : 0.0) << " " << (*r ? (*r)->upper_mm : 0.0);
  EXPECT_EQ(r.error().code, "MDL-TOLERANCE");
  EXPECT_NE(r.error().message.find(says), std::string::npos) << r.error().message;
}

TEST(PlusMinus, LowerLimitIsSubtracted) {
  expect_zone(stated(plus_minus(0.1, 0.05)), -0.05, 0.1);
  expect_zone(stated(plus_minus(0.021, 0.0)), 0.0, 0.021);
  expect_zone(stated(plus_minus(0.0, 0.021)), -0.021, 0.0);
}

TEST(PlusMinus, IntervalsBesideNominalAreReadAsTheyLie) {
  expect_zone(stated(plus_minus(-0.020, 0.041)), -0.041, -0.020);  // f7 at 20 mm
  expect_zone(stated(plus_minus(0.035, -0.022)), 0.022, 0.035);    // p6 at 20 mm
}

TEST(PlusMinus, ALowerDeviationInPlaceOfTheLimitIsToldByTheEmptyReading) {
  expect_zone(stated(plus_minus(-0.020, -0.041)), -0.041, -0.020);
  expect_zone(stated(plus_minus(0.1, -0.1)), -0.1, 0.1);
  expect_zone(stated(plus_minus(0.1, -0.3)), -0.3, 0.1);
}

TEST(PlusMinus, NoWidthIsRefused) {
  expect_refused(stated(plus_minus(0.0, 0.0)), "no width");
  expect_refused(stated(plus_minus(-0.02, 0.02)), "no width");
  expect_refused(stated(plus_minus(-0.1, -0.1)), "no width");
  expect_refused(stated(plus_minus(-0.02, 0.01)), "ends at -0.02 mm and begins at -0.01 mm");
  expect_refused(stated(plus_minus(-0.02, -0.01)), "ends at -0.02 mm");
  expect_refused(stated(plus_minus(std::nan(""), 0.1)), "no finite number");
}

TEST(PlusMinus, HalfAToleranceIsRefusedAndNoneIsNone) {
  PlusMinusValue t;
  t.significant_digits = 3;
  EXPECT_FALSE(*stated(t));
  t.upper_limit = 0.1;
  expect_refused(stated(t), "no lower limit");
  t.lower_limit = 0.1;
  t.upper_limit = {};
  expect_refused(stated(t), "no upper limit");
}

TEST(Fits, DeviationZeroIsHOfAHoleAndLowerCaseHOfAShaft) {
  expect_zone(stated(20.0, numbers(0.0, 0.021, kHole)), 0.0, 0.021);
  expect_zone(stated(20.0, numbers(0.0, 0.021, kShaft)), -0.021, 0.0);
  expect_zone(stated(20.0, numbers(0.0, 7.0, kHole)), 0.0, 0.021);  // the grade's number
  expect_refused(stated(20.0, numbers(0.0, 0.021, {})), "above or below");
}

TEST(Fits, TheClassTellsWhichLimitTheDeviationIs) {
  expect_zone(stated(20.0, numbers(-0.020, 0.021, kShaft)), -0.041, -0.020);  // f7
  expect_zone(stated(20.0, numbers(0.020, 0.021, kHole)), 0.020, 0.041);      // F7
  expect_zone(stated(20.0, numbers(0.006, 0.021, kHole)), -0.015, 0.006);     // K7, across nominal
  expect_zone(stated(20.0, numbers(0.002, 0.013, kShaft)), 0.002, 0.015);     // k6
  expect_zone(stated(20.0, numbers(-0.004, 0.013, kShaft)), -0.004, 0.009);   // j6, across nominal
  expect_zone(stated(20.0, numbers(0.022, 6.0, kShaft)), 0.022, 0.035);       // p6
  expect_zone(stated(20.0, numbers(-0.014, 0.021, kHole)), -0.035, -0.014);   // P7
  expect_zone(stated(20.0, numbers(0.0105, 0.021, kHole)), -0.0105, 0.0105);  // JS7
  expect_zone(stated(20.0, numbers(-0.020, 0.021, {})), -0.041, -0.020);      // f7 and R7 alike
}

TEST(Fits, EveryClassIsFoundByItsNumbersOrRefused) {
  int read = 0, refused = 0;
  for (const double size : {2.5, 5.0, 20.0, 70.0, 190.0, 300.0, 490.0}) {
    for (const auto letter : fit_letters()) {
      for (const bool hole : {true, false}) {
        for (int grade = 5; grade <= 11; ++grade) {
          const FitClass c{letter, hole, grade};
          const auto zone = fit(size, c);
          if (!zone) continue;
          const bool lower = hole == (letter[0] <= 'h');
          const double deviation = lower ? zone->lower_mm : zone->upper_mm;
          if (deviation == 0.0) continue;  // H and h by definition, whatever else hangs there
          const auto r = stated(size, numbers(deviation, zone->width(), hole ? kHole : kShaft));
          if (r) {
            expect_zone(r, zone->lower_mm, zone->upper_mm);
            ++read;
          } else {
            EXPECT_NE(r.error().message.find(" or "), std::string::npos) << r.error().message;
            ++refused;
          }
        }
      }
    }
  }
  EXPECT_GT(read, 1500);
  EXPECT_LT(refused, read / 30) << "pairs such as 20 F8 and 20 J8, whose numbers are the same";
}

TEST(Fits, TwoReadingsAreRefused) {
  // J6 and G6 of 3 mm: +2 is the one's upper and the other's lower limit.
  expect_refused(stated(2.5, numbers(0.002, 0.006, kHole)), "G6 or J6");
  // No class: above nominal or across it.
  expect_refused(stated(20.0, numbers(0.010, 0.050, kHole)),
                 "may be 0.01 mm to 0.06 mm or -0.04 mm to 0.01 mm");
  // 1 mm is IT14 of 150 mm, and 1 is IT1.
  expect_refused(stated(150.0, numbers(0.1, 1.0, kHole)), "both IT1 and the width of IT14");
}

TEST(Fits, OutsideTheClassesTheDeviationIsTheLimitNearerToNominal) {
  expect_zone(stated(20.0, numbers(0.030, 0.050, kHole)), 0.030, 0.080);
  expect_zone(stated(20.0, numbers(-0.030, 0.050, kShaft)), -0.080, -0.030);
  expect_zone(stated(20.0, numbers(0.0, 0.050, kHole)), 0.0, 0.050);
}

TEST(Fits, WhatIsNoGradeIsRefused) {
  expect_refused(stated(20.0, numbers(0.0, 0.0, kHole)), "grade of a fit is 0");
  expect_refused(stated(20.0, numbers(0.0, -7.0, kHole)), "grade of a fit is -7");
  expect_refused(stated(20.0, numbers(0.0, 177.8, kHole)), "grade of a fit is 177.8");  // 7, taken for inches
  expect_refused(stated(0.0, numbers(0.0, 7.0, kHole)), "a fit at 0 mm");
  expect_refused(stated(HUGE_VAL, numbers(0.0, 7.0, kHole)), "not finite");
  LimitsAndFits t;
  t.its_fitting_type = kHole;
  EXPECT_FALSE(*stated(20.0, t)) << "says nothing";
  t.grade = 7.0;
  expect_refused(stated(20.0, t), "no deviation");
}

TEST(Fits, LettersNameTheClass) {
  expect_zone(stated(20.0, letters("H", "hole", "7")), 0.0, 0.021);
  expect_zone(stated(20.0, letters("f", "shaft", "IT7")), -0.041, -0.020);
  expect_zone(stated(20.0, letters("N9", "", "")), -0.052, 0.0);
  LimitsAndFits t;
  t.form_variance = "H";
  t.grade = 0.021;
  expect_zone(stated(20.0, t), 0.0, 0.021);
  t.grade = 7.0;
  expect_zone(stated(20.0, t), 0.0, 0.021);
  t.deviation = 0.021;  // its upper limit
  expect_zone(stated(20.0, t), 0.0, 0.021);
}

TEST(Fits, PartsThatContradictEachOtherAreRefused) {
  expect_refused(stated(20.0, letters("H", "shaft", "7")), "H7 is a hole's, stated of a shaft");
  auto t = letters("H", "hole", "7");
  t.its_fitting_type = kShaft;
  expect_refused(stated(20.0, t), "a hole's and a shaft's at once");
  t = letters("H", "hole", "7");
  t.deviation = 0.5;
  expect_refused(stated(20.0, t), "its deviation stated as 0.5 mm");
  t = letters("H", "hole", "");
  expect_refused(stated(20.0, t), "has no grade");
  t.grade = 0.022;
  expect_refused(stated(20.0, t), "has the width 0.022 mm");
  EXPECT_EQ(stated(20.0, letters("t", "shaft", "6")).error().code, "MDL-FIT");
  EXPECT_EQ(stated(20.0, letters("Q", "hole", "6")).error().code, "MDL-FIT");
}

}  // namespace
}  // namespace capstan::model

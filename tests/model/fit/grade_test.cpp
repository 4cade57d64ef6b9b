#include "planner/model/features/fit/grade.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

namespace capstan::model {
namespace {

// The upper ends of the thirteen size ranges to 500 mm, each included in its range.
constexpr std::array<double, 13> kEnds = {3, 6, 10, 18, 30, 50, 80, 120, 180, 250, 315, 400, 500};
constexpr std::array<double, 8> kLargeEnds = {630, 800, 1000, 1250, 1600, 2000, 2500, 3150};

TEST(ToleranceGrade, IsWhatGanterPrintsOfDinIso286) {
  // Ganter, "DIN ISO 286, ISO-Fundamental Tolerance series", compendium page 286: micrometres, a row a grade.
  constexpr std::array<std::array<double, 13>, 20> kPrinted = {{
      {0.3, 0.4, 0.4, 0.5, 0.6, 0.6, 0.8, 1, 1.2, 2, 2.5, 3, 4},
      {0.5, 0.6, 0.6, 0.8, 1, 1, 1.2, 1.5, 2, 3, 4, 5, 6},
      {0.8, 1, 1, 1.2, 1.5, 1.5, 2, 2.5, 3.5, 4.5, 6, 7, 8},
      {1.2, 1.5, 1.5, 2, 2.5, 2.5, 3, 4, 5, 7, 8, 9, 10},
      {2, 2.5, 2.5, 3, 4, 4, 5, 6, 8, 10, 12, 13, 15},
      {3, 4, 4, 5, 6, 7, 8, 10, 12, 14, 16, 18, 20},
      {4, 5, 6, 8, 9, 11, 13, 15, 18, 20, 23, 25, 27},
      {6, 8, 9, 11, 13, 16, 19, 22, 25, 29, 32, 36, 40},
      {10, 12, 15, 18, 21, 25, 30, 35, 40, 46, 52, 57, 63},
      {14, 18, 22, 27, 33, 39, 46, 54, 63, 72, 81, 89, 97},
      {25, 30, 36, 43, 52, 62, 74, 87, 100, 115, 130, 140, 155},
      {40, 48, 58, 70, 84, 100, 120, 140, 160, 185, 210, 230, 250},
      {60, 75, 90, 110, 130, 160, 190, 220, 250, 290, 320, 360, 400},
      {100, 120, 150, 180, 210, 250, 300, 350, 400, 460, 520, 570, 630},
      {140, 180, 220, 270, 330, 390, 460, 540, 630, 720, 810, 890, 970},
      {250, 300, 360, 430, 520, 620, 740, 870, 1000, 1150, 1300, 1400, 1550},
      {400, 480, 580, 700, 840, 1000, 1200, 1400, 1600, 1850, 2100, 2300, 2500},
      {600, 750, 900, 1100, 1300, 1600, 1900, 2200, 2500, 2900, 3200, 3600, 4000},
      {1000, 1200, 1500, 1800, 2100, 2500, 3000, 3500, 4000, 4600, 5200, 5700, 6300},
      {1400, 1800, 2200, 2700, 3300, 3900, 4600, 5400, 6300, 7200, 8100, 8900, 9700},
  }};
  for (std::size_t row = 0; row < kPrinted.size(); ++row) {
    for (std::size_t k = 0; k < kEnds.size(); ++k) {
      const int grade = static_cast<int>(row) + kFinestGrade;
      const auto t = tolerance_grade(kEnds[k], grade);
      ASSERT_TRUE(t) << grade_name(grade) << " at " << kEnds[k];
      EXPECT_NEAR(1000.0 * *t, kPrinted[row][k], 1e-9) << grade_name(grade) << " at " << kEnds[k];
    }
  }
}

TEST(ToleranceGrade, IsWhatMechguruPrintsAbove500) {
  // mechguru.com, "DIN ISO 286 Standard Tolerance Zone Size Table": IT5 to IT11, mm.
  constexpr std::array<std::array<double, 7>, 8> kPrinted = {{
      {0.032, 0.044, 0.070, 0.110, 0.175, 0.280, 0.440},
      {0.036, 0.050, 0.080, 0.125, 0.200, 0.320, 0.500},
      {0.040, 0.056, 0.090, 0.140, 0.230, 0.360, 0.560},
      {0.047, 0.066, 0.105, 0.165, 0.260, 0.420, 0.660},
      // 1600, IT9: 0.310; the table of an Android program (com.fclongoo.querytolerence) has 0.210, out of its
      // row.
      {0.055, 0.078, 0.125, 0.195, 0.310, 0.500, 0.780},
      {0.065, 0.092, 0.150, 0.230, 0.370, 0.600, 0.920},
      {0.078, 0.110, 0.175, 0.280, 0.440, 0.700, 1.100},
      {0.096, 0.135, 0.210, 0.330, 0.540, 0.860, 1.350},
  }};
  for (std::size_t k = 0; k < kLargeEnds.size(); ++k) {
    for (std::size_t g = 0; g < 7; ++g)
      EXPECT_EQ(tolerance_grade(kLargeEnds[k], static_cast<int>(g) + 5), kPrinted[k][g]) << kLargeEnds[k];
  }
  // IT1 to IT4 and IT12 to IT18: github.com/rustyoldguy/ITRECHNER, passungen.h, and the Android program
  // agree.
  constexpr std::array<std::array<double, 11>, 8> kTwoAgree = {{
      {9, 11, 16, 22, 700, 1100, 1750, 2800, 4400, 7000, 11000},
      {10, 13, 18, 25, 800, 1250, 2000, 3200, 5000, 8000, 12500},
      {11, 15, 21, 28, 900, 1400, 2300, 3600, 5600, 9000, 14000},
      {13, 18, 24, 33, 1050, 1650, 2600, 4200, 6600, 10500, 16500},
      {15, 21, 29, 39, 1250, 1950, 3100, 5000, 7800, 12500, 19500},
      {18, 25, 35, 46, 1500, 2300, 3700, 6000, 9200, 15000, 23000},
      {22, 30, 41, 55, 1750, 2800, 4400, 7000, 11000, 17500, 28000},
      {26, 36, 50, 68, 2100, 3300, 5400, 8600, 13500, 21000, 33000},
  }};
  for (std::size_t k = 0; k < kLargeEnds.size(); ++k) {
    for (std::size_t g = 0; g < 11; ++g) {
      const int grade = static_cast<int>(g) + (g < 4 ? 1 : 8);
      EXPECT_NEAR(1000.0 * tolerance_grade(kLargeEnds[k], grade).value_or(0), kTwoAgree[k][g], 1e-9)
          << grade_name(grade) << " at " << kLargeEnds[k];
    }
  }
}

TEST(ToleranceGrade, EndsWhereTheTableEnds) {
  EXPECT_FALSE(tolerance_grade(0.0, 7));
  EXPECT_FALSE(tolerance_grade(-5.0, 7));
  EXPECT_FALSE(tolerance_grade(3150.1, 7));
  EXPECT_FALSE(tolerance_grade(std::nan(""), 7));
  EXPECT_FALSE(tolerance_grade(20.0, -2));
  EXPECT_FALSE(tolerance_grade(20.0, 19));
  EXPECT_TRUE(tolerance_grade(500.0, kIt01));
  EXPECT_FALSE(tolerance_grade(500.1, kIt01));
  EXPECT_FALSE(tolerance_grade(500.1, kIt0));
  EXPECT_TRUE(tolerance_grade(500.1, 1));
}

TEST(ToleranceGrade, GrowsWithGradeAndSizeAndTenfoldEveryFiveGradesFromIt6) {
  double before_size = 0.0;
  for (int grade = 1; grade <= kCoarsestGrade; ++grade) {
    before_size = 0.0;
    for (const double end : {3.0,   6.0,   10.0,  18.0,  30.0,   50.0,   80.0,   120.0,  180.0,  250.0, 315.0,
                             400.0, 500.0, 630.0, 800.0, 1000.0, 1250.0, 1600.0, 2000.0, 2500.0, 3150.0}) {
      const double t = *tolerance_grade(end, grade);
      EXPECT_GE(t, before_size) << grade_name(grade) << " at " << end;
      before_size = t;
      if (grade > 1) {
        EXPECT_GT(t, *tolerance_grade(end, grade - 1)) << grade_name(grade) << " at " << end;
      }
      // ISO 286-1: above IT6 the tolerances are multiplied by 10 at each fifth step; published values round.
      if (grade >= 11) {
        EXPECT_NEAR(t / *tolerance_grade(end, grade - 5), 10.0, 0.7) << grade_name(grade) << end;
      }
    }
  }
}

TEST(ToleranceGrade, LiesNearTheUnitItIsDerivedFrom) {
  // i = 0.45 cbrt(D) + 0.001 D to 500 mm, I = 0.004 D + 2.1 above, D the geometric mean of the range; IT7 is
  // 16 of them, IT11 100. Rounding stays below 6 %.
  double over = 3.0;
  for (const double end : {6.0,   10.0,  18.0,  30.0,  50.0,   80.0,   120.0,  180.0,  250.0,  315.0,
                           400.0, 500.0, 630.0, 800.0, 1000.0, 1250.0, 1600.0, 2000.0, 2500.0, 3150.0}) {
    const double d = std::sqrt(over * end);
    const double unit = end <= 500.0 ? 0.45 * std::cbrt(d) + 0.001 * d : 0.004 * d + 2.1;
    EXPECT_NEAR(1000.0 * *tolerance_grade(end, 7) / (16.0 * unit), 1.0, 0.06) << end;
    EXPECT_NEAR(1000.0 * *tolerance_grade(end, 11) / (100.0 * unit), 1.0, 0.06) << end;
    over = end;
  }
}

TEST(GradeOf, IsTheCoarsestThatTheWidthHolds) {
  EXPECT_EQ(grade_of(20.0, 0.021), 7);
  EXPECT_EQ(grade_of(20.0, 20.021 - 20.0), 7) << "a difference of decimals";
  EXPECT_EQ(grade_of(20.0, 0.0209), 6);
  EXPECT_EQ(grade_of(20.0, 0.0329), 7);
  EXPECT_EQ(grade_of(20.0, 9.0), 18);
  EXPECT_EQ(grade_of(20.0, 0.0006), kIt01);
  EXPECT_FALSE(grade_of(20.0, 0.0005));
  EXPECT_FALSE(grade_of(20.0, 0.0));
  EXPECT_FALSE(grade_of(0.0, 1.0));
  EXPECT_FALSE(grade_of(4000.0, 1.0));
  EXPECT_FALSE(grade_of(600.0, 0.008)) << "the finest of that size is IT1, 9 micrometres";
  for (const double end : kEnds) {
    for (int grade = kFinestGrade; grade <= kCoarsestGrade; ++grade) {
      EXPECT_EQ(grade_of(end, *tolerance_grade(end, grade)), grade);
      EXPECT_EQ(grade_of_exact(end, *tolerance_grade(end, grade)), grade);
    }
  }
  EXPECT_FALSE(grade_of_exact(20.0, 0.022));
}

TEST(GradeName, IsTheStandards) {
  EXPECT_EQ(grade_name(kIt01), "IT01");
  EXPECT_EQ(grade_name(kIt0), "IT0");
  EXPECT_EQ(grade_name(18), "IT18");
}

}  // namespace
}  // namespace capstan::model

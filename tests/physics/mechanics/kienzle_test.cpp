#include "planner/physics/mechanics/force/kienzle.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "planner/physics/mechanics/constants.h"
#include "tests/support/kienzle_fit.h"

namespace capstan::mechanics {
namespace {

using testing::fit_kienzle;
using testing::SpecificForcePoint;

struct MilledRow {
  const char* name;
  double kc[5];
  double kc11;
  double mc;
};

// [S] the points, [C] the fits. Mitsubishi Materials, technical information, "Cutting power for face
// milling": kc in MPa at feeds of 0.1, 0.2, 0.3, 0.4 and 0.6 mm per tooth; the fit is over the feed, not the
// chip thickness.
constexpr double kFeeds[] = {0.1, 0.2, 0.3, 0.4, 0.6};
constexpr MilledRow kMilled[] = {
    {"mild steel 520", {2200, 1950, 1820, 1700, 1580}, 1442, 0.186},
    {"medium steel 620", {1980, 1800, 1730, 1600, 1570}, 1449, 0.135},
    {"hard steel 720", {2520, 2200, 2040, 1850, 1740}, 1556, 0.212},
    {"CrMo 730", {2540, 2250, 2140, 2000, 1800}, 1671, 0.186},
    {"CrMo 600", {2180, 2000, 1860, 1800, 1670}, 1560, 0.148},
    {"NiCrMo 940", {2000, 1800, 1680, 1600, 1500}, 1382, 0.162},
    {"austenitic 155 HB", {2030, 1970, 1900, 1770, 1710}, 1642, 0.100},
    {"hard cast iron 46 HRC", {3000, 2700, 2500, 2400, 2200}, 2034, 0.171},
    {"grey cast iron 200 HB", {1750, 1400, 1240, 1050, 970}, 803, 0.341},
    {"brass", {1150, 950, 800, 700, 630}, 524, 0.349},
    {"AlMg", {580, 480, 400, 350, 320}, 264, 0.348},
    {"AlSi", {700, 600, 490, 450, 390}, 332, 0.336},
    {"AlZnMgCu", {880, 840, 840, 810, 720}, 718, 0.098},
};

TEST(KienzleFit, ReproducesTheMillingTableOfAToolMaker) {
  for (const MilledRow& row : kMilled) {
    std::vector<SpecificForcePoint> points;
    for (int i = 0; i < 5; ++i) points.push_back({kFeeds[i], row.kc[i]});
    const auto fit = fit_kienzle(points);
    ASSERT_TRUE(fit) << row.name;
    EXPECT_NEAR(fit->work.kc11_n_mm2, row.kc11, 0.51) << row.name;
    EXPECT_NEAR(fit->work.mc, row.mc, 0.00051) << row.name;
    EXPECT_LT(fit->max_relative_error, 0.052) << row.name;  // the worst is AlSi, 5.1 %
  }
}

TEST(KienzleFit, StatesItsLargestError) {
  const auto error = [](const MilledRow& row) {
    std::vector<SpecificForcePoint> points;
    for (int i = 0; i < 5; ++i) points.push_back({kFeeds[i], row.kc[i]});
    return fit_kienzle(points)->max_relative_error;
  };
  EXPECT_NEAR(error(kMilled[0]), 0.010, 0.0005);   // mild steel 1.0 %
  EXPECT_NEAR(error(kMilled[8]), 0.044, 0.0005);   // grey cast iron 4.4 %
  EXPECT_NEAR(error(kMilled[12]), 0.049, 0.0005);  // AlZnMgCu 4.9 %
}

struct TurnedRow {
  double kc_kn_mm2[6];
  double kc11;
  double mc;
};

// [S] the points, [C] the fits. Roehm, operating manual RN-1391, p. 43, table 2: kc in kN/mm2 at feeds of
// 0.16 .. 1.6 mm and an edge angle of 45 degrees. The rows' labels did not survive in the copy read; the
// values did.
constexpr double kTurnedFeeds[] = {0.16, 0.25, 0.4, 0.63, 1.0, 1.6};
constexpr TurnedRow kTurned[] = {
    {{2.60, 2.40, 2.20, 2.05, 1.90, 1.80}, 1811, 0.162}, {{3.50, 3.10, 2.75, 2.45, 2.15, 1.95}, 1991, 0.257},
    {{3.05, 2.80, 2.60, 2.40, 2.20, 2.05}, 2085, 0.173}, {{4.35, 3.80, 3.30, 2.90, 2.50, 2.20}, 2272, 0.297},
    {{4.35, 3.90, 3.45, 3.10, 2.75, 2.45}, 2526, 0.250}, {{3.75, 3.30, 2.95, 2.60, 2.30, 2.05}, 2109, 0.262},
    {{3.70, 3.40, 3.10, 2.80, 2.55, 2.35}, 2394, 0.201}, {{5.40, 4.90, 4.40, 4.00, 3.60, 3.30}, 3364, 0.216},
    {{2.30, 2.10, 1.95, 1.80, 1.70, 1.60}, 1610, 0.157}, {{2.55, 2.35, 2.20, 2.05, 1.90, 1.80}, 1817, 0.152},
    {{1.50, 1.35, 1.20, 1.10, 1.00, 0.90}, 922, 0.220},  {{2.05, 1.80, 1.60, 1.45, 1.30, 1.15}, 1186, 0.246},
};

TEST(KienzleFit, ReproducesTheTurningTableOfAChuckMaker) {
  for (const TurnedRow& row : kTurned) {
    std::vector<SpecificForcePoint> points;
    for (int i = 0; i < 6; ++i) {
      points.push_back({kTurnedFeeds[i] * std::sin(std::numbers::pi / 4.0), 1000.0 * row.kc_kn_mm2[i]});
    }
    const auto fit = fit_kienzle(points);
    ASSERT_TRUE(fit);
    EXPECT_NEAR(fit->work.kc11_n_mm2, row.kc11, 0.51);
    EXPECT_NEAR(fit->work.mc, row.mc, 0.00051);
  }
}

TEST(KienzleFit, GivesBackTheLawItWasMadeFrom) {
  const WorkMaterial law{2809.0, 0.24};
  std::vector<SpecificForcePoint> points;
  for (const double h : {0.01, 0.03, 0.2, 1.0}) points.push_back({h, specific_force_n_mm2(law, h)});
  const auto fit = fit_kienzle(points);
  EXPECT_NEAR(fit->work.kc11_n_mm2, law.kc11_n_mm2, 1e-9 * law.kc11_n_mm2);
  EXPECT_NEAR(fit->work.mc, law.mc, 1e-12);
  EXPECT_LT(fit->max_relative_error, 1e-12);
}

TEST(KienzleFit, RefusesWhatDoesNotFixALine) {
  EXPECT_FALSE(fit_kienzle({}));
  EXPECT_FALSE(fit_kienzle({{0.1, 2000.0}}));
  EXPECT_FALSE(fit_kienzle({{0.1, 2000.0}, {0.1, 1900.0}}));
  EXPECT_FALSE(fit_kienzle({{0.1, 2000.0}, {-0.2, 1900.0}}));
  EXPECT_FALSE(fit_kienzle({{0.1, 2000.0}, {0.2, std::numeric_limits<double>::infinity()}}));
}

TEST(CuttingPower, MatchesTheToolMakersWorkedExample) {
  // [S] ap 2, ae 80 mm, vf 280 mm/min, kc 1800 MPa, coefficient 0.8: 1.68 kW.
  const double at_tool = cutting_power_w(2.0 * 80.0 * 280.0, 1800.0);
  EXPECT_NEAR(at_tool / kDefaultSpindleEfficiency, 1680.0, 1e-9);
}

TEST(CuttingPower, MatchesGhoshAndMallikSlabMilling) {
  // [S] the problems (as FOSSEE's programs state them), [C] the powers. Ghosh & Mallik, Manufacturing
  // Science, problems 4.15 to 4.18; specific energy in J/mm3 is kN/mm2.
  const auto power = [](double width, double depth, double feed, WorkMaterial work, double h) {
    return cutting_power_w(depth * width * feed, specific_force_n_mm2(work, h));
  };
  EXPECT_NEAR(power(20, 1, 15, {1400.0, 0.4}, 0.0018), 87.70, 0.005);
  EXPECT_NEAR(power(20, 5, 100, {1400.0, 0.4}, 0.043), 821.5, 0.05);  // the book prints 817 W
  EXPECT_NEAR(power(20, 5, 25, {1400.0, 0.28}, 0.01 / 2.0), 257.2, 0.05);
  EXPECT_NEAR(power(20, 5, 25, {3300.0, 0.0}, 1.0), 137.5, 1e-9);
}

TEST(CuttingPower, IsTheMeanForceTimesTheSpeed) {
  // P = F v / 60, v = pi D n / 1000 m/min; M = F D / 2.
  const WorkMaterial work{2298.0, 0.20};
  const double diameter = 16.0;
  const int teeth = 3;
  const double n = 1800.0;
  const double kc = specific_force_n_mm2(work, 0.04);
  const double from_rate = cutting_power_w(8.0 * 5.0 * 0.07 * teeth * n, kc);
  const double force = mean_tangential_force_n(kc, 8.0, 5.0, 0.07, teeth, diameter);
  EXPECT_NEAR(force * std::numbers::pi * diameter * n / 60e3, from_rate, 1e-9 * from_rate);
  EXPECT_NEAR(spindle_torque_nm(from_rate, n), force * diameter / 2000.0, 1e-9 * force);
}

}  // namespace
}  // namespace capstan::mechanics

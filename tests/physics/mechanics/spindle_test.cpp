#include "planner/physics/mechanics/spindle.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace capstan::mechanics {
namespace {

constexpr double kOmegaPerRpm = 2.0 * std::numbers::pi / 60.0;

TEST(SpindleCurve, IsExactForConstantTorqueAndConstantPower) {
  // 50 Nm up to 1500 1/min, then constant power to 6000.
  const double power = 50.0 * 1500.0 * kOmegaPerRpm;
  const auto curve = SpindleCurve::make({{100.0, 0.0, 50.0}, {1500.0, power, 50.0}, {6000.0, power, 0.0}});
  ASSERT_TRUE(curve);
  for (const double rpm : {100.0, 640.0, 1500.0}) EXPECT_NEAR(curve->at(rpm)->torque_nm, 50.0, 1e-9) << rpm;
  for (const double rpm : {1500.0, 2200.0, 6000.0}) {
    EXPECT_NEAR(curve->at(rpm)->power_w, power, 1e-9) << rpm;
    EXPECT_NEAR(curve->at(rpm)->torque_nm, power / (rpm * kOmegaPerRpm), 1e-9) << rpm;
  }
}

TEST(SpindleCurve, PowerIsAlwaysTorqueTimesSpeed) {
  // A published curve of a small machine, horsepower at four speeds.
  constexpr double kHp = 745.7;
  const auto curve = SpindleCurve::make(
      {{250.0, 0.25 * kHp}, {2050.0, 1.95 * kHp}, {5600.0, 1.1 * kHp}, {7500.0, 0.4 * kHp}});
  ASSERT_TRUE(curve);
  for (double rpm = 250.0; rpm <= 7500.0; rpm += 125.0) {
    const auto c = curve->at(rpm);
    EXPECT_NEAR(c->power_w, c->torque_nm * rpm * kOmegaPerRpm, 1e-9 * c->power_w) << rpm;
  }
  EXPECT_NEAR(curve->at(2050.0)->power_w, 1.95 * kHp, 1e-9);
}

TEST(SpindleCurve, IsNeverExtrapolated) {
  const auto curve = SpindleCurve::make({{250.0, 500.0}, {2000.0, 1500.0}});
  EXPECT_EQ(curve->at(249.999).error().code, "SPINDLE-RANGE");
  EXPECT_EQ(curve->at(2000.001).error().code, "SPINDLE-RANGE");
  EXPECT_FALSE(curve->at(std::nan("")));
}

TEST(SpindleCurve, RefusesPointsThatDoNotRiseOrSayNothing) {
  EXPECT_FALSE(SpindleCurve::make({}));
  EXPECT_FALSE(SpindleCurve::make({{2000.0, 1.0}, {1000.0, 1.0}}));
  EXPECT_FALSE(SpindleCurve::make({{1000.0, 1.0}, {1000.0, 2.0}}));
  EXPECT_FALSE(SpindleCurve::make({{1000.0, 0.0, 0.0}}));
  EXPECT_FALSE(SpindleCurve::make({{1000.0, -5.0, 10.0}}));
}

}  // namespace
}  // namespace capstan::mechanics

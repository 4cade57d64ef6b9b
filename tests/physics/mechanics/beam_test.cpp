#include "planner/physics/mechanics/bending/beam.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "planner/physics/mechanics/bending/deflection.h"
#include "planner/physics/mechanics/constants.h"

namespace capstan::mechanics {
namespace {

constexpr double kPi = std::numbers::pi;

model::Cutter end_mill() {
  model::Cutter c;
  c.cutting_diameter_mm = 12.0;
  c.shank_diameter_mm = 12.0;
  c.maximum_depth_of_cut_mm = 26.0;
  c.stick_out_mm = 40.0;
  c.teeth = 4;
  return c;
}

double moment_mm4(double d) { return kPi * d * d * d * d / 64.0; }

TEST(ToolBeam, OfFlutesAndShankBendsAsTheTwoStepFormula) {
  const ToolBeam beam = beam_of(end_mill()).value();
  const ToolStiffness two_steps{40.0, 12.0, 26.0, 12.0, kCarbideYoungsModulusNMm2};
  EXPECT_NEAR(bending_mm_n(beam, 0.0, 0.0) / *tip_compliance_mm_n(two_steps), 1.0, 1e-12);
}

TEST(ToolBeam, OfOneCylinderHasTheTextbookBending) {
  // F L^3 / (3 E I), I = pi d^4 / 64 [C].
  model::Cutter c = end_mill();
  c.maximum_depth_of_cut_mm = 40.0;
  const ToolBeam beam = beam_of(c).value();
  const double ei = kCarbideYoungsModulusNMm2 * moment_mm4(0.8 * 12.0);
  EXPECT_NEAR(bending_mm_n(beam, 0.0, 0.0), 64000.0 / (3.0 * ei), 1e-15);
  // Force at 10, seen at the tip: the beam above bends, the tip follows straight.
  EXPECT_NEAR(bending_mm_n(beam, 10.0, 0.0), 27000.0 / (3.0 * ei) + 10.0 * 900.0 / (2.0 * ei), 1e-15);
}

// A bar of diameter d is bent by F L^3 / (3 E I) and bears 32 F L / (pi d^3) at its clamp: 2 s L^2 / (3 E d).
// Flutes bend like 0.8 D, their outer fibre lies at D / 2: the bend is that of a bar of the whole diameter.
TEST(EnduringBend, OfOneCylinderHasTheTextbookStress) {
  model::Cutter c = end_mill();
  c.maximum_depth_of_cut_mm = 40.0;
  const double bar = 2.0 * kCarbideEnduranceNMm2 * 40.0 * 40.0 / (3.0 * kCarbideYoungsModulusNMm2 * 12.0);
  EXPECT_NEAR(enduring_bend_mm(c).value() / bar, 1.0, 1e-12);
  c.substrate = model::Substrate::kHss;
  const double hss = 2.0 * kHssEnduranceNMm2 * 40.0 * 40.0 / (3.0 * kHssYoungsModulusNMm2 * 12.0);
  EXPECT_NEAR(enduring_bend_mm(c).value() / hss, 1.0, 1e-12);
}

TEST(EnduringBend, IsThatOfTheWeakestPlace) {
  model::Cutter c = end_mill();
  c.neck_diameter_mm = 5.0;
  c.neck_length_mm = 34.0;
  c.holder = {{20.0, 24.0, 30.0}};
  const double force = kCarbideEnduranceNMm2 * moment_mm4(5.0) / 2.5 / 34.0;  // at the neck's upper end
  const double compliance = bending_mm_n(beam_of(c).value(), 0.0, 0.0);
  EXPECT_NEAR(enduring_bend_mm(c).value(), force * compliance, 1e-12);
}

TEST(EnduringBend, OfLikeToolsIsProportionalToTheirSize) {
  const auto of = [](double d) {
    model::Cutter c;
    c.cutting_diameter_mm = c.shank_diameter_mm = d;
    c.maximum_depth_of_cut_mm = 2.0 * d;
    c.stick_out_mm = 3.0 * d;
    return enduring_bend_mm(c).value();
  };
  EXPECT_NEAR(of(10.0) / of(1.0), 10.0, 1e-9);
  EXPECT_LT(of(1.0), 0.03);  // where 0.1 mm was allowed
}

TEST(ToolBeam, WithANeckAndAHolderIsTheIntegralAlongIt) {
  model::Cutter c = end_mill();
  c.neck_diameter_mm = 11.0;
  c.neck_length_mm = 34.0;
  c.holder = {{20.0, 24.0, 30.0}, {30.0, 40.0, 40.0}};
  const ToolBeam beam = beam_of(c).value();
  for (const double a : {0.0, 7.0, 30.0}) {
    for (const double b : {0.0, 12.0, 50.0}) {
      double sum = 0.0;
      constexpr int kSteps = 90000;
      for (int i = 0; i < kSteps; ++i) {
        const double x = 90.0 * (i + 0.5) / kSteps;
        if (x < a || x < b) continue;
        const double d = x < 26.0 ? 9.6 : (x < 34.0 ? 11.0 : (x < 40.0 ? 12.0 : (x < 60.0 ? 24.0 : 40.0)));
        const double e = x < 40.0 ? kCarbideYoungsModulusNMm2 : kHolderYoungsModulusNMm2;
        sum += (x - a) * (x - b) / (e * moment_mm4(d)) * 90.0 / kSteps;
      }
      EXPECT_NEAR(bending_mm_n(beam, a, b) / sum, 1.0, 1e-3) << a << " " << b;
      EXPECT_DOUBLE_EQ(bending_mm_n(beam, a, b), bending_mm_n(beam, b, a));
    }
  }
}

TEST(ToolBeam, DoesNotMoveAboveItsEnd) {
  EXPECT_EQ(bending_mm_n(beam_of(end_mill()).value(), 41.0, 0.0), 0.0);
}

TEST(ToolBeam, NeedsADiameter) { EXPECT_EQ(beam_of({}).error().path, "cutting_diameter_mm"); }

}  // namespace
}  // namespace capstan::mechanics

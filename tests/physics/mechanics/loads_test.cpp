#include "planner/physics/mechanics/loads/loads.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "planner/physics/mechanics/constants.h"
#include "planner/physics/mechanics/force/immersion.h"

namespace capstan::mechanics {
namespace {

const WorkMaterial kMildSteel{2298.0, 0.20};

MillingCut side_cut() {
  return {.ap_mm = 5.0,
          .ae_mm = 2.0,
          .fz_mm = 0.05,
          .n_rpm = 3000.0,
          .cutting_diameter_mm = 10.0,
          .teeth = 4,
          .helix_rad = 0.5,
          .corner_radius_mm = 0.0,
          .ball = false};
}

ToolStiffness carbide() {
  return {.stickout_mm = 35.0,
          .shank_diameter_mm = 10.0,
          .flute_length_mm = 22.0,
          .cutting_diameter_mm = 10.0,
          .youngs_modulus_n_mm2 = kCarbideYoungsModulusNMm2};
}

TEST(MillingLoads, HangTogether) {
  const auto loads = milling_loads(side_cut(), kMildSteel, carbide());
  ASSERT_TRUE(loads);
  EXPECT_DOUBLE_EQ(loads->mrr_mm3_min, 5.0 * 2.0 * 0.05 * 4 * 3000.0);
  EXPECT_NEAR(loads->h_max_mm, 0.05 * 0.8, 1e-15);            // r = 0.2
  EXPECT_NEAR(loads->h_mean_mm, 0.05 * 0.4314, 0.05 * 5e-5);  // the table of radial thinning
  const double speed = cutting_speed_m_min(3000.0, 10.0);
  EXPECT_NEAR(power_from_force_w(loads->mean_tangential_force_n, speed), loads->power_w, 1e-9);
  EXPECT_NEAR(spindle_torque_nm(loads->power_w, 3000.0), loads->torque_nm, 1e-12);
  EXPECT_NEAR(loads->deflection_mm, loads->peak_force_n * *tip_compliance_mm_n(carbide()), 1e-15);
}

TEST(MillingLoads, GrowWithEveryDimensionOfTheCut) {
  const auto base = *milling_loads(side_cut(), kMildSteel, carbide());
  for (const auto grow : {&MillingCut::ap_mm, &MillingCut::ae_mm, &MillingCut::fz_mm}) {
    MillingCut cut = side_cut();
    cut.*grow *= 1.2;
    const auto more = *milling_loads(cut, kMildSteel, carbide());
    EXPECT_GT(more.power_w, base.power_w);
    EXPECT_GT(more.peak_force_n, base.peak_force_n);
    EXPECT_GT(more.deflection_mm, base.deflection_mm);
  }
}

TEST(MillingLoads, OfABallAreThoseOfACornerOfHalfTheDiameter) {
  MillingCut ball = side_cut();
  ball.ap_mm = 0.4;
  ball.ae_mm = 0.3;
  MillingCut corner = ball;
  ball.ball = true;
  corner.corner_radius_mm = 5.0;
  EXPECT_EQ(*milling_loads(ball, kMildSteel, carbide()), *milling_loads(corner, kMildSteel, carbide()));
}

TEST(MillingLoads, OfAThinChipAskForMoreSpecificForce) {
  MillingCut sharp = side_cut();
  sharp.ap_mm = 1.0;
  MillingCut round = sharp;
  round.corner_radius_mm = 3.0;
  const auto a = *milling_loads(sharp, kMildSteel, carbide());
  const auto b = *milling_loads(round, kMildSteel, carbide());
  EXPECT_LT(b.h_mean_mm, a.h_mean_mm);
  EXPECT_GT(b.power_w, a.power_w);
}

TEST(MillingLoads, ReachTheFullSlotWithoutAJump) {
  MillingCut cut = side_cut();
  cut.ae_mm = 10.0;
  const auto slot = *milling_loads(cut, kMildSteel, carbide());
  cut.ae_mm = 10.0 * (1.0 - 1e-9);
  const auto nearly = *milling_loads(cut, kMildSteel, carbide());
  EXPECT_NEAR(nearly.power_w / slot.power_w, 1.0, 1e-4);
  EXPECT_NEAR(nearly.peak_force_n / slot.peak_force_n, 1.0, 1e-3);
}

TEST(MillingLoads, RefuseByNameWhatIsNotACut) {
  const auto refused = [](MillingCut cut) { return milling_loads(cut, kMildSteel, carbide()).error().path; };
  MillingCut cut = side_cut();
  cut.ae_mm = 10.1;
  EXPECT_EQ(refused(cut), "ae_mm");
  cut = side_cut();
  cut.fz_mm = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(refused(cut), "fz_mm");
  cut = side_cut();
  cut.teeth = 0;
  EXPECT_EQ(refused(cut), "teeth");
  cut = side_cut();
  cut.corner_radius_mm = 5.1;
  EXPECT_EQ(refused(cut), "corner_radius_mm");
  EXPECT_EQ(milling_loads(side_cut(), {2298.0, 1.0}, carbide()).error().path, "mc");
}

Tooth tooth_of(const MillingCut& c) {
  return {.cutting_diameter_mm = c.cutting_diameter_mm,
          .corner_radius_mm = c.ball ? 0.5 * c.cutting_diameter_mm : c.corner_radius_mm,
          .helix_rad = c.helix_rad,
          .teeth = c.teeth};
}

TEST(MillingLoadsByTheLaw, AreThoseOfTheMeanChipWithinWhatTheMeanCosts) {
  MillingCut ball = side_cut();
  ball.ball = true;
  ball.ap_mm = 1.0;
  ball.ae_mm = 2.0;
  for (const MillingCut& cut : {side_cut(), ball}) {
    const auto mean = *milling_loads(cut, kMildSteel, carbide());
    const auto law = *milling_loads(cut, tooth_of(cut), {.kienzle = kMildSteel}, carbide());
    // Kienzle's law on the mean chip is a little dear; a ball has its depth in thinner chips and a rounder
    // strip.
    const double room = cut.ball ? 0.35 : 0.035;
    EXPECT_NEAR(law.power_w / mean.power_w, 1.0, room);
    EXPECT_NEAR(law.peak_force_n / mean.peak_force_n, 1.0, room);
    EXPECT_NEAR(law.h_max_mm / mean.h_max_mm, 1.0, room);
    EXPECT_EQ(law.mrr_mm3_min, mean.mrr_mm3_min);
  }
}

TEST(MillingLoadsByTheLaw, UseMeasuredCoefficients) {
  const ForceLaw law{.mechanistic = CuttingCoefficients{767.01, 27.7, 168.8, 26.6, 222.0, 0.7}};
  const MillingCut cut = side_cut();
  const auto loads = *milling_loads(cut, tooth_of(cut), law, carbide());
  const auto arc = immersion_arc(cut.ae_mm, cut.cutting_diameter_mm, CutDirection::kDown);
  const double edge =
      27.7 * cut.ap_mm * cut.teeth * (arc.exit_rad - arc.entry_rad) / (2.0 * 3.14159265358979);
  const double chip = 767.01 * cut.ap_mm * cut.fz_mm * cut.ae_mm * cut.teeth / (3.14159265358979 * 10.0);
  EXPECT_NEAR(loads.mean_tangential_force_n, chip + edge, 1e-6 * chip);
}

TEST(SideSection, OfABallReachesFromTheScallopToItsCuttingDiameter) {
  const Tooth ball{.cutting_diameter_mm = 10.0, .corner_radius_mm = 5.0, .teeth = 2};
  const double widest = 2.0 * std::sqrt(1.0 * 9.0);  // Deff = 2 sqrt(ap (D - ap)) [C]
  const Section down = side_section(1.0, 2.0, ball, CutDirection::kDown);
  EXPECT_NEAR(-5.0 * std::cos(down.arc.exit_rad), 0.5 * widest, 1e-12);
  EXPECT_NEAR(-5.0 * std::cos(down.arc.entry_rad), -1.0, 1e-12);
  EXPECT_EQ(down.csa_mm2, 2.0);
  const Section up = side_section(1.0, 2.0, ball, CutDirection::kUp);
  EXPECT_NEAR(5.0 * std::cos(up.arc.entry_rad), 0.5 * widest, 1e-12);
  const Section slot = side_section(1.0, 9.0, ball, CutDirection::kUp);
  EXPECT_EQ(slot.arc.entry_rad, 0.0);
  const Tooth flat{.cutting_diameter_mm = 10.0, .teeth = 2};
  const ImmersionArc arc = immersion_arc(2.0, 10.0, CutDirection::kDown);
  EXPECT_EQ(side_section(1.0, 2.0, flat, CutDirection::kDown).arc.entry_rad, arc.entry_rad);
  // A corner that is cut over far more than its height is nearly a flank.
  const Tooth bull{.cutting_diameter_mm = 10.0, .corner_radius_mm = 0.2, .teeth = 2};
  const Section side = side_section(8.0, 2.0, bull, CutDirection::kDown);
  EXPECT_NEAR(side.arc.entry_rad, arc.entry_rad, 1e-12);
  EXPECT_FALSE(section_loads(side, bull, {.kienzle = kMildSteel}, 0.05, 3000.0)->irregular);
}

}  // namespace
}  // namespace capstan::mechanics

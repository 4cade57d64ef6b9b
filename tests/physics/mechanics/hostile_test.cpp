// Numbers that are none, and numbers no cutter has: each door gives a value or an error, in bounded time.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "planner/physics/mechanics/bending/beam.h"
#include "planner/physics/mechanics/force/force_law.h"
#include "planner/physics/mechanics/life/life.h"
#include "planner/physics/mechanics/loads/section.h"
#include "planner/physics/mechanics/stability.h"
#include "tests/support/mechanics/section_loads.h"
#include "tests/support/mechanics/wall_error.h"

namespace capstan::mechanics {
namespace {

/// Ordinary values with hostile ones among them, fixed seed.
class Hostile : public ::testing::Test {
 protected:
  double any(double ordinary) {
    switch (pick_(engine_)) {
      case 0:
        return 0.0;
      case 1:
        return -ordinary;
      case 2:
        return std::numeric_limits<double>::quiet_NaN();
      case 3:
        return std::numeric_limits<double>::infinity();
      case 4:
        return 1e-300;
      case 5:
        return 1e300;
      default:
        return ordinary;
    }
  }
  int any(int ordinary) {
    switch (pick_(engine_)) {
      case 0:
        return 0;
      case 1:
        return -ordinary;
      case 2:
        return std::numeric_limits<int>::max();
      default:
        return ordinary;
    }
  }
  Section section() {
    return {.ap_mm = any(3.0), .arc = {any(0.5), any(2.0)}, .csa_mm2 = any(9.0), .from_tip_mm = any(1.0)};
  }
  Tooth tooth() {
    return {.cutting_diameter_mm = any(12.0),
            .corner_radius_mm = any(2.0),
            .helix_rad = any(0.5),
            .lead_angle_rad = any(0.3),
            .taper_angle_rad = any(0.1),
            .runout_mm = any(0.01),
            .teeth = any(4)};
  }
  ForceLaw law() {
    ForceLaw l{.kienzle = {any(2000.0), any(0.2)}};
    if (any(1) == 1) return l;
    l.mechanistic = CuttingCoefficients{any(700.0), any(20.0), any(200.0), any(20.0), any(200.0), any(1.0)};
    return l;
  }

 private:
  std::mt19937 engine_{5};
  std::uniform_int_distribution<int> pick_{0, 60};
};

constexpr int kTries = 4000;

TEST_F(Hostile, SectionsGiveLoadsOrAnError) {
  int good = 0;
  for (int i = 0; i < kTries; ++i) {
    const Section s = section();
    const Tooth t = tooth();
    const ForceLaw l = law();
    const double fz = any(0.05);
    const auto loads = section_loads(s, t, l, fz, any(5000.0));
    if (!loads) {
      EXPECT_EQ(loads.error().code, "MECH-DOMAIN");
      continue;
    }
    ++good;
    EXPECT_FALSE(std::isnan(loads->peak_force_n));
    EXPECT_FALSE(std::isnan(loads->torque_nm));
    EXPECT_GE(loads->peak_force_n, 0.0);
  }
  EXPECT_GT(good, kTries / 4);
}

TEST_F(Hostile, WallsGiveAnErrorOfTheWallOrOfTheInput) {
  for (int i = 0; i < kTries; ++i) {
    model::Cutter c;
    c.cutting_diameter_mm = any(12.0);
    c.shank_diameter_mm = any(12.0);
    c.stick_out_mm = any(40.0);
    c.maximum_depth_of_cut_mm = any(26.0);
    c.holder = {{any(10.0), any(20.0), any(30.0)}};
    const auto beam = beam_of(c);
    if (!beam) continue;
    Section s = section();
    s.arc.exit_rad = any(3.141592653589793);
    (void)wall_error(s, tooth(), law(), any(0.05), WallSide::kRight, *beam);
    (void)bending_mm_n(*beam, any(1.0), any(2.0));
  }
}

TEST_F(Hostile, ModesGiveADepthOrAnError) {
  for (int i = 0; i < 150; ++i) {
    const std::vector<model::ToolPointMode> modes = {{"", "x", any(800.0), any(0.03), any(5000.0)},
                                                     {"", "y", any(900.0), any(0.03), any(6000.0)}};
    const ChatterCut cut{
        .arc = {any(0.5), any(2.0)}, .teeth = any(4), .ktc_n_mm2 = any(2000.0), .krc_n_mm2 = any(1200.0)};
    const auto lobes = StabilityLobes::make(modes, cut);
    if (lobes) {
      const double depth = lobes->limit_mm(any(5000.0));
      EXPECT_FALSE(std::isnan(depth));
      EXPECT_GE(depth, 0.0);
    }
  }
}

TEST_F(Hostile, LawsOfLifeGiveALife) {
  for (int i = 0; i < kTries; ++i) {
    model::ToolLifeLaw l;
    l.v0_m_min = any(200.0);
    l.life_min = any(20.0);
    l.n = any(0.25);
    l.p = any(2.0);
    l.h0_mm = any(0.1);
    const double life = median_life_min(l, any(150.0), any(0.1), any(2.0));
    EXPECT_FALSE(std::isnan(life));
    EXPECT_GE(life, 0.0);
  }
}

}  // namespace
}  // namespace capstan::mechanics

// Whatever removes material needs power: random sections of flat, bull, ball and leaning edges.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include "planner/physics/mechanics/force/kienzle.h"
#include "planner/physics/mechanics/loads/section.h"
#include "planner/physics/mechanics/loads/side_section.h"
#include "tests/support/mechanics/section_loads.h"

namespace capstan::mechanics {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kSpeed = 5000.0;

struct Asked {
  Section section;
  Tooth tooth;
  ForceLaw law;
  double fz = 0.0;
};

class Dice {
 public:
  double evenly(double lo, double hi) { return std::uniform_real_distribution(lo, hi)(random_); }
  double widely(double lo, double hi) { return lo * std::pow(hi / lo, evenly(0.0, 1.0)); }
  int one_of(int n) { return std::uniform_int_distribution(0, n - 1)(random_); }

 private:
  std::mt19937 random_{4711};
};

Asked any(Dice& d) {
  Asked a;
  Tooth& t = a.tooth;
  t.cutting_diameter_mm = d.widely(1.0, 50.0);
  t.teeth = 1 + d.one_of(6);
  t.helix_rad = d.evenly(0.0, 0.8);
  if (d.one_of(3) == 0) t.runout_mm = d.widely(0.001, 0.02);
  switch (d.one_of(5)) {
    case 0:
      break;
    case 1:
      t.corner_radius_mm = t.cutting_diameter_mm * d.evenly(0.01, 0.45);
      break;
    case 2:
      t.corner_radius_mm = 0.5 * t.cutting_diameter_mm;
      break;
    case 3:
      t.taper_angle_rad = d.evenly(0.02, 0.5);
      break;
    default:
      t.lead_angle_rad = d.evenly(0.1, 1.2);
  }
  a.section.ap_mm = t.cutting_diameter_mm * d.widely(1e-3, 1.5);
  const double from = d.one_of(3) == 0 ? 0.0 : d.evenly(0.0, kPi);
  a.section.arc = {from, d.one_of(3) == 0 ? kPi : d.evenly(from, kPi)};
  const double strip =
      0.5 * t.cutting_diameter_mm * (std::cos(a.section.arc.entry_rad) - std::cos(a.section.arc.exit_rad));
  a.section.csa_mm2 = a.section.ap_mm * std::max(strip, 1e-4) * d.widely(0.2, 1.5);
  if (d.one_of(2) == 0) a.law.mechanistic = CuttingCoefficients{767.01, 27.7, 168.8, 26.6, 222.0, 0.7};
  a.law.kienzle = {1800.0, 0.22};
  a.fz = d.widely(0.005, 0.3);
  return a;
}

double least_power_w(const Asked& a) {
  const double kc =
      a.law.mechanistic ? a.law.mechanistic->ktc_n_mm2 : specific_force_n_mm2(a.law.kienzle, a.fz);
  return cutting_power_w(a.section.csa_mm2 * a.fz * a.tooth.teeth * kSpeed, kc);
}

TEST(SectionLoads, HaveThePowerThatTheirAreaNeedsWhateverTheEdge) {
  Dice dice;
  for (int i = 0; i < 4000; ++i) {
    const Asked a = any(dice);
    const auto l = section_loads(a.section, a.tooth, a.law, a.fz, kSpeed);
    ASSERT_TRUE(l) << i << " " << l.error().message;
    EXPECT_GE(l->power_w, 0.98 * least_power_w(a)) << i;
    EXPECT_NEAR(l->torque_nm * 2.0 * kPi * kSpeed / 60.0, l->power_w, 1e-9 * l->power_w) << i;
    EXPECT_GT(l->peak_force_n, 0.0) << i;
    EXPECT_GT(l->h_max_mm, 0.0) << i;
    EXPECT_GE(l->peak_torque_nm, l->torque_nm) << i;
    if (HasFailure()) break;
  }
}

TEST(SectionLoads, RiseWithTheFeedAndTheAreaWhateverTheEdge) {
  Dice dice;
  constexpr double kHair = 1.0 - 1e-9;
  for (int i = 0; i < 2000; ++i) {
    Asked a = any(dice);
    const auto l = section_loads(a.section, a.tooth, a.law, a.fz, kSpeed);
    const auto faster = section_loads(a.section, a.tooth, a.law, 1.1 * a.fz, kSpeed);
    a.section.csa_mm2 *= 1.2;
    const auto more = section_loads(a.section, a.tooth, a.law, a.fz, kSpeed);
    ASSERT_TRUE(l && faster && more) << i;
    EXPECT_GE(faster->power_w, kHair * l->power_w) << i;
    EXPECT_GE(faster->peak_force_n, kHair * l->peak_force_n) << i;
    EXPECT_GE(faster->h_max_mm, kHair * l->h_max_mm) << i;
    // Along a corner the edge is integrated at four points.
    EXPECT_GE(more->power_w, 0.99 * l->power_w) << i;
    EXPECT_GE(more->peak_force_n, 0.99 * l->peak_force_n) << i;
    if (HasFailure()) break;
  }
}

// A ball does not reach the rim of its full radius in a shallow cut: the strip there has no edge.
TEST(SectionLoads, OfAShallowBallAreThoseOfItsArea) {
  const Tooth ball{.cutting_diameter_mm = 10.0, .corner_radius_mm = 5.0, .helix_rad = 0.5, .teeth = 2};
  const ForceLaw law{.mechanistic = CuttingCoefficients{767.01, 27.7, 168.8, 26.6, 222.0, 0.7}};
  struct {
    double ap, ae;
  } const cuts[] = {{0.5, 2.0}, {1.0, 1.0}, {0.3, 0.4}};
  for (const auto& c : cuts) {
    for (const auto side : {CutDirection::kUp, CutDirection::kDown}) {
      const double least = cutting_power_w(c.ap * c.ae * 0.1 * 2 * kSpeed, 767.01);
      for (Section s :
           {side_section(c.ap, c.ae, ball, side),
            Section{.ap_mm = c.ap, .arc = immersion_arc(c.ae, 10.0, side), .csa_mm2 = c.ap * c.ae}}) {
        const auto l = section_loads(s, ball, law, 0.1, kSpeed);
        ASSERT_TRUE(l);
        EXPECT_GE(l->power_w, 0.99 * least);
        EXPECT_LE(l->power_w, 12.0 * least);  // edge forces of thin chips included
        EXPECT_GT(l->peak_force_n, 0.0);
        // No chip is thicker than the feed along the steepest edge in contact.
        const double top = std::sqrt(1.0 - (1.0 - c.ap / 5.0) * (1.0 - c.ap / 5.0));
        EXPECT_LE(l->h_max_mm, 0.1 * top * 1.001);
        EXPECT_GE(l->h_max_mm, 0.1 * top * 0.5);
      }
    }
  }
}

TEST(SectionLoads, AStripThatABallDoesNotReachIsNotNothingWithoutAnAreaEither) {
  const Tooth ball{.cutting_diameter_mm = 10.0, .corner_radius_mm = 5.0, .teeth = 2};
  const ForceLaw law{.kienzle = {1800.0, 0.2}};
  const auto l = section_loads({.ap_mm = 0.3, .arc = immersion_arc(0.4, 10.0, CutDirection::kDown)}, ball,
                               law, 0.1, kSpeed);
  ASSERT_TRUE(l);
  EXPECT_GE(l->power_w,
            0.98 * cutting_power_w(0.3 * 0.4 * 0.1 * 2 * kSpeed, specific_force_n_mm2(law.kienzle, 0.1)));
}

}  // namespace
}  // namespace capstan::mechanics

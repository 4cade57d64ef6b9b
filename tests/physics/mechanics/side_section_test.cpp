#include "planner/physics/mechanics/loads/side_section.h"

#include <gtest/gtest.h>

#include <cmath>

#include "planner/physics/mechanics/force/immersion.h"
#include "tests/support/mechanics/section_loads.h"

namespace capstan::mechanics {
namespace {

const WorkMaterial kMildSteel{2298.0, 0.20};

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
  // Its area is about that of depth and arc: told or not, the power is the same.
  Section untold = side;
  untold.csa_mm2 = 0.0;
  const auto power = [&](const Section& s) {
    return section_loads(s, bull, {.kienzle = kMildSteel}, 0.05, 3000.0)->power_w;
  };
  EXPECT_NEAR(power(side) / power(untold), 1.0, kIrregular);
}

}  // namespace
}  // namespace capstan::mechanics

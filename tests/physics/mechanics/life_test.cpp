#include "planner/physics/mechanics/life/life.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace capstan::mechanics {
namespace {

model::ToolLifeLaw law() {
  model::ToolLifeLaw l;
  l.substrate = "carbide";
  l.v0_m_min = 200.0;
  l.life_min = 20.0;
  l.h0_mm = 0.5;
  l.a0_mm = 1.5;
  l.n = 0.25;
  l.p = 1.0 / 0.36;
  l.q = 1.0 / 0.98;
  l.scatter = 0.2;
  return l;
}

TEST(LifeLaw, IsTaylorsInEachOfItsInfluences) {
  EXPECT_DOUBLE_EQ(median_life_min(law(), 200.0, 0.5, 1.5), 20.0);
  EXPECT_NEAR(median_life_min(law(), 400.0, 0.5, 1.5), 20.0 / 16.0, 1e-12);
  EXPECT_NEAR(median_life_min(law(), 200.0, 0.25, 1.5), 20.0 * std::pow(2.0, 0.36), 1e-12);
  EXPECT_NEAR(median_life_min(law(), 200.0, 0.5, 0.75), 20.0 * std::pow(2.0, 0.98), 1e-12);
}

TEST(LifeLaw, ScattersAsItStatesAndElseByTheUsual) {
  EXPECT_DOUBLE_EQ(scatter_of(law()), 0.2);
  model::ToolLifeLaw unknown = law();
  unknown.scatter = 0.0;
  EXPECT_DOUBLE_EQ(scatter_of(unknown), kLifeScatter);
}

TEST(LifeLaw, OfNothingIsNoLife) {
  constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(median_life_min({}, 200.0, 0.1, 1.0), 0.0);
  EXPECT_EQ(median_life_min(law(), kNaN, 0.1, 1.0), 0.0);
  EXPECT_EQ(median_life_min(law(), 200.0, 0.0, 1.0), 0.0);
}

}  // namespace
}  // namespace capstan::mechanics

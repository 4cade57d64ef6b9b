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

TEST(LifeLaw, IsTheTaylorLifeOfTheSameConstants) {
  // v T^n f^p a^q = C with p, q of that form: exponents n / p and n / q.
  const model::ToolLifeLaw l = law();
  TaylorLife t{.c = 0.0, .n = l.n, .p = l.n / l.p, .q = l.n / l.q};
  t.c = l.v0_m_min * std::pow(l.life_min, l.n) * std::pow(l.h0_mm, t.p) * std::pow(l.a0_mm, t.q);
  EXPECT_NEAR(tool_life_min(t, 150.0, 0.3, 2.0), median_life_min(l, 150.0, 0.3, 2.0), 1e-9);
}

TEST(LifeLaw, ScattersAsALognormal) {
  const model::ToolLifeLaw l = law();
  EXPECT_NEAR(sure_life_min(l, 0.5, 200.0, 0.5, 1.5), 20.0, 1e-9);
  // One standard deviation: 84.13 % of the edges.
  EXPECT_NEAR(sure_life_min(l, 0.8413447460685429, 200.0, 0.5, 1.5), 20.0 * std::exp(-0.2), 1e-9);
  EXPECT_NEAR(mean_life_min(l, 200.0, 0.5, 1.5), 20.0 * std::exp(0.02), 1e-9);
  EXPECT_LT(sure_life_min(l, 0.99, 200.0, 0.5, 1.5), sure_life_min(l, 0.9, 200.0, 0.5, 1.5));
  model::ToolLifeLaw unknown = l;
  unknown.scatter = 0.0;
  EXPECT_DOUBLE_EQ(scatter_of(unknown), kLifeScatter);
}

TEST(NormalQuantile, IsThatOfTables) {
  EXPECT_NEAR(normal_quantile(0.5), 0.0, 1e-12);
  EXPECT_NEAR(normal_quantile(0.975), 1.959963984540054, 1e-9);
  EXPECT_NEAR(normal_quantile(0.01), -2.3263478740408408, 1e-9);
}

TEST(LifeLaw, OfAMaterialWithoutOneIsTheTextbooksThroughTheTablesSpeed) {
  model::WorkMaterial m;
  m.vc_carbide_m_min = 270.0;
  m.vc_hss_m_min = 120.0;
  model::Cutter c;
  c.substrate = model::Substrate::kHss;
  EXPECT_DOUBLE_EQ(median_life_min(life_law(m, c), 120.0, 0.1, 1.0), kLifeAtTableMin);
  EXPECT_NEAR(median_life_min(life_law(m, c), 240.0, 0.1, 1.0), kLifeAtTableMin / 256.0, 1e-9);
  c.life_min = 40.0;
  c.substrate = model::Substrate::kCarbide;
  EXPECT_DOUBLE_EQ(median_life_min(life_law(m, c), 270.0, 0.1, 1.0), 40.0);
  m.life = {law()};
  EXPECT_EQ(life_law(m, c), law());
}

TEST(LifeLaw, OfNothingIsNoLife) {
  constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(median_life_min({}, 200.0, 0.1, 1.0), 0.0);
  EXPECT_EQ(median_life_min(law(), kNaN, 0.1, 1.0), 0.0);
  EXPECT_EQ(median_life_min(law(), 200.0, 0.0, 1.0), 0.0);
  EXPECT_EQ(sure_life_min(law(), 1.0, 200.0, 0.5, 1.5), 0.0);
  EXPECT_EQ(edge_cost_per_min({1.0, 2.0, 10.0}, 0.0), std::numeric_limits<double>::infinity());
}

TEST(EdgeCost, PerMinuteIsEdgeAndChangeOverLife) {
  EXPECT_DOUBLE_EQ(edge_cost_per_min({0.8, 1.5, 12.0}, 20.0), (12.0 + 1.2) / 20.0);
}

}  // namespace
}  // namespace capstan::mechanics

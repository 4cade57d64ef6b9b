#include "planner/physics/mechanics/life/tool_life.h"

#include <gtest/gtest.h>

#include <numbers>

namespace capstan::mechanics {
namespace {

TEST(EconomicSpeed, MatchesGhoshAndMallik) {
  // [S] the problems (as FOSSEE's programs state them), [C] the speeds. Problems 4.26 and 4.28: C 75, n 0.25,
  // labour 0.15 per min, tool 2.5, change 2 min.
  const TaylorLife life{.c = 75.0, .n = 0.25};
  EXPECT_NEAR(min_cost_speed_m_min(life, {0.15, 2.0, 2.5}), 27.417, 5e-4);
  EXPECT_NEAR(max_production_speed_m_min(life, 2.0), 47.921, 5e-4);
}

TEST(EconomicSpeed, OfDrillingMatchesTheConstructedExample) {
  // [C] constructed, not from a paper. d 10, L 25 mm; V T^0.2 f^0.4 = 25.9; thrust 6170 f^0.7 <= 3000 N; r =
  // 1, change 1 min, edge 8.
  const TaylorLife life{.c = 25.9, .n = 0.2, .p = 0.4};
  const double feed = std::pow(3000.0 / 6170.0, 1.0 / 0.7);
  EXPECT_NEAR(feed, 0.356963, 5e-7);
  const double speed = min_cost_speed_m_min(life, {1.0, 1.0, 8.0}, feed, 1.0);
  EXPECT_NEAR(speed, 19.0981, 5e-5);
  const double min = tool_life_min(life, speed, feed, 1.0);
  EXPECT_NEAR(min, 36.000, 5e-4);
  const double cut_min = std::numbers::pi * 10.0 * 25.0 / (1000.0 * speed * feed);
  EXPECT_NEAR(cut_min, 0.115206, 5e-7);
  EXPECT_NEAR(cut_min * (1.0 + (1.0 + 8.0) / min), 0.144008, 5e-7);
}

TEST(EconomicSpeed, IsTheMinimumOfTheCost) {
  const TaylorLife life{.c = 240.0, .n = 0.3, .p = 0.2, .q = 0.1};
  const EdgeCost cost{0.8, 1.5, 12.0};
  const auto price = [&](double v) {
    const double time = 100.0 / v;
    return cost.machine_per_min * time +
           time / tool_life_min(life, v, 0.1, 3.0) * (cost.machine_per_min * cost.change_min + cost.edge);
  };
  const double v = min_cost_speed_m_min(life, cost, 0.1, 3.0);
  EXPECT_LT(price(v), price(v * 1.001));
  EXPECT_LT(price(v), price(v * 0.999));
}

TEST(ToolLife, SpeedForALifeGivesThatLife) {
  const TaylorLife life{.c = 240.0, .n = 0.3, .p = 0.2, .q = 0.1};
  EXPECT_NEAR(tool_life_min(life, speed_for_life_m_min(life, 45.0, 0.12, 2.0), 0.12, 2.0), 45.0, 1e-9);
}

}  // namespace
}  // namespace capstan::mechanics

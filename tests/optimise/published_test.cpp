// What the published problems say beyond their optimum.

#include <gtest/gtest.h>

#include <cmath>

#include "planner/optimise/solver/solver.h"
#include "tests/optimise/examples.h"

namespace capstan::optimise {
namespace {

using examples::MillingStatement;

/// The best profit rate of the milling problem under a variant of its statement, or nothing without NLopt.
double profit(const MillingStatement& statement, Walk walk = Walk::kLogarithmic) {
  Job job;
  job.evaluation_budget = 20000;
  const auto s = solve(examples::tolouei_rad_milling(walk, statement).problem, {}, job);
  if (!s) return std::nan("");
  EXPECT_EQ(s->outcome, Outcome::kOptimal);
  return -s->objective;
}

class Published : public ::testing::Test {
 protected:
  void SetUp() override {
    if (std::isnan(profit({}))) GTEST_SKIP() << "NLopt is absent";
  }
};

TEST_F(Published, MillingCostsAndTimesAreThoseOfTheOptimum) {
  const auto e = examples::tolouei_rad_milling();
  std::array<double, 10> x;
  std::copy(e.best_x.begin(), e.best_x.end(), x.begin());
  double objective = 0.0;
  double cost = 0.0;
  double time = 0.0;
  std::vector<double> c(9);
  examples::tolouei_rad(x, MillingStatement{}, objective, c, cost, time);
  EXPECT_NEAR(cost, 10.8673, 1e-3);  // x is tabulated to five digits
  EXPECT_NEAR(time, 5.2927, 1e-3);
  EXPECT_NEAR(objective, -2.6702, 1e-4);
}

TEST_F(Published, MillingProfitDependsOnTheContactAsComputed) {
  EXPECT_NEAR(profit({.contact = 0.25}), 2.7013, 6e-5);
  EXPECT_NEAR(profit({.contact = 1.0}), 2.6144, 6e-5);
  EXPECT_NEAR(profit({.contact = 1e-6}), 2.7423, 6e-5);  // tools for nothing: an upper bound
}

TEST_F(Published, MillingProfitRisesByWhatADroppedLimitWasWorth) {
  EXPECT_NEAR(profit({.roughness = false}), 2.854, 6e-4);
  EXPECT_NEAR(profit({.power = false}), 2.892, 6e-4);
  EXPECT_NEAR(profit({.power = false, .roughness = false}), 4.070, 6e-4);
}

TEST_F(Published, TheWalkDoesNotChangeTheOptimum) {
  EXPECT_NEAR(profit({}, Walk::kLinear), profit({}, Walk::kLogarithmic), 1e-6);
}

}  // namespace
}  // namespace capstan::optimise

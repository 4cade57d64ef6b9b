#include "casebase/tune/regression.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace capstan::casebase::tune {
namespace {

/// y = 1 + 2 x and noise, in groups with something in common.
std::vector<Row> line(std::size_t groups, std::size_t each, double between, double noise, unsigned seed = 1) {
  std::mt19937 random(seed);
  std::normal_distribution<double> z;
  std::vector<Row> out;
  for (std::size_t g = 0; g < groups; ++g) {
    const double common = between * z(random);
    for (std::size_t i = 0; i < each; ++i) {
      const double x = std::sin(static_cast<double>(7 * g + 3 * i + 1));
      out.push_back({{1.0, x}, 1.0 + 2.0 * x + common + noise * z(random), 1.0, g});
    }
  }
  return out;
}

TEST(Regression, FindsALineWithoutNoiseExactly) {
  const Regression r = regress(line(20, 1, 0.0, 0.0), 2, {});
  EXPECT_NEAR(r.coefficient[0], 1.0, 1e-6);
  EXPECT_NEAR(r.coefficient[1], 2.0, 1e-6);
}

TEST(Regression, KeepsThePriorWhereNothingIsObserved) {
  const Regression r = regress({}, 2, {.prior = {{3.0, 0.5}, {-1.0, 0.2}}});
  EXPECT_DOUBLE_EQ(r.coefficient[0], 3.0);
  EXPECT_NEAR(r.std_dev(1), 0.2, 1e-12);
}

TEST(Regression, ATermThatDoesNotVaryStaysAtItsPrior) {
  std::vector<Row> rows = line(20, 1, 0.0, 0.05);
  for (Row& row : rows) row.x.push_back(0.0);
  const Regression r = regress(rows, 3, {.prior = {{}, {}, {0.7, 0.1}}});
  EXPECT_NEAR(r.coefficient[2], 0.7, 1e-9);
  EXPECT_NEAR(r.std_dev(2), 0.1, 1e-9);
}

TEST(Regression, OutliersDoNotMoveTheLine) {
  std::vector<Row> rows = line(40, 1, 0.0, 0.05);
  for (std::size_t i = 0; i < 8; ++i) rows[5 * i].y += 3.0;
  const Regression r = regress(rows, 2, {.noise = 0.05});
  EXPECT_NEAR(r.coefficient[0], 1.0, 0.05);
  EXPECT_NEAR(r.coefficient[1], 2.0, 0.07);
  EXPECT_LT(r.weight[0], 0.01);
  const Regression plain = regress(rows, 2, {.noise = 0.05, .robust = false});
  EXPECT_GT(std::abs(plain.coefficient[0] - 1.0), 0.3);
}

TEST(Regression, AThousandCopiesOfOneRowAreOneGroup) {
  std::vector<Row> rows = line(10, 1, 0.1, 0.02);
  const RegressionOptions options{.noise = 0.02, .between = 0.1};
  const Regression before = regress(rows, 2, options);
  Row odd{{1.0, 0.0}, 1.25, 1.0, 99};
  for (int i = 0; i < 1000; ++i) rows.push_back(odd);
  const Regression after = regress(rows, 2, options);
  // One group of eleven, two and a half of their standard deviations away.
  EXPECT_LT(std::abs(after.coefficient[0] - before.coefficient[0]), 0.25 / 5.0);
  EXPECT_GT(after.std_dev(0), 0.5 * before.std_dev(0));
}

TEST(RegressionProperty, StatedUncertaintyCoversTheTruth) {
  int within = 0, all = 0;
  for (unsigned seed = 1; seed <= 200; ++seed) {
    const Regression r = regress(line(12, 3, 0.1, 0.05, seed), 2, {.noise = 0.05, .between = 0.1});
    within += std::abs(r.coefficient[1] - 2.0) <= 1.6449 * r.std_dev(1) ? 1 : 0;  // 90 % of a normal
    ++all;
  }
  EXPECT_GE(within, all * 80 / 100);
}

/// Rows of a line of which every second one is of a kind that scatters ten times as much.
std::vector<Row> two_kinds(unsigned seed, bool named) {
  std::mt19937 random(seed);
  std::normal_distribution<double> z;
  std::vector<Row> out;
  for (std::size_t i = 0; i < 16; ++i) {
    const double x = std::sin(static_cast<double>(3 * i + 1));
    const bool wild = i % 2 == 1;
    out.push_back(
        {{1.0, x}, 1.0 + 2.0 * x + (wild ? 0.2 : 0.02) * z(random), 1.0, i, wild && named ? 1U : 0U});
  }
  return out;
}

TEST(RegressionProperty, KindsThatScatterDifferentlyEachHoldTheirInterval) {
  for (const bool named : {true, false}) {
    int wild = 0, tame = 0, all = 0;
    for (unsigned seed = 1; seed <= 200; ++seed) {
      const std::vector<LeftOut> left_out =
          leave_groups_out(two_kinds(seed, named), 2, {.noise = 0.02, .between = 0.01});
      for (std::size_t i = 0; i < left_out.size(); i += 2) {
        tame += left_out[i].within_90() ? 1 : 0;
        wild += left_out[i + 1].within_90() ? 1 : 0;
        ++all;
      }
    }
    // 90 of 100 are asked for; 1,600 of each kind, so that chance is a hundredth.
    EXPECT_GE(tame, all * 87 / 100);
    if (named) {
      EXPECT_GE(wild, all * 85 / 100);
      EXPECT_LE(wild, all * 95 / 100);
    } else {
      EXPECT_LT(wild, all * 80 / 100);
    }
  }
}

TEST(Regression, AKindThatNoRowIsOfScattersAsTheWildestOne) {
  const Regression r = regress(two_kinds(1, true), 2, {.noise = 0.02, .between = 0.01});
  const std::vector<double> here = {1.0, 0.0};
  EXPECT_GT(r.predictive_std_dev_at(here, 1), 3.0 * r.predictive_std_dev_at(here, 0));
  EXPECT_DOUBLE_EQ(r.predictive_std_dev_at(here, 7), r.predictive_std_dev_at(here, 1));
}

TEST(Interval, IsWiderWhereFewRowsTellTheScatter) {
  // Quantiles of 95 % of Student's t, as tables have them.
  EXPECT_NEAR(deviations_90(2.0), 2.920, 0.01);
  EXPECT_NEAR(deviations_90(6.0), 1.943, 0.001);
  EXPECT_NEAR(deviations_90(30.0), 1.697, 0.001);
  EXPECT_NEAR(deviations_90(0.0), 1.645, 0.001);
}

TEST(LeaveGroupsOut, NeverPredictsAGroupFromItself) {
  std::vector<Row> rows = line(6, 4, 0.0, 0.0);
  for (Row& row : rows) {
    if (row.group == 3) row.y += 1.0;
  }
  const std::vector<LeftOut> left_out = leave_groups_out(rows, 2, {.noise = 0.01});
  for (std::size_t i = 0; i < rows.size(); ++i) {
    EXPECT_NEAR(left_out[i].observed - left_out[i].predicted, rows[i].group == 3 ? 1.0 : 0.0, 0.01);
  }
}

}  // namespace
}  // namespace capstan::casebase::tune

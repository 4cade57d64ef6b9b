#include "casebase/tune/process.h"

#include <gtest/gtest.h>

#include <cmath>

namespace capstan::casebase::tune {
namespace {

const std::vector<PriorTerm> kPrior = {{0.0, 1.0}, {0.0, 1.0}};
const ProcessSpreads kSmooth{.field = 0.5, .lengths = {0.5}, .group = 0.0, .noise = 0.01};

std::vector<Row> wave(std::size_t n) {
  std::vector<Row> out;
  for (std::size_t i = 0; i < n; ++i) {
    const double x = -1.0 + 2.0 * static_cast<double>(i) / static_cast<double>(n - 1);
    out.push_back({{x}, std::sin(3.0 * x), 1.0, i});
  }
  return out;
}

TEST(Process, IsThePriorBeforeAnythingIsObserved) {
  const Process p({}, {{0.3, 0.2}, {1.0, 0.0}}, {.field = 0.0, .lengths = {1.0}, .group = 0.1, .noise = 0.1});
  const std::vector<double> x = {2.0};
  EXPECT_DOUBLE_EQ(p.at(x).mean, 2.3);
  EXPECT_DOUBLE_EQ(p.at(x).std_dev, 0.2);
  EXPECT_NEAR(p.at(x).next_std_dev, std::sqrt(0.06), 1e-12);
}

TEST(Process, PassesThroughWhatWasObservedAndIsUnsureElsewhere) {
  const Process p(wave(9), kPrior, kSmooth);
  const std::vector<double> known = {0.5}, far = {3.0};
  EXPECT_NEAR(p.at(known).mean, std::sin(1.5), 0.02);
  EXPECT_LT(p.at(known).std_dev, 0.02);
  EXPECT_GT(p.at(far).std_dev, 0.3);
}

TEST(Process, WithoutAFieldIsTheLineOfTheRegression) {
  std::vector<Row> rows = wave(9);
  const Process p(rows, kPrior, {.field = 0.0, .lengths = {1.0}, .group = 0.0, .noise = 0.3});
  for (Row& row : rows) row.x.insert(row.x.begin(), 1.0);
  const Regression r = regress(rows, 2, {.prior = kPrior, .noise = 0.3, .noise_rows = 1e9, .robust = false});
  for (const double x : {-1.0, 0.2, 2.0}) {
    const std::vector<double> at = {x}, terms = {1.0, x};
    EXPECT_NEAR(p.at(at).mean, r.at(terms), 1e-6);
    EXPECT_NEAR(p.at(at).std_dev, r.std_dev_at(terms), 1e-6);
  }
}

TEST(Process, ManyRowsOfOneGroupLeaveTheGroupsSpread) {
  std::vector<Row> rows(500, Row{{0.0}, 1.0, 1.0, 7});
  const Process p(rows, {{0.0, 1.0}, {0.0, 0.0}},
                  {.field = 0.0, .lengths = {1.0}, .group = 0.3, .noise = 0.1});
  const std::vector<double> x = {0.0};
  // Of a prior of 1 and one group of spread 0.3: 1 / sqrt(1 + 1 / 0.09).
  EXPECT_NEAR(p.at(x).std_dev, 1.0 / std::sqrt(1.0 + 1.0 / 0.09), 0.002);
}

TEST(LearntProcess, FindsTheNoise) {
  std::vector<Row> rows;
  for (std::size_t i = 0; i < 60; ++i) {
    rows.push_back({{0.0}, (i % 2 == 0 ? 0.02 : -0.02), 1.0, i});  // std dev 0.02
  }
  const Process p = learnt(rows, kPrior, {.field = 0.0, .lengths = {1.0}, .group = 0.0, .noise = 0.06}, {});
  EXPECT_NEAR(p.spreads().noise, 0.02, 0.01);
}

TEST(LearntProcess, DoubtsALoadThatIsFarTooLowAndHearsOneThatIsTooHigh) {
  std::vector<Row> rows;
  for (std::size_t i = 0; i < 12; ++i) rows.push_back({{0.0}, 0.0, 1.0, i});
  const std::vector<PriorTerm> prior = {{0.0, 1.0}, {0.0, 0.1}};
  const ProcessSpreads s{.field = 0.0, .lengths = {1.0}, .group = 0.0, .noise = 0.1};
  const std::vector<double> x = {0.0};
  std::vector<Row> low = rows, high = rows;
  low[0].y = -2.0;
  high[0].y = 2.0;
  const ProcessLearning fixed{.needed_rows = 1000};
  EXPECT_GT(learnt(low, prior, s, fixed).at(x).mean, -0.04);
  EXPECT_NEAR(learnt(high, prior, s, fixed).at(x).mean, 2.0 / 12.0, 0.01);
}

TEST(FailureProcess, IsThePriorBeforeAnythingIsObserved) {
  const FailureProcess p({}, {{-1.0, 0.0}, {0.0, 0.0}}, {.field = 0.0, .lengths = {1.0}, .group = 0.0});
  const std::vector<double> x = {0.0};
  EXPECT_NEAR(p.at(x), 0.158655, 1e-6);  // of the normal distribution below -1
}

TEST(FailureProcess, GrowsWhereItFailedAndFallsWhereItDidNot) {
  std::vector<Row> rows;
  for (std::size_t i = 0; i < 10; ++i) {
    rows.push_back({{-0.5}, -1.0, 1.0, i});
    rows.push_back({{0.5}, i < 6 ? 1.0 : -1.0, 1.0, i});
  }
  const FailureProcess p(rows, {{-2.0, 1.0}, {0.0, 2.0}}, {.field = 0.5, .lengths = {0.2}, .group = 0.0});
  const std::vector<double> good = {-0.5}, bad = {0.5};
  EXPECT_LT(p.at(good), 0.1);
  EXPECT_GT(p.at(bad), 0.35);
  EXPECT_LT(p.at(bad), 0.75);
}

TEST(Normal, ProbabilityIsThatOfTheTables) {
  EXPECT_NEAR(normal_probability(1.644854), 0.95, 1e-6);
  EXPECT_NEAR(normal_probability(-2.326348), 0.01, 1e-6);
}

}  // namespace
}  // namespace capstan::casebase::tune

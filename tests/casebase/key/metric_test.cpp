#include "casebase/key/metric.h"

#include <cmath>
#include <random>

#include "tests/casebase/sample.h"

namespace capstan::casebase {
namespace {

/// Good cases of which the speed falls with the third root of the stick-out, or faster, and nothing else
/// matters.
std::vector<Case> by_stick_out(std::size_t n, double power) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> any(0.0, 1.0);
  std::vector<Case> out;
  for (std::size_t i = 0; i < n; ++i) {
    Case c = sample(5.0 + 10.0 * any(random), 30.0, "part " + std::to_string(i));
    c.asked.depth_mm = 5.0 + 50.0 * any(random);
    c.asked.stick_out_mm = 20.0 * std::exp2(3.0 * any(random));
    c.bound.vc_m_min = 100.0 * std::pow(c.asked.stick_out_mm / 20.0, power) * (1.0 + 0.05 * any(random));
    c.id = id_of(c);
    out.push_back(c);
  }
  return out;
}

TEST(Metric, IsTheFixedScalesWithoutCases) { EXPECT_EQ(learned_metric({}), Metric{}); }

TEST(Metric, CountsMoreWhatMovesTheOutcomeMore) {
  constexpr std::size_t kDepth = 1, kStickOut = 7;
  const Metric m = learned_metric(by_stick_out(1000, -1.0));
  EXPECT_EQ(m.cases, 1000u);
  // Twice the stick-out halves the speed: ln 2 / ln 1.5 = 1.71, drawn to 1 by a hundred cases.
  EXPECT_GT(m.weight[kStickOut], 1.5);
  EXPECT_LT(m.weight[kStickOut], std::log(2.0) / std::log(1.5));
  EXPECT_LT(m.weight[kDepth], 0.6);
  EXPECT_GE(m.weight[kDepth], kLeastWeight);
}

TEST(Metric, IsMovedLittleByFewCasesAndNeverBeyondItsBounds) {
  for (const double w : learned_metric(by_stick_out(5, -3.0)).weight) EXPECT_LT(w, 2.0);
  EXPECT_EQ(learned_metric(by_stick_out(5000, -3.0)).weight[7], kMostWeight);
}

TEST(Metric, HearsNeitherSimulatedNorBadCases) {
  std::vector<Case> cases = by_stick_out(100, -1.0);
  for (std::size_t i = 0; i < cases.size(); ++i) {
    if (i % 2 == 0) {
      cases[i].observed.verdict = Verdict::kBad;
    } else {
      cases[i].origin = Origin::kSimulated;
    }
  }
  EXPECT_EQ(learned_metric(cases), Metric{});
}

TEST(Metric, IsStoredAndNeverLearnedByItself) {
  const Folder folder;
  fill(folder.file(), by_stick_out(500, -1.0));
  Job job;
  EXPECT_EQ(CaseBase::open(folder.file(), job)->metric(), Metric{});
  Metric learned;
  {
    auto base = CaseBase::open(folder.file(), job).value();
    Question q = base.cases()[0].asked;
    q.stick_out_mm *= 2.0;
    const double before = base.nearest(q, 500)->back().distance;
    learned = base.learn_metric().value();
    EXPECT_NE(base.nearest(q, 500)->back().distance, before);
    ASSERT_TRUE(base.add(by_stick_out(600, 0.5)).has_value());
    EXPECT_EQ(base.metric(), learned);
  }
  const auto again = CaseBase::open(folder.file(), job);
  EXPECT_EQ(again->metric(), learned);
  tamper(folder.file(), "UPDATE capstan_body SET body = x'00' WHERE number = 501");
  Job altered;
  auto base = CaseBase::open(folder.file(), altered).value();
  EXPECT_EQ(base.metric(), Metric{});
  ASSERT_EQ(altered.count(Severity::kWarning), 1u);
  EXPECT_EQ(altered.diagnostics()[0].code, "CASE-ROW");
  EXPECT_EQ(base.add(sample(77.0)).error().code, "CASE-DAMAGED");
}

TEST(Metric, ReadsBackToTheSameBits) {
  const Metric m = learned_metric(by_stick_out(50, -1.0));
  EXPECT_EQ(metric_of(bytes_of(m)), m);
  EXPECT_EQ(metric_of(bytes_of(m) + "x"), std::nullopt);
  EXPECT_EQ(metric_of(""), std::nullopt);
}

}  // namespace
}  // namespace capstan::casebase

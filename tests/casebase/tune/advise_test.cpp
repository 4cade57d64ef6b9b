#include "casebase/tune/advise.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace capstan::casebase::tune {
namespace {

constexpr std::size_t kForce = static_cast<std::size_t>(Watched::kForce);
const Setting kHandbook{};

/// A cut whose force is watched, expected at 0.6 of its limit, known within 40 %.
Handbook handbook() {
  Handbook h;
  h.machine = "mill 1";
  h.loads[kForce] = {.watched = true,
                     .ln_load = {std::log(0.6), 0.34},
                     .by_vc = {0.0, 0.1},
                     .by_fz = {0.8, 0.15},
                     .by_wear = {0.26, 0.1},
                     .noise = 0.06,
                     .edges = 0.06};
  h.hard = [](const Setting& s) { return std::exp(0.8 * s.ln_fz) * 0.8; };  // kept up to 1.32 of the feed
  return h;
}

/// A good cut at a setting: force 0.4 of its limit there on a sharp edge.
Evidence good(int number, const Setting& at = kHandbook) {
  Evidence e;
  e.id = "case " + std::to_string(number);
  e.at = at;
  e.source = "part " + std::to_string(number);
  e.machine = "mill 1";
  e.edge = "edge " + std::to_string(number / 3);
  e.day = 20000 + number / 6;
  e.ln_load[kForce] = std::log(0.4) + 0.8 * at.ln_fz + 0.02 * std::sin(number);
  e.ln_time = -0.9 * (at.ln_vc + at.ln_fz);
  return e;
}

std::vector<Evidence> good_ones(int count, const Setting& at = kHandbook) {
  std::vector<Evidence> out;
  for (int i = 0; i < count; ++i) out.push_back(good(i, at));
  return out;
}

TEST(Advise, WithoutCasesTheHandbookHolds) {
  const Advice a = advise({}, handbook(), {});
  EXPECT_EQ(a.proven.at, kHandbook);
  EXPECT_EQ(a.trial.at, kHandbook);
  EXPECT_EQ(a.why, "no case is near: the handbook's values hold");
}

TEST(Advise, GoodCasesAllowAFasterTrialWithinTheTrustRegion) {
  const TuneOptions options;
  const Advice a = advise(good_ones(12), handbook(), options);
  EXPECT_LT(a.trial.time, 0.95);
  EXPECT_LE(a.trial.at.ln_vc, options.step + 1e-9);
  EXPECT_LE(a.trial.at.ln_fz, options.step + 1e-9);
  EXPECT_LE(a.trial.probability, options.probability);
  EXPECT_EQ(a.proven.at, kHandbook);
}

TEST(Advise, ASettingIsProvenOnlyByRepeatsOnSeveralEdgesOrDays) {
  const Setting faster{0.1, 0.1};
  std::vector<Evidence> cases = good_ones(12);
  for (int i = 0; i < 5; ++i) {  // five parts of one edge and one day
    cases.push_back(good(100 + i, faster));
    cases.back().edge = "one edge";
    cases.back().day = 20100;
  }
  EXPECT_EQ(advise(cases, handbook(), {}).proven.at, kHandbook);
  EXPECT_EQ(advise(cases, handbook(), {}).trial.at, faster) << "it is cut again until it is proven";
  cases.back().edge = "another edge";
  EXPECT_EQ(advise(cases, handbook(), {}).proven.at, faster);
}

TEST(Advise, EnteredAndSimulatedCasesProveNothing) {
  const Setting faster{0.1, 0.1};
  std::vector<Evidence> cases = good_ones(12);
  for (int i = 0; i < 12; ++i) {
    cases.push_back(good(100 + i, faster));
    cases.back().measured = false;
  }
  EXPECT_EQ(advise(cases, handbook(), {}).proven.at, kHandbook);
}

TEST(Advise, NoNumberOfCasesLiftsAHardLimit) {
  Handbook h = handbook();
  std::vector<Evidence> cases;
  for (int k = 0; k <= 6; ++k) {
    const Setting at{0.0, 0.1 * k};  // the hard limit ends at ln 1.32 = 0.28
    for (int i = 0; i < 30; ++i) {
      cases.push_back(good(100 * k + i, at));
      cases.back().ln_load[kForce] = std::log(0.1);
    }
  }
  TuneOptions options;
  options.most_cases = 300;
  const Advice a = advise(cases, h, options);
  EXPECT_LE(h.hard(a.proven.at), 1.0);
  EXPECT_LE(h.hard(a.trial.at), 1.0);
  EXPECT_GT(a.trial.time, std::exp(-0.9 * (0.14 + 0.28)) - 0.05);
}

TEST(Advise, WithoutHardLimitsNothingIsRaised) {
  Handbook h = handbook();
  h.hard = nullptr;
  const Advice a = advise(good_ones(30), h, {});
  EXPECT_LE(a.trial.at.ln_vc, 0.0);
  EXPECT_LE(a.trial.at.ln_fz, 0.0);
}

TEST(Advise, LoadsOverTheLimitLowerTheValues) {
  std::vector<Evidence> cases = good_ones(12);
  for (Evidence& e : cases) e.ln_load[kForce] = std::log(0.95);
  const Advice a = advise(cases, handbook(), {});
  EXPECT_TRUE(a.lowered);
  EXPECT_LT(a.trial.at.ln_fz, -0.1);
  EXPECT_LE(a.trial.probability, TuneOptions{}.probability);
  EXPECT_EQ(a.binding, "peak force");
}

TEST(Advise, WhereAllSettingsFailAnotherCutIsNeeded) {
  // Failures at the gentlest setting that is heard speak against all that are less gentle.
  std::vector<Evidence> cases;
  for (int i = 0; i < 60; ++i) {
    cases.push_back(good(i, i % 3 == 0 ? kHandbook : Setting{-0.34 * (i % 3), -0.34 * (i % 3)}));
    cases.back().failed = cases.back().judged = true;
  }
  EXPECT_TRUE(advise(cases, handbook(), {}).another_cut);
  std::vector<Evidence> loaded = good_ones(12);
  for (Evidence& e : loaded) e.ln_load[kForce] = std::log(0.95);
  const Advice lowered = advise(loaded, handbook(), {});
  EXPECT_TRUE(lowered.lowered);
  EXPECT_FALSE(lowered.another_cut);
}

TEST(Advise, FailuresLowerTheValuesAndLaterSuccessOnOtherEdgesLiftsThem) {
  std::vector<Evidence> cases;
  for (int i = 0; i < 4; ++i) {
    cases.push_back(good(i));
    cases.back().failed = true;
  }
  const Advice failed = advise(cases, handbook(), {});
  EXPECT_TRUE(failed.lowered);
  EXPECT_LT(failed.trial.at.ln_vc + failed.trial.at.ln_fz, 0.0);
  for (int i = 0; i < 120; ++i) cases.push_back(good(100 + i));
  const Advice lifted = advise(cases, handbook(), {});
  EXPECT_LT(lifted.handbook.probability, 0.2 * failed.handbook.probability);
  EXPECT_FALSE(lifted.lowered);
}

// --- wrong cases ---------------------------------------------------------------------------------------

TEST(WrongCases, AFeedTenTimesTooHighIsRefusedByName) {
  std::vector<Evidence> cases = good_ones(12);
  const Advice before = advise(cases, handbook(), {});
  cases.push_back(good(99, {0.0, std::log(10.0)}));
  const Advice after = advise(cases, handbook(), {});
  ASSERT_EQ(after.refused.size(), 1U);
  EXPECT_EQ(after.refused[0].index, 12U);
  EXPECT_EQ(after.refused[0].why,
            "its feed per tooth is 10 times the handbook's; within a factor of 2 is heard");
  EXPECT_EQ(after.trial.at, before.trial.at);
  EXPECT_EQ(after.proven.at, before.proven.at);
}

TEST(WrongCases, PoisonWithinTheBoundsNeitherLeavesTheTrustRegionNorTheLimits) {
  // "Twice the feed went well at a tenth of the force": many, on many edges and days.
  std::vector<Evidence> cases = good_ones(12);
  const Handbook h = handbook();
  for (int i = 0; i < 20; ++i) {
    cases.push_back(good(1000 + i, {0.0, std::log(1.9)}));
    cases.back().ln_load[kForce] = std::log(0.04);
  }
  const TuneOptions options;
  const Advice a = advise(cases, h, options);
  EXPECT_LE(h.hard(a.proven.at), 1.0);
  EXPECT_LE(h.hard(a.trial.at), 1.0);
  EXPECT_LE(a.trial.at.ln_fz, options.step + 1e-9);
}

TEST(WrongCases, ACaseOfAnotherMachineIsNotHeard) {
  std::vector<Evidence> cases = good_ones(12);
  for (Evidence& e : cases) e.machine = "mill 2";
  const Advice a = advise(cases, handbook(), {});
  EXPECT_EQ(a.heard, 0U);
  EXPECT_EQ(a.refused.size(), 12U);
  EXPECT_EQ(a.refused[0].why, "it was cut on mill 2, not on mill 1");
  EXPECT_EQ(a.trial.at, kHandbook);
}

TEST(WrongCases, AThousandCopiesOfOneCaseAreOne) {
  const std::vector<Evidence> one = {good(1, {0.1, 0.1})};
  std::vector<Evidence> copies(1000, one[0]);
  const Advice a = advise(copies, handbook(), {}), b = advise(one, handbook(), {});
  EXPECT_EQ(a.heard, 1U);
  EXPECT_EQ(a.refused.size(), 999U);
  EXPECT_EQ(a.trial.at, b.trial.at);
  EXPECT_EQ(a.handbook.probability, b.handbook.probability);
}

TEST(WrongCases, CopiesUnderOtherNamesOfOneEdgeProveNothing) {
  std::vector<Evidence> copies;
  for (int i = 0; i < 1000; ++i) {
    copies.push_back(good(1, {0.1, 0.1}));
    copies.back().source = "part " + std::to_string(i);
  }
  const Advice a = advise(copies, handbook(), {});
  EXPECT_EQ(a.proven.at, kHandbook);
  EXPECT_EQ(a.edges, 1U);
}

TEST(WrongCases, DaysInTheFutureDoNotCountAsDays) {
  const Setting faster{0.1, 0.1};
  std::vector<Evidence> cases = good_ones(12);
  for (int i = 0; i < 5; ++i) {  // one edge; the clock jumps a year ahead from part to part
    cases.push_back(good(100 + i, faster));
    cases.back().edge = "one edge";
    cases.back().day = 20500 + 365 * i;
  }
  TuneOptions options;
  options.today = 20100;
  const Advice a = advise(cases, handbook(), options);
  EXPECT_EQ(a.days_in_future, 5U);
  EXPECT_EQ(a.proven.at, kHandbook);
  EXPECT_EQ(a.heard, 17U) << "the cuts themselves count";
}

TEST(WrongCases, NumbersThatAreNoneAreRefused) {
  std::vector<Evidence> cases = good_ones(2);
  cases[0].ln_load[kForce] = std::numeric_limits<double>::quiet_NaN();
  cases[1].ln_time = std::numeric_limits<double>::infinity();
  EXPECT_EQ(advise(cases, handbook(), {}).refused.size(), 2U);
}

TEST(Along, TimeFallsAndTheLoadGrowsWithFeed) {
  const std::vector<LinePoint> line = along(good_ones(12), handbook(), {}, kHandbook, true);
  ASSERT_GT(line.size(), 10U);
  EXPECT_GT(line.front().view.time, line.back().view.time);
  EXPECT_LT(line.front().view.limits[0].load, line.back().view.limits[0].load);
}

}  // namespace
}  // namespace capstan::casebase::tune

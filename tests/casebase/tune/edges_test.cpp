#include "casebase/tune/edges.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "casebase/tune/corrections.h"
#include "casebase/tune/from_case.h"
#include "tests/casebase/sample.h"

namespace capstan::casebase::tune {
namespace {

/// Cuts of six minutes by one edge whose life is expected to be an hour.
constexpr double kCutMin = 6.0, kLifeMin = 60.0;

Case cut(const std::string& edge, int part) {
  Case c = sample();
  c.from.tool_instance = edge;
  c.from.part = std::to_string(part);
  c.from.time_utc = "2026-03-02T" + std::to_string(10 + part) + ":00:00Z";
  c.observed.time_s = Figure{60.0 * kCutMin};
  c.predicted.tool_life_min = kLifeMin;
  c.id = id_of(c);
  return c;
}

std::vector<Case> cuts(const std::string& edge, int parts) {
  std::vector<Case> out;
  for (int part = 0; part < parts; ++part) out.push_back(cut(edge, part));
  return out;
}

EdgeUse only(const std::vector<Case>& cases) {
  const auto edges = edges_of(cases);
  EXPECT_EQ(edges.size(), 1U);
  return edges.empty() ? EdgeUse{} : edges.front();
}

TEST(EdgeUse, IsTheSumOfItsCutsOverTheLifeOfEach) {
  auto cases = cuts("E1", 3);
  cases[1].predicted.tool_life_min = 0.5 * kLifeMin;  // twice as hard on the edge
  const EdgeUse e = only(cases);
  EXPECT_NEAR(e.cut_min, 3.0 * kCutMin, 1e-9);
  EXPECT_NEAR(e.used, 4.0 * kCutMin / kLifeMin, 1e-9);
  EXPECT_NEAR(e.left_min(), kLifeMin - 4.0 * kCutMin, 1e-9);
}

TEST(EdgeUse, IsASeriesOverCuttingTime) {
  const EdgeUse e = only(cuts("E1", 4));
  ASSERT_EQ(e.history.size(), 4U);
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_NEAR(e.history[i].cut_min, static_cast<double>(i + 1) * kCutMin, 1e-9);
    EXPECT_NEAR(e.history[i].used, static_cast<double>(i + 1) * kCutMin / kLifeMin, 1e-9);
  }
}

TEST(EdgeUse, WithoutReadingsIsAsUnsureAsALawAndAnEdgeAre) {
  const EdgeUse e = only(cuts("E1", 10));
  EXPECT_NEAR(e.used, 1.0, 1e-9);
  EXPECT_NEAR(e.worn_out(), 0.5, 1e-9);
  EXPECT_NEAR(e.ln_std_dev, std::hypot(kLifeSpread, kLifeScatter), 1e-6);
  EXPECT_LT(only(cuts("E1", 2)).worn_out(), kNearItsEnd);
  EXPECT_GT(only(cuts("E1", 5)).worn_out(), kNearItsEnd);
}

TEST(EdgeUse, AReadingOfTheVeryEdgeGoesBeforeTheLaw) {
  auto cases = cuts("E1", 5);
  const double before = only(cases).used;
  // As worn as after twice the time.
  cases.back().observed.wear_mm = Figure{kWornMm * std::pow(2.0 * before, kWearByTime)};
  const EdgeUse e = only(cases);
  EXPECT_GT(e.used, 1.8 * before);
  EXPECT_LT(e.used, 2.0 * before);
  EXPECT_LT(e.ln_std_dev, only(cuts("E1", 5)).ln_std_dev);
}

TEST(EdgeUse, LivesOfEdgesThatWereFollowedToTheirEndCorrectTheLaw) {
  auto cases = cuts("E1", 5);
  const double before = only(cases).used, spread = only(cases).ln_std_dev;
  for (int other = 0; other < 8; ++other) {
    Case c = cut("followed " + std::to_string(other), 0);
    for (double t = 5.0; t <= 30.0; t += 5.0)  // worn out in half an hour
      c.observed.wear_series_mm.samples.push_back({60.0 * t, kWornMm * std::pow(t / 30.0, kWearByTime)});
    c.predicted.tool_life_min = kLifeMin;
    c.id = id_of(c);
    cases.push_back(c);
  }
  for (const EdgeUse& e : edges_of(cases)) {
    if (e.edge != "E1") continue;
    EXPECT_GT(e.used, 1.6 * before);
    EXPECT_LT(e.used, 2.0 * before);
    EXPECT_LT(e.ln_std_dev, spread);
  }
}

TEST(EdgeUse, CutsOfUnknownLifeAreCountedApart) {
  auto cases = cuts("E1", 3);
  cases[0].predicted.tool_life_min = 0.0;
  cases[1].observed.time_s.reset();
  const EdgeUse e = only(cases);
  EXPECT_EQ(e.unknown, 2U);
  EXPECT_NEAR(e.used, kCutMin / kLifeMin, 1e-9);
}

TEST(EdgeUse, OneCutToldTwiceAndSimulatedOnesWearNothing) {
  auto cases = cuts("E1", 2);
  cases.push_back(cases.front());
  cases.push_back(cut("E1", 7));
  cases.back().origin = Origin::kSimulated;
  EXPECT_NEAR(only(cases).used, 2.0 * kCutMin / kLifeMin, 1e-9);
}

TEST(EdgeUse, CasesWithoutAnEdgeHaveNone) { EXPECT_TRUE(edges_of(cuts("", 3)).empty()); }

TEST(EdgeUse, ABrokenEdgeIsKnownAsSuch) {
  auto cases = cuts("E1", 2);
  EXPECT_FALSE(only(cases).broken);
  cases.back().observed.breakage = Figure{1.0};
  EXPECT_TRUE(only(cases).broken);
}

}  // namespace
}  // namespace capstan::casebase::tune

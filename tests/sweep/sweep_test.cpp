#include "tests/sweep/sweep.h"

#include <gtest/gtest.h>

#include <cstdio>
#include <cstdlib>

// Twelve features of twelve materials on three machines: what every plan promises. `./dev test` plans a
// sample, each of the fifty repetitions of `./dev soak` a share of all, so that together they plan all 432.

namespace capstan::testing::sweep {
namespace {

constexpr int kShares = 50;  ///< repetitions of ./dev soak

void holds(Sweep& sweep, const Case& c, bool tell) {
  const Outcome o = sweep.plan(c);
  const std::string text = broken(c, o);
  EXPECT_EQ(text, "") << c.name();
  if (!tell) return;
  std::string reasons;
  for (const auto& u : o.made.plan.unplanned) reasons += "; not planned: " + u.reason;
  std::printf("%s: %.1f s, catalogue %.1f s, ratio %.2f%s%s%s\n", c.name().c_str(), o.plan_s, o.catalogue_s,
              o.ratio(), text.empty() ? "" : "; BROKEN: ", text.c_str(), reasons.c_str());
  std::fflush(stdout);
}

TEST(SweepProperty, PlansKeepTheLeastChipTheirTolerancesAndLimitsAndRefusalsHelp) {
  static Sweep sweep;
  const bool soak = std::getenv("CAPSTAN_SOAK") != nullptr;
  if (!soak) {
    for (const Case& c : diagonal()) holds(sweep, c, false);
    return;
  }
  const std::vector<Case> all = all_cases();
  const char* only = std::getenv("CAPSTAN_SWEEP_ONLY");
  const auto share = static_cast<std::size_t>(::testing::UnitTest::GetInstance()->random_seed() % kShares);
  for (std::size_t i = share; i < all.size(); i += kShares)
    if (only == nullptr || all[i].name().find(only) != std::string::npos) holds(sweep, all[i], true);
}

TEST(SweepHelp, NeedsAThingAndANumberOrAnOption) {
  EXPECT_TRUE(helps("no reamer of 10 mm in the library"));
  EXPECT_TRUE(helps("state the tool's material (--assume)"));
  EXPECT_FALSE(helps("it cannot be made"));
  EXPECT_FALSE(helps("no tool fits"));
}

TEST(SweepCases, MeetEachFeatureAndEachMaterialOnceInTheSample) {
  std::vector<int> features(12), materials(12), machines(3);
  for (const Case& c : diagonal()) {
    ++features.at(c.feature);
    ++materials.at(c.material);
    ++machines.at(c.machine);
  }
  EXPECT_EQ(features, std::vector<int>(12, 1));
  EXPECT_EQ(materials, std::vector<int>(12, 1));
  EXPECT_EQ(machines, std::vector<int>(3, 4));
  EXPECT_EQ(all_cases().size(), 12U * 12U * 3U);
}

}  // namespace
}  // namespace capstan::testing::sweep

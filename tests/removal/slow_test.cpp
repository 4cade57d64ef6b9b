#include <gtest/gtest.h>

#include <algorithm>

#include "tests/removal/made.h"
#include "tests/removal/parts.h"
#include "tests/support/rs274.h"

// Parts that once took minutes or hours to plan. How long they take now is not asked here.

namespace capstan::testing::removal {
namespace {

CAPSTAN_MADE(RemovalOfSlowParts, MillsAndBoresABlindFlatHoleToItsTolerance, tight_flat_hole())
// The mill leaves 0.25 mm to the boring tool, which alone has to keep 15 um: it need not cut in levels of
// hundredths, which took it 13 minutes.
TEST(RemovalOfSlowParts, AMillBeforeABoreIsHeldByWhatItLeavesForIt) {
  const Outcome o = plan_and_simulate(tight_flat_hole());
  ASSERT_TRUE(o.written()) << o.text();
  EXPECT_LT(o.plan.time_s, 3 * 60.0);
}

CAPSTAN_MADE(RemovalOfSlowParts, MillsTwoFlatHolesThatOverlap, overlapping_flat_holes())
CAPSTAN_MADE(RemovalOfSlowParts, CutsASlotAskewToTheTiles, tilted_slot())
CAPSTAN_MADE(RemovalOfSlowParts, CutsAnOpenPocketBesideABoss, open_pocket_beside_boss())

TEST(RemovalOfSlowParts, AHoleWhoseAxisLiesOutsideIsMadeOrRefused) {
  CAPSTAN_NEEDS_RS274();
  const Outcome o = plan_and_simulate(hole_over_the_side());
  if (o.written()) {
    EXPECT_TRUE(o.verdict.agrees()) << o.text();
  } else {
    EXPECT_FALSE(o.plan.diagnostics.empty());
  }
}

// The cutter is not to blame: no other one is tried.
TEST(RemovalOfSlowParts, APocketDeeperThanItsPieceIsRefusedAndItSaysWhy) {
  const Outcome o = plan_and_simulate(pocket_deeper_than_its_piece());
  EXPECT_FALSE(o.written());
  EXPECT_EQ(o.plan.unplanned, 1U);
  const auto says = [](const PlanMessage& m) {
    return m.text.find("underside of the raw piece") != std::string::npos;
  };
  EXPECT_TRUE(std::any_of(o.plan.diagnostics.begin(), o.plan.diagnostics.end(), says)) << o.text();
}

}  // namespace
}  // namespace capstan::testing::removal

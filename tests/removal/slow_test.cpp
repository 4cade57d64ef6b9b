#include <gtest/gtest.h>

#include <algorithm>
#include <ctime>

#include "tests/removal/parts.h"
#include "tests/support/rs274.h"

// Parts that once took minutes to plan are planned, or refused, in seconds of the processor's time.

namespace capstan::testing::removal {
namespace {

// Each took at least twice as long before. The hole to H7 tries a dozen cutters, each in up to four depths: it
// took 65 s, and hours before that.
constexpr double kMostSeconds = 120.0;

double cpu_seconds() {
  timespec t{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

Outcome within_time(const Part& part) {
  const double before = cpu_seconds();
  Outcome o = plan_and_simulate(part);
  EXPECT_LT(cpu_seconds() - before, kMostSeconds) << part.name;
  return o;
}

void expect_made_soon(const Part& part) {
  const Outcome o = within_time(part);
  ASSERT_TRUE(o.written()) << part.name << ":\n" << o.text();
  EXPECT_EQ(o.plan.unplanned, 0U) << o.text();
  EXPECT_TRUE(o.verdict.agrees()) << part.name << ":\n" << o.text();
}

#define CAPSTAN_MADE_SOON(Claim, part) \
  TEST(RemovalOfSlowParts, Claim) {    \
    CAPSTAN_NEEDS_RS274();             \
    expect_made_soon(part);            \
  }

CAPSTAN_MADE_SOON(MillsAndBoresABlindFlatHoleToItsTolerance, tight_flat_hole())
CAPSTAN_MADE_SOON(MillsTwoFlatHolesThatOverlap, overlapping_flat_holes())
CAPSTAN_MADE_SOON(CutsASlotAskewToTheTiles, tilted_slot())
CAPSTAN_MADE_SOON(CutsAnOpenPocketBesideABoss, open_pocket_beside_boss())

TEST(RemovalOfSlowParts, AHoleWhoseAxisLiesOutsideIsMadeOrRefused) {
  CAPSTAN_NEEDS_RS274();
  const Outcome o = within_time(hole_over_the_side());
  if (o.written()) {
    EXPECT_TRUE(o.verdict.agrees()) << o.text();
  } else {
    EXPECT_FALSE(o.plan.diagnostics.empty());
  }
}

// The cutter is not to blame: no other one is tried.
TEST(RemovalOfSlowParts, APocketDeeperThanItsPieceIsRefusedAndItSaysWhy) {
  const Outcome o = within_time(pocket_deeper_than_its_piece());
  EXPECT_FALSE(o.written());
  EXPECT_EQ(o.plan.unplanned, 1U);
  const auto says = [](const PlanMessage& m) {
    return m.text.find("underside of the raw piece") != std::string::npos;
  };
  EXPECT_TRUE(std::any_of(o.plan.diagnostics.begin(), o.plan.diagnostics.end(), says)) << o.text();
}

}  // namespace
}  // namespace capstan::testing::removal

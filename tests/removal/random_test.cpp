#include <gtest/gtest.h>

#include <cstdlib>

#include "tests/removal/random_part.h"
#include "tests/support/rs274.h"

// Parts drawn from seeds, planned, and their programs simulated: either the program makes the part, or there
// is none and the plan says why.

namespace capstan::testing::removal {
namespace {

void holds(unsigned seed) {
  const RandomPart random = random_part(seed);
  const Outcome o = plan_and_simulate(random.part);
  const std::string broken = broken_promise(random, o);
  EXPECT_TRUE(broken.empty()) << "seed " << seed << ", machine '" << random.part.options.machine << "':\n"
                              << broken << o.text();
}

class RemovalPropertyOfSeed : public ::testing::TestWithParam<unsigned> {};

TEST_P(RemovalPropertyOfSeed, AProgramMakesThePartOrThereIsNone) {
  CAPSTAN_NEEDS_RS274();
  unsigned seed = GetParam();
  if (std::getenv("CAPSTAN_SOAK") != nullptr) {
    // Each of the 50 repetitions takes ten seeds of its own: 500 parts.
    constexpr unsigned kParts = 10;
    if (seed > kParts) return;
    seed += kParts * (3U + static_cast<unsigned>(::testing::UnitTest::GetInstance()->random_seed()));
  }
  holds(seed);
}

INSTANTIATE_TEST_SUITE_P(Parts, RemovalPropertyOfSeed, ::testing::Range(1U, 31U));

}  // namespace
}  // namespace capstan::testing::removal

#include <gtest/gtest.h>

#include <cstdio>
#include <cstdlib>

#include "tests/removal/random_part.h"
#include "tests/support/rs274.h"
#include "tests/support/soak.h"

// Parts drawn from seeds, planned, and their programs simulated: either the program makes the part, or there
// is none and the plan says why. Refusals are counted: with the ordinary machine and the whole library most
// features must be made.

namespace capstan::testing::removal {
namespace {

constexpr unsigned kSeeds = 12;  ///< a sample of those that ./dev soak draws
constexpr unsigned kSoakedAtOnce =
    10;  // each of the 50 repetitions takes as many seeds of its own: 500 parts
// Measured: 97 % of the features of 30 seeds, 93 % of those of 130. The rest has no cutter in the library
// (a ball of 6.5 mm, a boring tool of 6.5 mm), is deeper than twelve diameters, or is finer than a bore can
// be measured. The floor leaves room for a draw with more of these, not for a kind of feature that is
// refused.
constexpr double kLeastShare = 0.85;
// Features, before a share of them says anything: CI's seeds are always the same, a soak's are not. Of 28 a
// share of 82 % is met once in 25 draws.
constexpr std::size_t kEnough = 25, kEnoughSoaked = 100;

Share& made_so_far() {
  static Share share;
  return share;
}

void holds(unsigned seed, bool tell) {
  const RandomPart random = random_part(seed);
  const Outcome o = plan_and_simulate(random.part);
  const std::string broken = broken_promise(random, o);
  EXPECT_TRUE(broken.empty()) << "seed " << seed << ", machine '" << random.part.options.machine
                              << "', tools '" << random.part.options.tools << "':\n"
                              << broken << o.text();
  EXPECT_EQ(lost_in_a_form(random.part, o.plan), "")
      << "seed " << seed << ", machine '" << random.part.options.machine << "', tools '"
      << random.part.options.tools << "'";
  const Share share = planned_share(random, o);
  if (random.whole_shop) {
    made_so_far().planned += share.planned;
    made_so_far().drawn += share.drawn;
  }
  if (!tell) return;
  std::printf("seed %u: %zu of %zu features planned%s%s\n", seed, share.planned, share.drawn,
              random.whole_shop ? "" : " (small shop)", broken.empty() ? "" : ", BROKEN");
  std::fflush(stdout);
}

TEST(RemovalPropertyOfSeeds, ProgramsMakeTheirPartsAndMostFeaturesArePlanned) {
  CAPSTAN_NEEDS_RS274();
  // One seed by its number, to look into it.
  if (const char* one = std::getenv("CAPSTAN_SEED"); one != nullptr)
    return holds(static_cast<unsigned>(std::strtoul(one, nullptr, 10)), true);
  const bool soak = soaking();
  unsigned first = 1;
  unsigned count = kSeeds;
  if (soak) {
    count = kSoakedAtOnce;
    first +=
        kSeeds + kSoakedAtOnce * static_cast<unsigned>(::testing::UnitTest::GetInstance()->random_seed() - 1);
  }
  for (unsigned seed = first; seed < first + count; ++seed) holds(seed, soak);
  const Share& s = made_so_far();
  const double share =
      static_cast<double>(s.planned) / static_cast<double>(std::max<std::size_t>(s.drawn, 1));
  std::printf("with the ordinary machine and the whole library: %zu of %zu features planned, %.0f %%\n",
              s.planned, s.drawn, 100.0 * share);
  RecordProperty("planned_percent", static_cast<int>(100.0 * share));
  if (s.drawn >= (soak ? kEnoughSoaked : kEnough)) {
    EXPECT_GE(share, kLeastShare);
  }
}

}  // namespace
}  // namespace capstan::testing::removal

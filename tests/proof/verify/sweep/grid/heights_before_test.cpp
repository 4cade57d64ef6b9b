#include "planner/proof/verify/sweep/grid/heights_before.h"

#include <gtest/gtest.h>

#include "planner/ground/base/job.h"
#include "planner/ground/base/stopping.h"

namespace capstan::verify {
namespace {

constexpr std::size_t kCells = 200'000;

TEST(SweepHeightsBefore, OfALevelFaceAreOneNumber) {
  std::vector<double> now(kCells, 20.0);
  HeightsBefore before;
  before.keep(now);
  now.assign(kCells, 5.0);  // what is cut since is no matter
  EXPECT_EQ(before.numbers(), 1U);
  EXPECT_EQ(before.cells(), kCells);
  EXPECT_EQ(before[0], 20.0);
  EXPECT_EQ(before[kCells - 1], 20.0);
}

TEST(SweepHeightsBefore, OfAFaceWithOneOtherCellAreThoseOfEachCell) {
  for (const std::size_t other : {std::size_t{0}, kCells / 2, kCells - 1}) {
    std::vector<double> now(kCells, 20.0);
    now[other] = 19.0;
    HeightsBefore before;
    before.keep(now);
    EXPECT_EQ(before.numbers(), kCells);
    EXPECT_EQ(before[other], 19.0);
    EXPECT_EQ(before[other == 0 ? 1 : 0], 20.0);
  }
}

TEST(SweepHeightsBefore, KeptAnewForgetThoseOfEachCell) {
  std::vector<double> now = {1.0, 2.0};
  HeightsBefore before;
  before.keep(now);
  before.keep({3.0, 3.0, 3.0});
  EXPECT_EQ(before.cells(), 3U);
  EXPECT_EQ(before.numbers(), 1U);
  EXPECT_EQ(before[1], 3.0);
}

TEST(SweepHeightsBefore, AskWhetherToStopWhileTheyAreKept) {
  Job job;
  job.request_stop();
  const StopScope scope(job);
  HeightsBefore before;
  EXPECT_THROW(before.keep(std::vector<double>(kCells, 1.0)), Stopped);
}

}  // namespace
}  // namespace capstan::verify

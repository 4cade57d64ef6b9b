#include <gtest/gtest.h>

#include "planner/ground/base/job.h"
#include "planner/ground/base/stopping.h"
#include "planner/proof/verify/sweep/grid/closer_look.h"
#include "planner/proof/verify/sweep/grid/grid.h"

namespace capstan::verify {
namespace {

constexpr long kCells = 1000 * 1000;

TEST(SweepGrid, AsksWhetherToStopWhileItsCellsAreMadeAndCopied) {
  const Grid made({0.0, 0.0}, {100.0, 100.0}, 0.1, kCells);
  ASSERT_EQ(made.stock.size(), static_cast<std::size_t>(kCells));
  for (const auto* heights : {&made.stock, &made.part, &made.base}) {
    ASSERT_EQ(heights->size(), made.stock.size());
    EXPECT_EQ(heights->front(), Grid::kNothing);
    EXPECT_EQ(heights->back(), Grid::kNothing);
  }
  Job job;
  job.request_stop();
  const StopScope scope(job);
  EXPECT_THROW(Grid({0.0, 0.0}, {100.0, 100.0}, 0.1, kCells), Stopped);
  EarlierCuts earlier;
  EXPECT_THROW(earlier.begin(made), Stopped);
}

}  // namespace
}  // namespace capstan::verify

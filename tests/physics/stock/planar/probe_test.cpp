#include "planner/physics/stock/planar/probe.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <vector>

namespace capstan::stock {
namespace {

/// Heights on a fixed grid of equal cells: what is lowered is lowered cell by cell.
constexpr int kCells = 64;

TEST(HeightsSeeds, LowerWhatLiesBetweenAndNothingElse) {
  for (std::uint32_t seed = 1; seed <= 300; ++seed) {
    std::mt19937 random(seed);
    Heights heights;
    heights.reset(0.0, kCells, 10.0);
    std::vector<double> cells(kCells, 10.0);
    for (int i = 0; i < 60; ++i) {
      const int from = static_cast<int>(random() % kCells);
      const int to = from + 1 + static_cast<int>(random() % static_cast<unsigned>(kCells - from));
      const double z = static_cast<double>(random() % 12);  // few heights, so that neighbours become one
      bool any = false;
      for (int c = from; c < to; ++c) any = any || cells[static_cast<std::size_t>(c)] > z;
      for (int c = from; c < to; ++c)
        cells[static_cast<std::size_t>(c)] = std::min(cells[static_cast<std::size_t>(c)], z);
      ASSERT_EQ(heights.lower(from, to, z), any) << "seed " << seed << ", cut " << i;
      std::size_t c = 0;
      double at = 0.0;
      for (std::size_t k = 0; k < heights.pieces().size(); ++k) {
        const Heights::Piece& p = heights.pieces()[k];
        ASSERT_EQ(p.x0, at) << "seed " << seed << ", cut " << i << ": without gaps";
        ASSERT_GT(p.x1, p.x0);
        ASSERT_TRUE(k == 0 || heights.pieces()[k - 1].z_mm != p.z_mm)
            << "neighbours of one height are one piece";
        for (; c < kCells && static_cast<double>(c) < p.x1; ++c)
          ASSERT_EQ(p.z_mm, cells[c]) << "seed " << seed << ", cut " << i << ", cell " << c;
        at = p.x1;
      }
      ASSERT_EQ(at, kCells);
    }
  }
}

TEST(Heights, LeaveWhatIsLowAlready) {
  Heights heights;
  heights.reset(-1.0, 1.0, 2.0);
  EXPECT_FALSE(heights.lower(-1.0, 1.0, 2.0));
  EXPECT_FALSE(heights.lower(1.0, 2.0, 0.0)) << "beside it";
  EXPECT_FALSE(heights.lower(-2.0, -1.0, 0.0)) << "beside it";
  EXPECT_EQ(heights.pieces().size(), 1U);
}

}  // namespace
}  // namespace capstan::stock

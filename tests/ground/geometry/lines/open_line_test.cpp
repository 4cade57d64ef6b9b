#include "planner/ground/geometry/lines/open_line.h"

#include <gtest/gtest.h>

namespace capstan::geometry {
namespace {

TEST(OpenLine, IsAsFarAsItsNearestPiece) {
  const std::vector<Vec2> bend{{0.0, 0.0}, {10.0, 0.0}, {10.0, 10.0}};
  EXPECT_DOUBLE_EQ(distance_to_line(bend, {4.0, 3.0}), 3.0);    // square to the first piece
  EXPECT_DOUBLE_EQ(distance_to_line(bend, {8.0, 9.0}), 2.0);    // square to the second
  EXPECT_DOUBLE_EQ(distance_to_line(bend, {-3.0, -4.0}), 5.0);  // its end: 3, 4, 5
  EXPECT_DOUBLE_EQ(distance_to_line(bend, {13.0, 14.0}), 5.0);  // the other end
}

TEST(OpenLine, IsNotClosed) {
  const std::vector<Vec2> bend{{0.0, 0.0}, {10.0, 0.0}, {10.0, 10.0}};
  // (5, 5) lies on the line that would close it, 5 mm from both pieces.
  EXPECT_DOUBLE_EQ(distance_to_line(bend, {5.0, 5.0}), 5.0);
}

TEST(OpenLine, OfOnePointIsNowhere) { EXPECT_DOUBLE_EQ(distance_to_line({{0.0, 0.0}}, {1.0, 0.0}), 1e300); }

}  // namespace
}  // namespace capstan::geometry

#include "planner/model/nouns/placed_nouns.h"

#include <gtest/gtest.h>

#include <cmath>

#include "planner/model/features/resolve.h"

namespace capstan::model {
namespace {

TEST(PlacedNouns, APlacementIsReadBackAsTheFrameItWasMadeFrom) {
  geometry::Placement at;  // a quarter turn about x, away from the origin
  at.origin = {1.0, 2.0, 3.0};
  at.y = {0.0, 0.0, 1.0};
  at.z = {0.0, -1.0, 0.0};
  Model m;
  const auto noun = add_placement(m, at, "there");
  EXPECT_EQ(m.get<Axis2Placement3d>(noun)->name, "there");
  const auto read = placement(m, noun);
  ASSERT_TRUE(read);
  EXPECT_EQ(*read, at);
}

TEST(PlacedNouns, APlacementOfALocationAloneHasTheAxesOfItsFrame) {
  Model m;
  const auto noun = add_placement_at(m, {4.0, 5.0, 6.0});
  EXPECT_FALSE(m.get<Axis2Placement3d>(noun)->axis.set());
  const auto read = placement(m, noun);
  ASSERT_TRUE(read);
  EXPECT_EQ(*read, (geometry::Placement{.origin = {4.0, 5.0, 6.0}}));
}

TEST(PlacedNouns, NoNumberIsMinusZero) {
  Model m;
  const auto* point = m.get<CartesianPoint>(add_point(m, {-0.0, 1.0, -0.0}));
  for (const double c : point->coordinates.items) EXPECT_FALSE(std::signbit(c));
  const auto* along = m.get<Direction>(add_direction(m, {-0.0, -0.0, 1.0}));
  for (const double c : along->direction_ratios.items) EXPECT_FALSE(std::signbit(c));
}

}  // namespace
}  // namespace capstan::model

#include "planner/controls/gcode/moves/patterns.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "tests/controls/control_plans.h"

namespace capstan::controls::gcode {
namespace {

using geometry::Vec2;
using Places = std::vector<Vec2>;

TEST(GcodePatterns, ARowHasEqualStepsAlongOneLine) {
  const auto row = row_of(Places{{10, 20}, {13, 24}, {16, 28}}, 3);
  ASSERT_TRUE(row);
  EXPECT_NEAR(row->angle_deg, std::atan2(4.0, 3.0) * 180.0 / std::numbers::pi, 1e-6);
  EXPECT_DOUBLE_EQ(row->step_mm, 5.0);
  const auto back = row_of(Places{{30, 5}, {20, 5}, {10, 5}}, 3);
  ASSERT_TRUE(back);
  EXPECT_DOUBLE_EQ(back->angle_deg, 180.0);
}

// A micrometre is a unit of these places: what is off by one is another place.
TEST(GcodePatterns, APlaceThatIsOffByAUnitIsOfNoRow) {
  EXPECT_FALSE(row_of(Places{{0, 0}, {10.001, 0}, {20, 0}}, 3));
  EXPECT_FALSE(row_of(Places{{0, 0}, {10, 0.001}, {20, 0}}, 3));
  EXPECT_FALSE(row_of(Places{{0, 0}, {10, 0}}, 3));
}

TEST(GcodePatterns, ARingHasEqualAnglesCounterClockwise) {
  const auto whole = ring_of(plans::ring({50, 40}, 30, -30, 60, 6), 3);
  ASSERT_TRUE(whole);
  EXPECT_DOUBLE_EQ(whole->centre.x, 50.0);
  EXPECT_DOUBLE_EQ(whole->centre.y, 40.0);
  EXPECT_DOUBLE_EQ(whole->radius_mm, 30.0);
  EXPECT_DOUBLE_EQ(whole->first_deg, -30.0);
  EXPECT_DOUBLE_EQ(whole->step_deg, 60.0);
  const auto part = ring_of(plans::ring({0, 0}, 100, 170, 25, 4), 3);
  ASSERT_TRUE(part);
  EXPECT_DOUBLE_EQ(part->first_deg, 170.0);
  EXPECT_DOUBLE_EQ(part->step_deg, 25.0);
  EXPECT_FALSE(ring_of(plans::ring({0, 0}, 100, 170, -25, 4), 3));
}

TEST(GcodePatterns, AnyThreePlacesAreNoRingUnlessTheyDivideTheCircle) {
  EXPECT_FALSE(ring_of(Places{{0, 0}, {10, 0}, {10, 10}}, 3));
  EXPECT_TRUE(ring_of(plans::ring({0, 0}, 20, 90, 120, 3), 3));
}

TEST(GcodePatterns, APlaceOffTheRingByAUnitIsOfNone) {
  Places places = plans::ring({50, 40}, 30, 0, 60, 6);
  places[3].x += 0.001;
  EXPECT_FALSE(ring_of(places, 3));
}

}  // namespace
}  // namespace capstan::controls::gcode

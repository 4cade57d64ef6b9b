#include "planner/model/plan/resources/setup_position.h"

#include <gtest/gtest.h>

namespace capstan::model {
namespace {

using geometry::Vec3;

geometry::Placement lying(Vec3 axis, Vec3 ref, Vec3 origin = {}) {
  return *geometry::make_placement(origin, axis, ref);
}

TEST(SetupPosition, ATurnIsToldByTheWorkpiecesOwnAxisAndAngle) {
  const geometry::Placement flat;
  EXPECT_EQ(turn_text(flat, flat), "not turned");
  EXPECT_EQ(turn_text(flat, lying({0, 0, -1}, {1, 0, 0})), "turned over, 180 deg about its X axis");
  EXPECT_EQ(turn_text(flat, lying({0, 0, -1}, {-1, 0, 0})), "turned over, 180 deg about its Y axis");
  EXPECT_EQ(turn_text(flat, lying({0, 0, 1}, {0, 1, 0})), "turned 90 deg about its Z axis");
  EXPECT_EQ(turn_text(flat, lying({0, 0, 1}, {0, -1, 0})), "turned 90 deg about its -Z axis");
  // Its z to the front, its x as before: a quarter turn, right-handed about its own x.
  EXPECT_EQ(turn_text(flat, lying({0, -1, 0}, {1, 0, 0})), "turned 90 deg about its X axis");
  // Half a turn about the diagonal: x to y and y to x.
  EXPECT_EQ(turn_text(flat, lying({0, 0, -1}, {0, 1, 0})),
            "turned over, 180 deg about its (0.707, 0.707, 0) axis");
  // From one that lies on its side already, about the axis as the piece has it.
  EXPECT_EQ(turn_text(lying({0, -1, 0}, {1, 0, 0}), lying({0, 1, 0}, {1, 0, 0})),
            "turned over, 180 deg about its X axis");
}

TEST(SetupPosition, ZeroIsToldBySidesOfTheRawPieceAsItLies) {
  geometry::Box3 raw;
  raw.add({-5, -5, -30});
  raw.add({105, 65, 2});
  EXPECT_EQ(zero_text(raw, {}, 3),
            "X0 5 mm right of its left side, Y0 5 mm behind its front, Z0 30 mm above "
            "its underside");
  // Turned over about x with zero at its lower left corner: the old top is the underside.
  EXPECT_EQ(zero_text(raw, lying({0, 0, -1}, {1, 0, 0}, {5, 65, 2}), 3),
            "X0 at its left side, Y0 at its front, Z0 at its underside");
  EXPECT_EQ(zero_text(raw, lying({0, 0, 1}, {1, 0, 0}, {15, -65, -2}), 3),
            "X0 10 mm left of its left side, Y0 at its back, Z0 at its top");
  EXPECT_EQ(zero_text(raw, lying({0, 0, 1}, {1, 1, 0}), 3), "") << "askew";
}

}  // namespace
}  // namespace capstan::model

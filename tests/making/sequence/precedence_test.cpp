#include "planner/making/sequence/precedence.h"

#include <gtest/gtest.h>

namespace capstan::sequence {
namespace {

using geometry::Vec3;
using model::FeatureShape;
using model::ShapeKind;

/// A square of 2 half at `origin`, entered from +z.
FeatureShape square(ShapeKind kind, Vec3 origin, double half, double depth) {
  FeatureShape s;
  s.kind = kind;
  s.frame.origin = origin;
  s.depth_mm = depth;
  s.area = s.reach = geometry::rectangle({-half, -half}, {half, half});
  return s;
}

/// Turned about x: entered from -z.
FeatureShape from_below(FeatureShape s) {
  s.frame.y = {0, -1, 0};
  s.frame.z = {0, 0, -1};
  return s;
}

FeatureShape through_hole(FeatureShape s) {
  s.through = true;
  s.diameter.nominal_mm = s.bottom_diameter_mm = 6.0;
  return s;
}

std::vector<FeaturePair> pairs(const std::vector<FeatureShape>& shapes) {
  return geometric_pairs(shapes, access_of(shapes, {}));
}

void expect_one(const std::vector<FeatureShape>& shapes, std::size_t before, std::size_t after, Cause cause) {
  const auto found = pairs(shapes);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].before, before);
  EXPECT_EQ(found[0].after, after);
  EXPECT_EQ(found[0].cause, cause);
}

TEST(Access, IsByTheSideAFeatureIsEnteredFromWantedSidesFirst) {
  const FeatureShape top = square(ShapeKind::kPocket, {0, 0, 0}, 10, 5);
  const std::vector<FeatureShape> shapes{top, from_below(top), top};
  const Access as_met = access_of(shapes, {});
  EXPECT_EQ(as_met.directions.size(), 2U);
  EXPECT_EQ(as_met.of_feature, (std::vector<std::size_t>{0, 1, 0}));
  Options options;
  options.directions = {{0, 0, -3}};
  EXPECT_EQ(access_of(shapes, options).of_feature, (std::vector<std::size_t>{1, 0, 1}));
}

TEST(Access, OfAThroughHoleIsTheOtherSideWhereOnlyThatOneIsThere) {
  const FeatureShape pocket = square(ShapeKind::kPocket, {0, 0, 0}, 10, 5);
  const FeatureShape through = through_hole(square(ShapeKind::kHole, {30, 0, 0}, 3, 20));
  const Access a = access_of({from_below(pocket), through}, {});
  EXPECT_EQ(a.directions.size(), 1U) << "no clamping for the hole alone";
  EXPECT_EQ(a.of_feature, (std::vector<std::size_t>{0, 0}));
  EXPECT_EQ(access_of({from_below(pocket), through, pocket}, {}).of_feature,
            (std::vector<std::size_t>{0, 1, 1}));
}

// A face of 1 mm at z 0 over all; a pocket begins at its floor.
TEST(GeometricPairs, AFaceComesBeforeWhatBeginsInIt) {
  expect_one({square(ShapeKind::kPocket, {0, 0, -1}, 10, 5), square(ShapeKind::kFace, {0, 0, 0}, 50, 1)}, 1,
             0, Cause::kFaceFirst);
}

// The pocket's floor is at z -5: what begins there, or above within it, comes after; deeper there is solid
// material between, and beside it nothing.
TEST(GeometricPairs, APocketComesBeforeWhatBeginsAtItsFloorAndNotBesideIt) {
  const FeatureShape pocket = square(ShapeKind::kPocket, {0, 0, 0}, 10, 5);
  expect_one({square(ShapeKind::kHole, {2, 2, -5}, 3, 10), pocket}, 1, 0, Cause::kLiesIn);
  EXPECT_TRUE(pairs({square(ShapeKind::kHole, {2, 2, -7}, 3, 10), pocket}).empty());
  EXPECT_TRUE(pairs({square(ShapeKind::kHole, {40, 2, -5}, 3, 10), pocket}).empty());
  EXPECT_TRUE(pairs({from_below(square(ShapeKind::kHole, {2, 2, -5}, 3, 10)), pocket}).empty())
      << "of another side";
}

TEST(GeometricPairs, AThreadFollowsTheHoleOfItsAxisOnly) {
  const FeatureShape hole = square(ShapeKind::kHole, {0, 0, 0}, 3, 10);
  expect_one({square(ShapeKind::kThread, {0, 0, 0}, 3, 8), hole}, 1, 0, Cause::kThread);
  EXPECT_TRUE(pairs({square(ShapeKind::kThread, {1, 0, 0}, 3, 8), hole}).empty());
}

// A chamfer at the pocket's rim begins where the pocket begins.
TEST(GeometricPairs, AnEdgeFollowsWhatItBreaks) {
  expect_one(
      {square(ShapeKind::kChamfer, {0, 0, 0}, 10.5, 0.5), square(ShapeKind::kPocket, {0, 0, 0}, 10, 5)}, 1, 0,
      Cause::kEdge);
}

// 1 mm and 3 mm from the same plane, overlapping in a stripe: the shallow one first; side by side, neither.
TEST(GeometricPairs, TheShallowerOfTwoFacesThatOverlapComesFirst) {
  const FeatureShape deep = square(ShapeKind::kFace, {0, 0, 0}, 20, 3);
  expect_one({deep, square(ShapeKind::kFace, {30, 0, 0}, 25, 1)}, 1, 0, Cause::kFaceFirst);
  EXPECT_TRUE(pairs({deep, square(ShapeKind::kFace, {45, 0, 0}, 25, 1)}).empty());
}

}  // namespace
}  // namespace capstan::sequence

#include "planner/ground/geometry/placement.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace capstan::geometry {
namespace {

// Of lengths up to 1000 mm: some hundred roundings of 1e-16 of them.
constexpr double kRounding = 1e-11;

void expect_near(Vec3 a, Vec3 b) { EXPECT_LT(norm(a - b), kRounding) << a.x << " " << a.y << " " << a.z; }

Vec3 random_vector(std::mt19937& random, double size) {
  std::uniform_real_distribution<double> at(-size, size);
  return {at(random), at(random), at(random)};
}
Placement random_placement(std::mt19937& random) {
  return make_placement(random_vector(random, 1000.0), random_vector(random, 1.0), random_vector(random, 1.0))
      .value();
}

// Placed at (10, 20, 30), z along the parent's x, x along its y: by the right hand y lies along its z.
const Placement kTurned =
    make_placement({10, 20, 30}, {2, 0, 0}, {5, 3, 0}).value();  // the ref_direction leans towards the axis

TEST(MakePlacement, ProjectsTheReferenceOntoThePlaneAcrossTheAxisAndCompletesARightHand) {
  EXPECT_EQ(kTurned.origin, (Vec3{10, 20, 30}));
  expect_near(kTurned.z, {1, 0, 0});
  expect_near(kTurned.x, {0, 1, 0});
  expect_near(kTurned.y, {0, 0, 1});
}

TEST(MakePlacement, TakesXAsItsReferenceAndYWhereTheAxisLiesAlongX) {
  expect_near(make_placement({}, {0, 0, 4})->x, {1, 0, 0});
  expect_near(make_placement({}, {0, -1, 0})->x, {1, 0, 0});
  for (const double sign : {1.0, -1.0}) {
    const auto p = make_placement({}, {sign, 0, 0});
    ASSERT_TRUE(p);
    expect_near(p->x, {0, 1, 0});
    expect_near(p->y, {0, 0, sign});
  }
}

TEST(MakePlacement, RefusesDirectionsThatSpanNoPlane) {
  const double nan = std::nan("");
  for (const auto& [axis, reference] : {std::pair<Vec3, Vec3>{{0, 0, 0}, {1, 0, 0}},
                                        {{0, 0, 1}, {0, 0, 0}},
                                        {{0, 0, 1}, {0, 0, -3}},
                                        {{1, 1, 1}, {1, 1, 1 + 1e-12}},
                                        {{nan, 0, 1}, {1, 0, 0}},
                                        {{0, 0, 1}, {nan, 0, 0}}}) {
    const auto p = make_placement({}, axis, reference);
    ASSERT_FALSE(p);
    EXPECT_EQ(p.error().code, "GEO-DIRECTION");
  }
  EXPECT_EQ(make_placement({}, {0, 0, 0}).error().code, "GEO-DIRECTION");
  EXPECT_TRUE(make_placement({}, {0, 0, 1}, {1e-6, 0, 1})) << "a micrometre per metre apart";
}

TEST(Placement, TakesLocalPointsAndDirectionsToTheParent) {
  // 1 along y, 2 along z, 3 along x of the parent.
  EXPECT_EQ(kTurned.to_parent({1, 2, 3}), (Vec3{13, 21, 32}));
  EXPECT_EQ(kTurned.direction_to_parent({1, 2, 3}), (Vec3{3, 1, 2}));
  EXPECT_EQ(kTurned.to_local({13, 21, 32}), (Vec3{1, 2, 3}));
}

TEST(PlacementProperty, KeepsLengthsAndHandAndComesBack) {
  std::mt19937 random(1);
  for (int i = 0; i < 1000; ++i) {
    const Placement p = random_placement(random);
    const Vec3 a = random_vector(random, 1000.0), b = random_vector(random, 1.0);
    expect_near(p.to_local(p.to_parent(a)), a);
    EXPECT_NEAR(norm(p.direction_to_parent(a)), norm(a), kRounding);
    expect_near(p.direction_to_parent(cross(a, b)),
                cross(p.direction_to_parent(a), p.direction_to_parent(b)));
  }
}

TEST(PlacementProperty, ComposedIsTheOneAfterTheOther) {
  std::mt19937 random(2);
  for (int i = 0; i < 1000; ++i) {
    const Placement outer = random_placement(random), inner = random_placement(random);
    const Vec3 a = random_vector(random, 1000.0);
    expect_near(compose(outer, inner).to_parent(a), outer.to_parent(inner.to_parent(a)));
  }
}

TEST(PlacementProperty, InverseUndoesItOnEitherSide) {
  std::mt19937 random(3);
  for (int i = 0; i < 1000; ++i) {
    const Placement p = random_placement(random);
    const Vec3 a = random_vector(random, 1000.0);
    expect_near(inverse(p).to_parent(a), p.to_local(a));
    for (const Placement& none : {compose(p, inverse(p)), compose(inverse(p), p)})
      expect_near(none.to_parent(a), a);
  }
}

TEST(Transformed, IsTheBoxAroundTheTurnedBox) {
  // 2 x 4 x 6 about the origin by an eighth of a turn about z: (2 + 4) / sqrt(2) wide and deep.
  const auto turned = make_placement({100, 0, 0}, {0, 0, 1}, {1, 1, 0});
  ASSERT_TRUE(turned);
  const Box3 box = transformed({.lo = {-1, -2, -3}, .hi = {1, 2, 3}}, *turned);
  const double half = 3.0 / std::sqrt(2.0);
  expect_near(box.lo, {100 - half, -half, -3});
  expect_near(box.hi, {100 + half, half, 3});
}

TEST(TransformedProperty, HoldsEveryPointOfTheBoxAndNoMore) {
  std::mt19937 random(4);
  std::uniform_real_distribution<double> share(0.0, 1.0);
  for (int i = 0; i < 200; ++i) {
    const Placement to = random_placement(random);
    Box3 box;
    box.add(random_vector(random, 100.0));
    box.add(random_vector(random, 100.0));
    const Box3 out = transformed(box, to);
    for (int k = 0; k < 50; ++k) {
      const Vec3 size = box.size();
      const Vec3 p =
          to.to_parent(box.lo + Vec3{share(random) * size.x, share(random) * size.y, share(random) * size.z});
      EXPECT_TRUE(p.x >= out.lo.x - kRounding && p.x <= out.hi.x + kRounding);
      EXPECT_TRUE(p.y >= out.lo.y - kRounding && p.y <= out.hi.y + kRounding);
      EXPECT_TRUE(p.z >= out.lo.z - kRounding && p.z <= out.hi.z + kRounding);
    }
    // By each axis of the parent the size is the sum of what the three sides reach along it.
    const Vec3 s = box.size();
    const Vec3 reach{std::abs(to.x.x) * s.x + std::abs(to.y.x) * s.y + std::abs(to.z.x) * s.z,
                     std::abs(to.x.y) * s.x + std::abs(to.y.y) * s.y + std::abs(to.z.y) * s.z,
                     std::abs(to.x.z) * s.x + std::abs(to.y.z) * s.y + std::abs(to.z.z) * s.z};
    expect_near(out.size(), reach);
  }
}

}  // namespace
}  // namespace capstan::geometry

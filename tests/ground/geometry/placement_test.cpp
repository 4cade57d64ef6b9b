#include "planner/ground/geometry/placement.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace capstan::geometry {
namespace {

void expect_near(Vec3 a, Vec3 b, double within = 1e-12) {
  EXPECT_NEAR(a.x, b.x, within);
  EXPECT_NEAR(a.y, b.y, within);
  EXPECT_NEAR(a.z, b.z, within);
}

// z up the old x, x towards the old y: the third is z cross x = x cross y = the old z.
const Placement kTurned = make_placement({10, 20, 30}, {5, 0, 0}, {0, 2, 0}).value();

TEST(Placement, IsRightHandedAndOfUnitLength) {
  expect_near(kTurned.z, {1, 0, 0});
  expect_near(kTurned.x, {0, 1, 0});
  expect_near(kTurned.y, {0, 0, 1});
  expect_near(kTurned.to_parent({1, 2, 3}), {10 + 3, 20 + 1, 30 + 2});
}

TEST(Placement, TakesOfItsReferenceWhatIsSquareToTheAxis) {
  // (3, 0, 4) less its part along z is (3, 0, 0).
  const auto p = make_placement({}, {0, 0, 1}, {3, 0, 4});
  ASSERT_TRUE(p);
  expect_near(p->x, {1, 0, 0});
  expect_near(p->y, {0, 1, 0});
}

TEST(Placement, WithoutAReferenceTakesXOrYAlongX) {
  expect_near(make_placement({}, {0, 0, 1})->x, {1, 0, 0});
  expect_near(make_placement({}, {-2, 0, 0})->x, {0, 1, 0});
  // (1, 0, 1) / sqrt 2: of x stays (1, 0, -1) / 2, so the direction (1, 0, -1) / sqrt 2.
  expect_near(make_placement({}, {1, 0, 1})->x, {std::sqrt(0.5), 0, -std::sqrt(0.5)});
}

TEST(Placement, RefusesDirectionsThatAreNone) {
  for (const auto& p : {make_placement({}, {0, 0, 0}, {1, 0, 0}), make_placement({}, {0, 0, 1}, {0, 0, 0}),
                        make_placement({}, {0, 0, 1}, {0, 0, -7}), make_placement({}, {0, 0, 0})}) {
    ASSERT_FALSE(p);
    EXPECT_EQ(p.error().code, "GEO-DIRECTION");
  }
}

TEST(Placement, ItsInverseAndItsComponentsUndoEachOther) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> any(-50.0, 50.0);
  for (int i = 0; i < 100; ++i) {
    const auto vec = [&] { return Vec3{any(random), any(random), any(random)}; };
    const Placement a = make_placement(vec(), vec(), vec()).value();
    const Placement b = make_placement(vec(), vec(), vec()).value();
    const Vec3 p = vec();
    expect_near(a.to_local(a.to_parent(p)), p, 1e-11);
    expect_near(inverse(a).to_parent(p), a.to_local(p), 1e-11);
    expect_near(compose(a, b).to_parent(p), a.to_parent(b.to_parent(p)), 1e-11);
    expect_near(compose(a, inverse(a)).to_parent(p), p, 1e-11);
  }
}

TEST(TransformedBox, HoldsAllCornersOfTheBox) {
  const Box3 box{{0, 0, 0}, {1, 2, 3}};
  const Box3 out = transformed(box, kTurned);  // x goes to y, y to z, z to x
  expect_near(out.lo, {10, 20, 30});
  expect_near(out.hi, {13, 21, 32});
}

}  // namespace
}  // namespace capstan::geometry

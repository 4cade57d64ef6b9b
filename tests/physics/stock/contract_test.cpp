#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>
#include <vector>

#include "planner/physics/stock/height_map.h"
#include "planner/physics/stock/planar/planar_stock.h"
#include "planner/physics/stock/sweep.h"

// What every representation of the stock keeps. One that is added gets a `Held` of its own here, and its name
// in `Representations`.

namespace capstan::stock {
namespace {

using geometry::Box3;
using geometry::Vec2;
using model::CutterPath;
using model::MoveRole;

constexpr double kPi = std::numbers::pi;
const Box3 kBlock{{0.0, 0.0, -10.0}, {60.0, 40.0, 0.0}};
constexpr double kBarRadius = 15.0;
constexpr double kCell = 0.25;  // mm, of the map

template <class Representation>
struct Held;

template <>
struct Held<HeightMap> {
  static HeightMap block() { return from_box(kBlock, kCell); }
  static HeightMap bar() { return from_cylinder(kBlock, kBarRadius, kCell); }
  static void take(HeightMap& s, const geometry::CutterProfile& tool, const CutterPath& path) {
    cut(s, tool, path);
  }
  static double volume_of(const HeightMap& s) { return volume(s); }
  /// By how much a wall may lie off, mm: a column knows the share of its cell that is cut, within this part
  /// of it.
  static constexpr double kWallMm = 0.02 * kCell;

  using Before = Patch;
  static Before before(HeightMap& s) {
    return patch_of(s, {kBlock.lo.x, kBlock.lo.y}, {kBlock.hi.x, kBlock.hi.y});
  }
  static void undo(HeightMap& s, const Before& b) { put_back(s, b); }
};

template <>
struct Held<PlanarStock> {
  static PlanarStock block() { return PlanarStock::from_box(kBlock); }
  static PlanarStock bar() { return PlanarStock::from_cylinder(kBlock, kBarRadius); }
  static void take(PlanarStock& s, const geometry::CutterProfile& tool, const CutterPath& path) {
    ASSERT_TRUE(s.cut(tool, path));
  }
  static double volume_of(const PlanarStock& s) { return s.volume(); }
  static constexpr double kWallMm = 1e-6;

  using Before = PlanarStock::Mark;
  static Before before(PlanarStock& s) { return s.mark(); }
  static void undo(PlanarStock& s, const Before& b) { s.put_back(b); }
};

double at(const HeightMap& s, Vec2 p) { return height_at(s, p); }
double at(const PlanarStock& s, Vec2 p) { return s.height_at(p); }

/// Heights at the middles of cells, each 1 mm.
template <class Representation>
std::vector<double> heights(const Representation& s) {
  std::vector<double> out;
  for (double y = kBlock.lo.y + 0.625; y < kBlock.hi.y; y += 1.0)
    for (double x = kBlock.lo.x + 0.625; x < kBlock.hi.x; x += 1.0) out.push_back(at(s, {x, y}));
  return out;
}

CutterPath slot(double x0, double x1, double y, double z) {
  CutterPath p;
  p.start({x0, y, z});
  p.line({x1, y, z}, MoveRole::kCut);
  return p;
}

const geometry::CutterProfile kTool = geometry::flat_profile(8.0, 20.0);

template <class Representation>
class StockContract : public testing::Test {};
using Representations = testing::Types<HeightMap, PlanarStock>;
TYPED_TEST_SUITE(StockContract, Representations);

TYPED_TEST(StockContract, ABlockHasItsVolumeAndItsTop) {
  const TypeParam s = Held<TypeParam>::block();
  EXPECT_NEAR(Held<TypeParam>::volume_of(s), 24000.0, 1e-3);
  for (const double z : heights(s)) ASSERT_EQ(z, kBlock.hi.z);
}

TYPED_TEST(StockContract, ABarHasItsVolumeAndNothingBesideIt) {
  const TypeParam s = Held<TypeParam>::bar();
  const double around_mm2 = 2.0 * kPi * kBarRadius * 10.0;
  EXPECT_NEAR(Held<TypeParam>::volume_of(s), kPi * 2250.0, around_mm2 * Held<TypeParam>::kWallMm);
  EXPECT_EQ(at(s, {30.0, 20.0}), kBlock.hi.z);
  EXPECT_EQ(at(s, {30.0, 36.0}), kBlock.lo.z);
}

TYPED_TEST(StockContract, ASlotTakesItsVolume) {
  TypeParam s = Held<TypeParam>::block();
  Held<TypeParam>::take(s, kTool, slot(10.0, 50.0, 20.0, -2.0));
  const double walls_mm2 = 2.0 * (2.0 * 40.0 + 8.0 * kPi);
  EXPECT_NEAR(24000.0 - Held<TypeParam>::volume_of(s), 2.0 * (320.0 + 16.0 * kPi),
              walls_mm2 * Held<TypeParam>::kWallMm);
  EXPECT_NEAR(at(s, {30.125, 20.125}), -2.0, 1e-6);
  EXPECT_EQ(at(s, {30.125, 25.125}), kBlock.hi.z);
}

TYPED_TEST(StockContract, TheSameCutAgainTakesNothing) {
  TypeParam s = Held<TypeParam>::block();
  Held<TypeParam>::take(s, kTool, slot(10.0, 50.0, 20.0, -2.0));
  const auto once = heights(s);
  const double left = Held<TypeParam>::volume_of(s);
  Held<TypeParam>::take(s, kTool, slot(10.0, 50.0, 20.0, -2.0));
  EXPECT_EQ(heights(s), once);
  EXPECT_EQ(Held<TypeParam>::volume_of(s), left);
}

TYPED_TEST(StockContract, ACutInAirTakesNothing) {
  TypeParam s = Held<TypeParam>::block();
  Held<TypeParam>::take(s, kTool, slot(10.0, 50.0, 20.0, 1.0));
  Held<TypeParam>::take(s, kTool, slot(10.0, 50.0, 60.0, -2.0));
  EXPECT_NEAR(Held<TypeParam>::volume_of(s), 24000.0, 1e-3);
}

TYPED_TEST(StockContract, NoCutRaisesAnyPlace) {
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> u(0.0, 1.0);
  TypeParam s = Held<TypeParam>::block();
  auto before = heights(s);
  double left = Held<TypeParam>::volume_of(s);
  for (int k = 0; k < 12; ++k) {
    const double from = -5.0 + 40.0 * u(random);
    Held<TypeParam>::take(s, kTool, slot(from, from + 25.0, 45.0 * u(random), -9.0 * u(random)));
    const auto now = heights(s);
    for (std::size_t i = 0; i < now.size(); ++i) ASSERT_LE(now[i], before[i]);
    const double volume = Held<TypeParam>::volume_of(s);
    ASSERT_LE(volume, left + 1e-3);
    before = now;
    left = volume;
  }
  EXPECT_LT(left, 23000.0);
}

TYPED_TEST(StockContract, OfTwoCutsTheOrderDoesNotMatter) {
  const auto one = slot(10.0, 50.0, 18.0, -2.0), other = slot(20.0, 55.0, 23.0, -3.5);
  TypeParam a = Held<TypeParam>::block(), b = Held<TypeParam>::block();
  Held<TypeParam>::take(a, kTool, one);
  Held<TypeParam>::take(a, kTool, other);
  Held<TypeParam>::take(b, kTool, other);
  Held<TypeParam>::take(b, kTool, one);
  const auto of_a = heights(a), of_b = heights(b);
  for (std::size_t i = 0; i < of_a.size(); ++i) ASSERT_NEAR(of_a[i], of_b[i], 1e-6) << i;
  const double walls_mm2 = 3.5 * 2.0 * (40.0 + 35.0 + 8.0 * kPi);
  EXPECT_NEAR(Held<TypeParam>::volume_of(a), Held<TypeParam>::volume_of(b),
              walls_mm2 * Held<TypeParam>::kWallMm);
}

TYPED_TEST(StockContract, ACutThatIsUndoneIsGoneToTheBit) {
  TypeParam s = Held<TypeParam>::block();
  Held<TypeParam>::take(s, kTool, slot(10.0, 50.0, 18.0, -2.0));
  const auto before = heights(s);
  const double left = Held<TypeParam>::volume_of(s);
  const auto mark = Held<TypeParam>::before(s);
  Held<TypeParam>::take(s, kTool, slot(20.0, 55.0, 23.0, -3.5));
  ASSERT_NE(heights(s), before);
  Held<TypeParam>::undo(s, mark);
  EXPECT_EQ(heights(s), before);
  EXPECT_EQ(Held<TypeParam>::volume_of(s), left);
}

}  // namespace
}  // namespace capstan::stock

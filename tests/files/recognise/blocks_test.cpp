#include "tests/files/recognise/blocks.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "planner/files/recognise/recognise.h"

namespace capstan::testing {
namespace {

using model::TypeId;
using recognise::Feature;
using recognise::Recognition;

// A block of 60 x 50 x 30 mm, cut into cells that the tests take away.
const std::vector<double> kX{0, 10, 20, 40, 50, 60};
const std::vector<double> kY{0, 10, 22, 40, 50};
const std::vector<double> kZ{0, 12, 20, 30};
constexpr std::size_t kTop = 2;     // 20 .. 30
constexpr std::size_t kMiddle = 1;  // 12 .. 20

double size(const Feature& f, const std::string& name) {
  for (const recognise::Parameter& p : f.parameters) {
    if (p.name == name) return p.value;
  }
  return -1.0;
}

std::vector<TypeId> types(const Recognition& found) {
  std::vector<TypeId> all;
  for (const Feature& f : found.features) all.push_back(f.type);
  std::sort(all.begin(), all.end());
  return all;
}

TEST(Blocks, ABlockHasNoFeatures) {
  const Recognition found = recognise::recognise(blocks(kX, kY, kZ, [](auto, auto, auto) { return true; }));
  EXPECT_TRUE(found.features.empty());
  EXPECT_TRUE(found.unrecognised.empty());
  // Six sides of 5 x 4, 5 x 3 and 4 x 3 cells.
  EXPECT_EQ(found.on_raw.size(), 2U * (20 + 15 + 12));
}

TEST(Blocks, APocketHasItsSizes) {
  const Recognition found = recognise::recognise(
      blocks(kX, kY, kZ, [](auto i, auto j, auto k) { return !(k == kTop && i == 2 && j >= 1 && j <= 2); }));
  ASSERT_EQ(types(found), std::vector{TypeId::kClosedPocket});
  const Feature& f = found.features[0];
  EXPECT_EQ(f.profile, TypeId::kRectangularClosedProfile);
  EXPECT_FALSE(f.through);
  EXPECT_EQ(f.access, (recognise::Direction3{0, 0, 1}));
  EXPECT_NEAR(size(f, "depth"), 30 - 20, 1e-9);
  EXPECT_NEAR(size(f, "width"), 40 - 20, 1e-9);
  EXPECT_NEAR(size(f, "length"), 40 - 10, 1e-9);
  EXPECT_EQ(size(f, "islands"), -1.0);
}

TEST(Blocks, MaterialThatStaysInAPocketIsAnIsland) {
  const Recognition found = recognise::recognise(
      blocks({0, 10, 20, 40, 50, 60}, {0, 10, 22, 40, 50}, {0, 20, 30}, [](auto i, auto j, auto k) {
        const bool inside = i >= 1 && i <= 3 && j >= 1 && j <= 2;
        // A pocket of three cells by two; the island stands free of its walls.
        return k == 0 || !inside;
      }));
  ASSERT_EQ(types(found), std::vector{TypeId::kClosedPocket});
  EXPECT_EQ(size(found.features[0], "islands"), -1.0);

  const Recognition with = recognise::recognise(
      blocks({0, 10, 20, 40, 50, 60}, {0, 10, 20, 30, 40, 50}, {0, 20, 30}, [](auto i, auto j, auto k) {
        const bool inside = i >= 1 && i <= 3 && j >= 1 && j <= 3;
        return k == 0 || !inside || (i == 2 && j == 2);
      }));
  ASSERT_EQ(types(with), std::vector{TypeId::kClosedPocket});
  EXPECT_EQ(size(with.features[0], "islands"), 1.0);
  EXPECT_EQ(with.features[0].profile, TypeId::kRectangularClosedProfile);
}

TEST(Blocks, FloorsAtTwoDepthsAreTwoPockets) {
  // The deep one is against a wall of the shallow one: they are tied, and come apart.
  const Recognition found = recognise::recognise(blocks(kX, kY, kZ, [](auto i, auto j, auto k) {
    const bool shallow = k == kTop && i >= 1 && i <= 3 && j >= 1 && j <= 2;
    const bool deep = k == kMiddle && i == 1 && j >= 1 && j <= 2;
    return !shallow && !deep;
  }));
  ASSERT_EQ(found.features.size(), 2U);
  std::vector<double> depths{size(found.features[0], "depth"), size(found.features[1], "depth")};
  std::sort(depths.begin(), depths.end());
  EXPECT_NEAR(depths[0], 30 - 20, 1e-9);
  EXPECT_NEAR(depths[1], 30 - 12, 1e-9);
}

TEST(Blocks, SlotsThatCrossAtOneDepthAreNoClosedPocket) {
  const Recognition found = recognise::recognise(
      blocks(kX, kY, kZ, [](auto i, auto j, auto k) { return !(k == kTop && (i == 2 || j == 1)); }));
  ASSERT_EQ(types(found), std::vector{TypeId::kOpenPocket});
}

TEST(Blocks, SlotsThatCrossAtTwoDepthsAreTwoSlots) {
  const Recognition found = recognise::recognise(blocks(kX, kY, kZ, [](auto i, auto j, auto k) {
    const bool along_y = i == 2 && k >= kMiddle;
    const bool along_x = j == 1 && k == kTop;
    return !along_y && !along_x;
  }));
  ASSERT_EQ(types(found), (std::vector{TypeId::kSlot, TypeId::kSlot}));
  for (const Feature& f : found.features) EXPECT_EQ(f.profile, TypeId::kSquareUProfile);
}

TEST(Blocks, APassageIsThrough) {
  const Recognition found =
      recognise::recognise(blocks(kX, kY, kZ, [](auto i, auto j, auto) { return !(i == 2 && j == 1); }));
  ASSERT_EQ(types(found), std::vector{TypeId::kClosedPocket});
  EXPECT_TRUE(found.features[0].through);
  EXPECT_NEAR(size(found.features[0], "depth"), 30, 1e-9);
}

TEST(Blocks, AStepAndACornerAreToldApart) {
  const Recognition step =
      recognise::recognise(blocks(kX, kY, kZ, [](auto i, auto, auto k) { return !(i == 0 && k == kTop); }));
  ASSERT_EQ(types(step), std::vector{TypeId::kStep});
  EXPECT_EQ(step.features[0].open_sides, 3);
  const Recognition corner = recognise::recognise(
      blocks(kX, kY, kZ, [](auto i, auto j, auto k) { return !(i == 0 && j == 0 && k == kTop); }));
  ASSERT_EQ(types(corner), std::vector{TypeId::kOpenPocket});
  EXPECT_EQ(corner.features[0].open_sides, 2);
}

}  // namespace
}  // namespace capstan::testing

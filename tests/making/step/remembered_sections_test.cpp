#include "planner/making/step/path/remembered/cells.h"
#include "planner/making/step/path/remembered/planar.h"

#include <gtest/gtest.h>

#include <cmath>
#include <utility>
#include <vector>

#include "planner/physics/engagement/planar/planar.h"

// What is remembered must be what would be measured: of paths through material that differs only where a look
// reaches beyond the cutter's own way.

namespace capstan::step {
namespace {

model::Cutter cutter(double diameter_mm) {
  model::Cutter c;
  c.id = "c";
  c.cutter_class = model::CutterClass::kEndmill;
  c.cutting_diameter_mm = diameter_mm;
  c.maximum_depth_of_cut_mm = 20.0;
  c.usable_length_mm = c.stick_out_mm = 30.0;
  return c;
}

/// A line up to an arc about the origin at z = -1, which begins at the angle 0 and runs counter-clockwise.
model::CutterPath arc(double radius_mm, double sweep_rad) {
  model::CutterPath p;
  p.start({radius_mm, -28.0, -1.0});
  p.line({radius_mm, 0.0, -1.0}, model::MoveRole::kCut);
  p.arc({radius_mm * std::cos(sweep_rad), radius_mm * std::sin(sweep_rad), -1.0}, {0.0, 0.0}, false,
        model::MoveRole::kCut);
  return p;
}

bool same(const engagement::Measurement& a, const engagement::Measurement& b) {
  return a.sections == b.sections && a.engagement == b.engagement && a.removed_mm3 == b.removed_mm3 &&
         a.highest_contact_mm == b.highest_contact_mm;
}

TEST(RememberedSections, OnCellsDependOnAllThatALookReaches) {
  const geometry::Box3 box{{-30, -30, -10}, {30, 30, 0}};
  const model::Cutter mill = cutter(6.0);
  for (const double sweep : {1.5 * M_PI, 0.6 * M_PI, 0.25 * M_PI}) {
    const auto path = arc(10.0, sweep);
    const auto under = columns_under(stock::from_box(box, 0.5), path, model::profile_of(mill));
    memo::Memo memo;
    std::size_t measured = 0;
    // Nothing stands but what the line cuts, and a post, here and there about the arc, within the cutter's
    // way and beyond it: whether one is seen decides where the sample that ends the cut lies.
    for (double x = -16.0; x <= 16.0; x += 2.0) {
      for (double y = -16.0; y <= 16.0; y += 2.0) {
        stock::HeightMap map = stock::from_box(box, 0.5);
        for (std::size_t i = 0; i < map.cells(); ++i) map.set(i, {2.0F, 2.0F, 0.0F});
        const int ix = static_cast<int>((x - map.origin.x) / map.cell_mm),
                  iy = static_cast<int>((y - map.origin.y) / map.cell_mm);
        map.set(ix, iy, {10.0F, 10.0F, 0.0F});
        for (std::size_t i = 0; i < map.cells(); ++i) {
          const int cx = static_cast<int>(i) % map.nx, cy = static_cast<int>(i) / map.nx;
          if (std::abs(map.x_of(cx) - 10.0) < 1.0 && std::abs(map.y_of(cy) - 2.25) < 0.5)
            map.set(i, {10.0F, 10.0F, 0.0F});
        }
        stock::HeightMap alone = map;
        const auto want = engagement::measure(path, mill, alone);
        const auto got = measure_again(map, path, mill, &memo);
        ASSERT_TRUE(want && got);
        EXPECT_TRUE(same(*want, *got)) << "post at " << x << ", " << y << ", arc of " << sweep;
        EXPECT_EQ(map, alone);
        ++measured;
      }
    }
    EXPECT_GT(memo.counts(memo::Stage::kSections).found, 0U) << "posts far from the arc make no difference";
    EXPECT_LT(memo.counts(memo::Stage::kSections).found, measured);
    EXPECT_GT(under.nx, 0);
  }
}

/// A slot of two lines with an arc between, down a ramp, from `at` on; whole numbers of mm but for the place.
model::CutterPath slot(geometry::Vec2 at, double down = 1.0) {
  model::CutterPath path;
  path.start({at.x - 10, at.y, down - 3});
  path.line({at.x, at.y, down - 3}, model::MoveRole::kCut);
  path.arc({at.x + 10, at.y + 10, -3}, {at.x, at.y + 10}, false, model::MoveRole::kRamp);
  path.line({at.x + 10, at.y + 20, -3}, model::MoveRole::kCut);
  return path;
}

const geometry::Box3 kPlate{{-40, -40, -10}, {200, 100, 0}};
const engagement::Options kSteps{.step_mm = 0.3};

TEST(RememberedSections, LeaveTheStockAsCuttingDoes) {
  const model::Cutter mill = cutter(6.0);
  const auto path = slot({0, 0});
  memo::Memo memo;
  auto first = stock::PlanarStock::from_box(kPlate), again = first, alone = first;
  ASSERT_TRUE(alone.cut(model::profile_of(mill), path));
  const auto made = measure_again(first, path, mill, kSteps, &memo);
  const auto found = measure_again(again, path, mill, kSteps, &memo);
  ASSERT_TRUE(made && found);
  EXPECT_EQ(memo.counts(memo::Stage::kSections).found, 1U);
  EXPECT_TRUE(same(*made, *found));
  for (double x = -20.0; x < 20.0; x += 0.7) {
    for (double y = -10.0; y < 30.0; y += 0.7) {
      EXPECT_EQ(first.height_at({x, y}), alone.height_at({x, y}));
      EXPECT_EQ(again.height_at({x, y}), alone.height_at({x, y}));
    }
  }
  // And the same path once more meets nothing, whether remembered or not.
  const auto nothing = measure_again(again, path, mill, kSteps, &memo);
  ASSERT_TRUE(nothing);
  EXPECT_EQ(memo.counts(memo::Stage::kSections).found, 1U) << "the stock is another one now";
  EXPECT_LT(nothing->removed_mm3, 1e-9);
}

TEST(RememberedSections, OfAnEqualCutElsewhereAreTheSameWithAndWithoutMemory) {
  const model::Cutter rough = cutter(6.0), finish = cutter(8.0);
  memo::Memo memo;
  auto kept = stock::PlanarStock::from_box(kPlate), bare = kept;
  std::vector<engagement::Measurement> roughed, finished;
  // Places that no double holds, and tiles of the stock (5 mm) lie otherwise about each.
  const std::vector<geometry::Vec2> places{{0, 0}, {41.3, 7.1}, {83.7, 0.1}, {126.1, 13.7}};
  for (const geometry::Vec2 at : places) {
    for (const model::Cutter* mill : {&rough, &finish}) {
      const auto with = measure_again(kept, slot(at), *mill, kSteps, &memo);
      const auto without = measure_again(bare, slot(at), *mill, kSteps, nullptr);
      ASSERT_TRUE(with && without);
      EXPECT_TRUE(same(*with, *without)) << "at " << at.x << ", " << at.y;
      (mill == &rough ? roughed : finished).push_back(*with);
    }
  }
  EXPECT_EQ(memo.counts(memo::Stage::kSections).made, 2U) << "one of each cutter";
  for (std::size_t i = 1; i < places.size(); ++i) {
    EXPECT_TRUE(same(roughed[0], roughed[i]));
    EXPECT_TRUE(same(finished[0], finished[i]));
  }
  EXPECT_GT(finished[0].removed_mm3, 1.0);
}

TEST(RememberedSections, OfAnEqualPathThroughOtherMaterialAreOthers) {
  const model::Cutter mill = cutter(6.0);
  memo::Memo memo;
  auto stock = stock::PlanarStock::from_box(kPlate);
  model::CutterPath beside;  // a hole beside the second slot, which its wall just meets
  beside.start({50.0, -5.5, 5.0});
  beside.line({50.0, -5.5, -5.0}, model::MoveRole::kPlunge);
  ASSERT_TRUE(stock.cut(model::profile_of(mill), beside));
  const auto whole = measure_again(stock, slot({0, 0}), mill, kSteps, &memo);
  const auto holed = measure_again(stock, slot({55, 0}), mill, kSteps, &memo);
  const auto at_the_side = measure_again(stock, slot({0, -36}), mill, kSteps, &memo);
  ASSERT_TRUE(whole && holed && at_the_side);
  EXPECT_EQ(memo.counts(memo::Stage::kSections).found, 0U);
  EXPECT_LT(holed->removed_mm3, whole->removed_mm3);
}

TEST(RememberedSections, OfAHoleAreFoundAgainNearTheSidesOfThePiece) {
  const model::Cutter mill = cutter(6.0);
  const auto hole = [](geometry::Vec2 at) {
    model::CutterPath path;
    path.start({at.x, at.y, 5.0});
    path.line({at.x, at.y, -7.0}, model::MoveRole::kPlunge);
    return path;
  };
  memo::Memo memo;
  auto kept = stock::PlanarStock::from_box(kPlate), whole = kept;
  // 40 mm and 5 mm from a side, that is more than a radius and a step, less than a diameter; and through it.
  for (const geometry::Vec2 at : {geometry::Vec2{0, 0}, geometry::Vec2{-35, 20}, geometry::Vec2{-39, 50}}) {
    const auto got = measure_again(kept, hole(at), mill, kSteps, &memo);
    const auto want = engagement::measure(hole(at), mill, whole, kSteps);
    ASSERT_TRUE(got && want);
    EXPECT_TRUE(same(*got, *want)) << "at " << at.x << ", " << at.y;
  }
  EXPECT_EQ(memo.counts(memo::Stage::kSections).found, 1U);
  EXPECT_EQ(memo.counts(memo::Stage::kSections).made, 2U);
}

// A rounding of 1.3e-9 mm moves an area by as much times its outline; floors that slope are read in strips,
// to 1e-3 of diameter times depth (planar.h), and their strips begin where the rounding says.
TEST(RememberedSections, AreThoseOfTheWholeStockToTheRoundingOfTheOwnFrame) {
  const model::Cutter mill = cutter(6.0);
  for (const auto& [down, within] : {std::pair{0.0, 1e-6}, std::pair{1.0, 1e-3 * 6.0 * 3.0}}) {
    for (const geometry::Vec2 at :
         {geometry::Vec2{0, 0}, geometry::Vec2{41.3, 7.1}, geometry::Vec2{-27, 0}}) {
      auto own = stock::PlanarStock::from_box(kPlate), whole = own;
      for (const double side : {0.0, 3.5}) {
        const auto path = slot({at.x + side, at.y}, down);
        const auto a = measure_again(own, path, mill, kSteps, nullptr);
        const auto b = engagement::measure(path, mill, whole, kSteps);
        ASSERT_TRUE(a && b);
        ASSERT_EQ(a->sections.size(), b->sections.size());
        EXPECT_NEAR(a->removed_mm3, b->removed_mm3, within);
        for (std::size_t i = 0; i < a->sections.size(); ++i)
          EXPECT_NEAR(a->sections.csa_mm2[i], b->sections.csa_mm2[i], within);
      }
    }
  }
}

}  // namespace
}  // namespace capstan::step

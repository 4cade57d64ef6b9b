#include "planner/making/step/path/remembered/cells.h"
#include "planner/making/step/path/remembered/planar.h"

#include <gtest/gtest.h>

#include <cmath>

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

TEST(RememberedSections, LeaveTheStockAsMeasuringDoes) {
  const geometry::Box3 box{{-30, -30, -10}, {30, 30, 0}};
  const model::Cutter mill = cutter(6.0);
  model::CutterPath path;
  path.start({-40, 0, -2});
  path.line({0, 0, -2}, model::MoveRole::kCut);
  path.arc({10, 10, -3}, {0, 10}, false, model::MoveRole::kCut);
  const engagement::Options options{.step_mm = 0.3};
  memo::Memo memo;
  auto first = stock::PlanarStock::from_box(box), again = stock::PlanarStock::from_box(box),
       alone = stock::PlanarStock::from_box(box);
  const auto want = engagement::measure(path, mill, alone, options);
  const auto made = measure_again(first, path, mill, options, &memo);
  const auto found = measure_again(again, path, mill, options, &memo);
  ASSERT_TRUE(want && made && found);
  EXPECT_EQ(memo.counts(memo::Stage::kSections).found, 1U);
  EXPECT_TRUE(same(*want, *made) && same(*want, *found));
  std::string a, b, c;
  alone.describe({-30, -30}, {30, 30}, a);
  first.describe({-30, -30}, {30, 30}, b);
  again.describe({-30, -30}, {30, 30}, c);
  EXPECT_EQ(a, b);
  EXPECT_EQ(a, c);
  // And the same path once more meets nothing, whether remembered or not.
  const auto nothing = measure_again(again, path, mill, options, &memo);
  ASSERT_TRUE(nothing);
  EXPECT_EQ(memo.counts(memo::Stage::kSections).found, 1U) << "the stock is another one now";
  EXPECT_LT(nothing->removed_mm3, 1e-9);
}

}  // namespace
}  // namespace capstan::step

#include <gtest/gtest.h>

#include <cstdint>

#include "planner/physics/stock/height_map.h"
#include "planner/physics/stock/planar/planar_stock.h"
#include "planner/physics/stock/sweep.h"

// Cuts that are tried and not kept leave no trace: not in the map, not in the exact stock.

namespace capstan::stock {
namespace {

using geometry::Vec3;
using model::CutterPath;

const geometry::Box3 kBlock{{0, 0, -20}, {120, 80, 0}};

/// Zigzags and arcs about a place, partly off the block.
CutterPath wander(std::uint32_t& seed) {
  const auto within = [&](double lo, double hi) {
    seed = seed * 1664525U + 1013904223U;
    return lo + (hi - lo) * (seed >> 8) / 16777216.0;
  };
  CutterPath p;
  const double z = within(-9, -1);
  p.start({within(-10, 130), within(-10, 90), z});
  for (int i = 0; i < 6; ++i) p.line({within(-10, 130), within(-10, 90), z}, model::MoveRole::kCut);
  return p;
}

bool same(const PlanarStock& a, const PlanarStock& b) {
  for (double x = 1.0; x < 120.0; x += 3.7) {
    for (double y = 1.0; y < 80.0; y += 3.1) {
      if (a.height_at({x, y}) != b.height_at({x, y})) return false;
    }
  }
  return a.trail_count() == b.trail_count() && a.lost() == b.lost();
}

TEST(UndoOfCuts, MapAndExactStockStandAsAtTheMark) {
  std::uint32_t seed = 7;
  const auto mill = geometry::flat_profile(12.0, 40.0);
  auto map = from_box(kBlock, 0.5);
  auto exact = PlanarStock::from_box(kBlock);
  int cut_something = 0;
  for (int i = 0; i < 20; ++i) {
    const auto kept = wander(seed);
    cut(map, mill, kept);
    ASSERT_TRUE(exact.cut(mill, kept));
    const auto map_then = map;
    const auto exact_then = exact;
    const auto mark = exact.mark();
    for (int tries = 0; tries < 2; ++tries) {  // also a second time from the same mark
      const auto path = wander(seed);
      const auto b = model::bounds(path);
      const auto patch = patch_of(map, {b.lo.x - 6.0, b.lo.y - 6.0}, {b.hi.x + 6.0, b.hi.y + 6.0});
      cut_something += cut(map, mill, path) > 0.0 ? 1 : 0;
      ASSERT_TRUE(exact.cut(mill, path));
      const auto inner = exact.mark();
      ASSERT_TRUE(exact.cut(mill, wander(seed)));
      exact.put_back(inner);
      exact.lose("tried");
      EXPECT_FALSE(same(exact, exact_then));
      put_back(map, patch);
      exact.put_back(mark);
      EXPECT_EQ(map, map_then);
      EXPECT_TRUE(same(exact, exact_then));
    }
    if (i % 3 == 0) exact.forget();
  }
  EXPECT_GT(cut_something, 20);  // of 40: later ones may run where nothing stands any more
}

TEST(UndoOfCuts, PatchBesideTheMapIsEmpty) {
  auto map = from_box(kBlock, 1.0);
  const auto patch = patch_of(map, {500, 500}, {600, 600});
  EXPECT_EQ(patch.top.size(), 0U);
  put_back(map, patch);
  EXPECT_EQ(map, from_box(kBlock, 1.0));
}

}  // namespace
}  // namespace capstan::stock

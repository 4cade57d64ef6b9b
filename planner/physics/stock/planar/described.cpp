#include <algorithm>
#include <cstdint>
#include <string>
#include <vector>

#include "planner/ground/memo/packed.h"
#include "planner/physics/stock/planar/planar_stock.h"

namespace capstan::stock {

using geometry::Vec2;

void PlanarStock::describe(Vec2 lo, Vec2 hi, std::string& bytes) const {
  memo::pack(bytes, box_);
  memo::pack(bytes, bar_radius_mm_);
  memo::pack(bytes, tile_mm_);
  int x0, x1, y0, y1;
  tiles_of(lo, hi, x0, x1, y0, y1);
  for (const int n : {x0, x1, y0, y1}) memo::pack(bytes, n);
  std::vector<std::uint32_t> ids;
  const auto each = [&](const auto& body) {
    for (int y = y0; y <= y1; ++y) {
      for (int x = x0; x <= x1; ++x)
        body(tiles_[static_cast<std::size_t>(y) * static_cast<std::size_t>(nx_) +
                    static_cast<std::size_t>(x)]);
    }
  };
  each([&](const Tile& t) { ids.insert(ids.end(), t.trails.begin(), t.trails.end()); });
  std::sort(ids.begin(), ids.end());
  ids.erase(std::unique(ids.begin(), ids.end()), ids.end());
  each([&](const Tile& t) {
    memo::pack(bytes, t.highest_mm);
    memo::pack(bytes, t.thin_at);
    memo::pack(bytes, t.trails.size());
    // By rank: which trail came first matters, its number among all of the piece does not.
    for (const std::uint32_t id : t.trails) {
      const auto rank = std::lower_bound(ids.begin(), ids.end(), id) - ids.begin();
      memo::pack(bytes, static_cast<std::uint32_t>(rank));
    }
  });
  for (const std::uint32_t id : ids) memo::pack(bytes, trails_[id]);
}

}  // namespace capstan::stock

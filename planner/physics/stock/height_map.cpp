#include "planner/physics/stock/height_map.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "planner/ground/base/memory/grow.h"
#include "planner/ground/base/stopping.h"
#include "planner/physics/stock/coverage.h"

namespace capstan::stock {
namespace {

using geometry::Box3;
using geometry::Vec2;
using geometry::Vec3;

constexpr double kCornerOfCell = 0.7072;  // from its centre, in cells, rounded up: it may lie under a rim

int index_of(double p, double origin, double cell, int n) {
  return static_cast<int>(std::clamp(std::floor((p - origin) / cell), -1.0, static_cast<double>(n)));
}

/// A column of height `top` of which `share` is missing.
Column partial(double top, double missing) {
  const auto height = static_cast<float>(top);
  if (missing <= 0.0) return {height, height, 0.0F};
  if (missing >= 1.0) return {};
  return {height, 0.0F, static_cast<float>(missing)};
}

void rasterise(HeightMap& map, const Vec3& a, const Vec3& b, const Vec3& c) {
  const double area = geometry::cross(xy(b) - xy(a), xy(c) - xy(a));
  if (area == 0.0) return;
  const auto [xlo, xhi] = std::minmax({a.x, b.x, c.x});
  const auto [ylo, yhi] = std::minmax({a.y, b.y, c.y});
  const int ix0 = std::max(0, index_of(xlo, map.origin.x, map.cell_mm, map.nx));
  const int ix1 = std::min(map.nx - 1, index_of(xhi, map.origin.x, map.cell_mm, map.nx));
  const int iy0 = std::max(0, index_of(ylo, map.origin.y, map.cell_mm, map.ny));
  const int iy1 = std::min(map.ny - 1, index_of(yhi, map.origin.y, map.cell_mm, map.ny));
  constexpr double kEdge = -1e-9;  // a centre on a shared edge belongs to both
  for (int iy = iy0; iy <= iy1; ++iy) {
    for (int ix = ix0; ix <= ix1; ++ix) {
      const Vec2 p{map.x_of(ix), map.y_of(iy)};
      const double wa = geometry::cross(xy(b) - p, xy(c) - p) / area;
      const double wb = geometry::cross(xy(c) - p, xy(a) - p) / area;
      const double wc = 1.0 - wa - wb;
      if (wa < kEdge || wb < kEdge || wc < kEdge) continue;
      const auto z = static_cast<float>(wa * a.z + wb * b.z + wc * c.z - map.origin.z);
      if (z > map.at(ix, iy).top_mm) map.set(ix, iy, {z, z, 0.0F});
    }
  }
}

void cover(HeightMap& map, const geometry::Mesh& mesh) {
  for (const auto& t : mesh.triangles)
    rasterise(map, mesh.vertices[t[0]], mesh.vertices[t[1]], mesh.vertices[t[2]]);
}

/// A maximum over stretches of rows; several side by side, so that one need not wait for the other.
class Highest {
 public:
  void look(const HeightMap& map, int iy, int ix0, int ix1) {
    const float* const row = map.top.data() + map.index(0, iy);
    int ix = ix0;
    for (; ix + kLanes <= ix1 + 1; ix += kLanes) {
      for (int k = 0; k < kLanes; ++k) best_[k] = row[ix + k] > best_[k] ? row[ix + k] : best_[k];
    }
    for (; ix <= ix1; ++ix) best_[0] = std::max(best_[0], row[ix]);
  }
  [[nodiscard]] double height() const {
    return static_cast<double>(*std::max_element(best_, best_ + kLanes));
  }

 private:
  static constexpr int kLanes = 16;
  float best_[kLanes] = {};
};

}  // namespace

double cell_for(double diameter_mm, const Box3& piece, double cells_per_diameter, double maximum_cells) {
  const Vec3 size = piece.size();
  const double wanted = diameter_mm / cells_per_diameter;
  const double affordable =
      std::sqrt(std::max(0.0, size.x * size.y) / std::min(maximum_cells, kMaximumCells));
  return std::ceil(std::max(wanted, affordable) * 1000.0 - 1e-6) / 1000.0;
}

namespace {

/// The grid over a box, without its columns.
HeightMap grid_over(const Box3& box, double cell_mm) {
  if (box.empty() || !(cell_mm > 0.0)) throw std::logic_error("a height map needs a box and a cell");
  const Vec3 size = box.size();
  double cell = cell_mm;
  const auto cells = [&] { return (std::ceil(size.x / cell) + 1.0) * (std::ceil(size.y / cell) + 1.0); };
  while (cells() > kMaximumCells) cell *= 1.25;
  HeightMap map{.origin = box.lo, .cell_mm = cell, .nx = 0, .ny = 0, .top = {}, .low = {}, .share = {}};
  map.nx = std::max(1, static_cast<int>(std::ceil(size.x / cell - 1e-6)));
  map.ny = std::max(1, static_cast<int>(std::ceil(size.y / cell - 1e-6)));
  return map;
}

/// Columns of one height, each written once; the padding has none.
void fill(HeightMap& map, float height) {
  for (auto* column : {&map.top, &map.low}) {
    column->reserve(map.cells() + HeightMap::kPadding);
    grow(*column, map.cells(), height);
    column->resize(map.cells() + HeightMap::kPadding);
  }
  grow(map.share, map.cells() + HeightMap::kPadding);
}

}  // namespace

HeightMap empty_map(const Box3& box, double cell_mm) {
  HeightMap map = grid_over(box, cell_mm);
  fill(map, 0.0F);
  return map;
}

HeightMap from_box(const Box3& box, double cell_mm) {
  HeightMap map = grid_over(box, cell_mm);
  const double height = box.size().z;
  fill(map, static_cast<float>(height));
  poll();
  // The far sides cut through the last cells of rows and columns alone.
  const auto filled = [&](int i, double size) { return std::clamp(size / map.cell_mm - i, 0.0, 1.0); };
  const auto far_side = [&](int ix, int iy) {
    const double full = filled(iy, box.size().y) * filled(ix, box.size().x);
    map.set(ix, iy, partial(height, full > 1.0 - 1e-6 ? 0.0 : 1.0 - full));
  };
  for (int iy = 0; iy < map.ny; ++iy) far_side(map.nx - 1, iy);
  for (int ix = 0; ix < map.nx; ++ix) far_side(ix, map.ny - 1);
  return map;
}

HeightMap from_cylinder(const Box3& box, double radius_mm, double cell_mm) {
  const Vec2 centre{0.5 * (box.lo.x + box.hi.x), 0.5 * (box.lo.y + box.hi.y)};
  const Box3 round{{centre.x - radius_mm, centre.y - radius_mm, box.lo.z},
                   {centre.x + radius_mm, centre.y + radius_mm, box.hi.z}};
  HeightMap map = empty_map(round, cell_mm);
  for (int iy = 0; iy < map.ny; ++iy) {
    for (int ix = 0; ix < map.nx; ++ix) {
      const Vec2 out = Vec2{map.x_of(ix), map.y_of(iy)} - centre;
      map.set(ix, iy, partial(box.size().z, 1.0 - coverage(radius_mm - norm(out), out, map.cell_mm)));
    }
  }
  return map;
}

HeightMap from_mesh(const geometry::Mesh& mesh, double floor_mm, double cell_mm) {
  Box3 box = geometry::bounds(mesh);
  box.lo.z = floor_mm;
  box.hi.z = std::max(box.hi.z, floor_mm);
  HeightMap map = empty_map(box, cell_mm);
  cover(map, mesh);
  return map;
}

HeightMap from_mesh(const geometry::Mesh& mesh, double floor_mm, const HeightMap& cells) {
  HeightMap map{.origin = {cells.origin.x, cells.origin.y, floor_mm},
                .cell_mm = cells.cell_mm,
                .nx = cells.nx,
                .ny = cells.ny,
                .top = {},
                .low = {},
                .share = {}};
  for (auto* column : {&map.top, &map.low, &map.share}) column->resize(map.cells() + HeightMap::kPadding);
  cover(map, mesh);
  return map;
}

Patch patch_of(const HeightMap& map, Vec2 lo, Vec2 hi) {
  const auto cell = [&](double p, double origin, int n, int more) {
    return static_cast<int>(
        std::clamp(std::floor((p - origin) / map.cell_mm) + more, 0.0, static_cast<double>(n)));
  };
  Patch p;
  p.x0 = cell(lo.x, map.origin.x, map.nx, -1);
  p.y0 = cell(lo.y, map.origin.y, map.ny, -1);
  p.nx = std::max(0, cell(hi.x, map.origin.x, map.nx, 2) - p.x0);
  p.ny = std::max(0, cell(hi.y, map.origin.y, map.ny, 2) - p.y0);
  const auto rows = [&](const std::vector<float>& from, std::vector<float>& to) {
    to.reserve(static_cast<std::size_t>(p.nx) * static_cast<std::size_t>(p.ny));
    for (int y = p.y0; y < p.y0 + p.ny; ++y) {
      tick(2);
      const auto row = from.begin() + static_cast<std::ptrdiff_t>(map.index(p.x0, y));
      to.insert(to.end(), row, row + p.nx);
    }
  };
  rows(map.top, p.top);
  rows(map.low, p.low);
  rows(map.share, p.share);
  return p;
}

void put_back(HeightMap& map, const Patch& patch) {
  const auto rows = [&](const std::vector<float>& from, std::vector<float>& to) {
    for (int y = 0; y < patch.ny; ++y) {
      std::copy_n(from.begin() + static_cast<std::ptrdiff_t>(y) * patch.nx, patch.nx,
                  to.begin() + static_cast<std::ptrdiff_t>(map.index(patch.x0, patch.y0 + y)));
    }
  };
  rows(patch.top, map.top);
  rows(patch.low, map.low);
  rows(patch.share, map.share);
}

void exchange(HeightMap& map, Patch& patch) {
  const auto rows = [&](std::vector<float>& a, std::vector<float>& b) {
    for (int y = 0; y < patch.ny; ++y) {
      const auto row = a.begin() + static_cast<std::ptrdiff_t>(y) * patch.nx;
      std::swap_ranges(row, row + patch.nx,
                       b.begin() + static_cast<std::ptrdiff_t>(map.index(patch.x0, patch.y0 + y)));
    }
  };
  rows(patch.top, map.top);
  rows(patch.low, map.low);
  rows(patch.share, map.share);
}

double volume(const HeightMap& map) {
  double sum = 0.0;
  for (std::size_t i = 0; i < map.cells(); ++i) {
    const auto top = static_cast<double>(map.top[i]);
    sum += top - static_cast<double>(map.share[i]) * (top - static_cast<double>(map.low[i]));
  }
  return sum * map.cell_mm * map.cell_mm;
}

double height_at(const HeightMap& map, Vec2 p) {
  const int ix = index_of(p.x, map.origin.x, map.cell_mm, map.nx);
  const int iy = index_of(p.y, map.origin.y, map.cell_mm, map.ny);
  if (ix < 0 || iy < 0 || ix >= map.nx || iy >= map.ny) return map.origin.z;
  return map.origin.z + static_cast<double>(map.at(ix, iy).mean());
}

double max_height(const HeightMap& map, Vec2 centre, double radius_mm) {
  return max_height(map, centre, centre, radius_mm);
}

double min_height(const HeightMap& map, Vec2 centre, double radius_mm) {
  const double reach = radius_mm + kCornerOfCell * map.cell_mm;
  const auto rows = [&](double y) { return index_of(y, map.origin.y, map.cell_mm, map.ny); };
  const auto columns = [&](double x) { return index_of(x, map.origin.x, map.cell_mm, map.nx); };
  float lowest = std::numeric_limits<float>::max();
  for (int iy = rows(centre.y - reach); iy <= rows(centre.y + reach); ++iy) {
    if (iy < 0 || iy >= map.ny) return map.origin.z;
    const double y = map.y_of(iy) - centre.y;
    const double half = std::sqrt(std::max(0.0, reach * reach - y * y));
    const int ix0 = columns(centre.x - half), ix1 = columns(centre.x + half);
    if (ix0 < 0 || ix1 >= map.nx) return map.origin.z;
    const float* const row = map.low.data() + map.index(0, iy);
    lowest = std::min(lowest, *std::min_element(row + ix0, row + ix1 + 1));
  }
  return map.origin.z + static_cast<double>(lowest);
}

double max_height(const HeightMap& map, Vec2 a, Vec2 b, double radius_mm) {
  const double reach = radius_mm + kCornerOfCell * map.cell_mm;
  const int iy0 = std::max(0, index_of(std::min(a.y, b.y) - reach, map.origin.y, map.cell_mm, map.ny));
  const int iy1 =
      std::min(map.ny - 1, index_of(std::max(a.y, b.y) + reach, map.origin.y, map.cell_mm, map.ny));
  Highest best;
  for (int iy = iy0; iy <= iy1; ++iy) {
    const Span row = capsule_row(a, b, reach, map.y_of(iy));
    if (row.lo > row.hi) continue;
    // Cells whose centre lies in the row.
    const int ix0 = index_of(row.lo + 0.5 * map.cell_mm, map.origin.x, map.cell_mm, map.nx);
    const int ix1 = index_of(row.hi - 0.5 * map.cell_mm, map.origin.x, map.cell_mm, map.nx);
    best.look(map, iy, std::max(0, ix0), std::min(map.nx - 1, ix1));
  }
  return map.origin.z + best.height();
}

}  // namespace capstan::stock

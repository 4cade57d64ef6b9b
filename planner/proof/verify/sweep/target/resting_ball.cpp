#include "planner/proof/verify/sweep/target/resting_ball.h"

#include <algorithm>
#include <cmath>

#include "planner/ground/base/stopping.h"

// The middle of a ball of radius r rests at the highest of sqrt(r^2 - d^2) above the columns, d being how far
// a column lies aside. Source  derived: the closing of heights by a ball (Serra, Image Analysis and
// Mathematical Morphology, 1982).

namespace capstan::verify {
namespace {

/// Cells in a radius, from which middles need not be asked in each: so much finer than the ball is round.
/// Default, unsourced.
constexpr double kCellsInRadius = 30.0;

}  // namespace

RestingBalls::RestingBalls(const Grid& grid, double radius_mm)
    : grid_(grid), radius_mm_(radius_mm), heights_(grid.part.size()), known_(grid.part.size()) {
  const double cell = grid.cell();
  stride_ = std::max(1, static_cast<int>(radius_mm / (kCellsInRadius * cell)));
  const int n = static_cast<int>(radius_mm / cell);
  for (int dy = -n; dy <= n; ++dy) {
    for (int dx = -n; dx <= n; ++dx) {
      const double h2 = radius_mm * radius_mm - cell * cell * (dx * dx + dy * dy);
      if (h2 >= 0.0) ball_.push_back({dx, dy, std::sqrt(h2)});
    }
  }
  std::stable_sort(ball_.begin(), ball_.end(),
                   [](const Around& a, const Around& b) { return a.height > b.height; });
  for (const double z : grid.part) top_ = std::max(top_, z);
}

double RestingBalls::lowest(int ix, int iy) {
  const std::size_t i = grid_.index(ix, iy);
  if (known_[i] != 0) return heights_[i];
  poll();
  double out = Grid::kNothing;
  for (const Around& a : ball_) {
    if (top_ + a.height <= out) break;  // none farther out holds it higher
    const int x = ix + a.dx, y = iy + a.dy;
    if (x < 0 || y < 0 || x >= grid_.nx() || y >= grid_.ny()) continue;
    const double z = grid_.part[grid_.index(x, y)];
    if (z > Grid::kNothing / 2) out = std::max(out, z + a.height);
  }
  known_[i] = 1;
  return heights_[i] = out;
}

bool RestingBalls::reaches(geometry::Vec3 place, double within_mm) {
  if (!(within_mm > 0.0)) return false;
  const auto [y0, y1] = grid_.rows(place.y - within_mm, place.y + within_mm);
  const auto [x0, x1] = grid_.columns(place.x - within_mm, place.x + within_mm);
  for (int iy = y0; iy < y1; iy += stride_) {
    for (int ix = x0; ix < x1; ix += stride_) {
      const double aside = norm(grid_.centre(ix, iy) - xy(place));
      if (aside >= within_mm) continue;
      const double above = std::max(0.0, lowest(ix, iy) - place.z);
      if (aside * aside + above * above < within_mm * within_mm) return true;
    }
  }
  return false;
}

}  // namespace capstan::verify

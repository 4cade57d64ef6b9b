#include "planner/making/toolpath/freeform/waterline.h"

#include <algorithm>
#include <cmath>

// A waterline is the border of what is free for the cutter at a height: seen from above the tip's places are
// a height field of their own, and its contours are the ways of the tip at constant heights. They are found
// on a grid, and refined by the drop-cutter until each chord keeps to the border (rough/level_contour.h). The
// step from one height to the next is that of the surface where it is least steep between them.

namespace capstan::toolpath::freeform {
namespace {

using geometry::Vec2;

constexpr double kLeastShare = 0.5;  ///< of the distance, for the step in z: 30 degrees
constexpr double kRefined = 0.25;    ///< of the margin, as the rough has it

/// Heights of the levels, from above.
std::vector<double> heights(const DropGrid& grid, const Mask& where, double apart_mm) {
  struct Cell {
    double z = 0.0, sine = 1.0;
  };
  std::vector<Cell> cells;
  for (int iy = 0; iy < grid.ny; ++iy) {
    for (int ix = 0; ix < grid.nx; ++ix) {
      const double z = grid.at(ix, iy);
      if (std::isnan(z) || z >= kBlocked || !where.at(grid.place(ix, iy))) continue;
      const auto rise = [&](int dx, int dy) {
        double most = 0.0;
        for (const int sign : {-1, 1}) {
          const int x = ix + sign * dx, y = iy + sign * dy;
          if (x < 0 || y < 0 || x >= grid.nx || y >= grid.ny) continue;
          const double next = grid.at(x, y);
          if (std::isnan(next) || next >= kBlocked) continue;
          most = std::max(most, std::abs(next - z) / grid.step_mm);
        }
        return most;
      };
      const double tangent = std::hypot(rise(1, 0), rise(0, 1));
      cells.push_back({z, std::max(kLeastShare, tangent / std::hypot(1.0, tangent))});
    }
  }
  std::sort(cells.begin(), cells.end(), [](const Cell& a, const Cell& b) { return a.z > b.z; });
  std::vector<double> out;
  if (cells.empty()) return out;
  double z = cells.front().z;
  std::size_t first = 0;
  while (z > cells.back().z) {
    while (first < cells.size() && cells[first].z > z) ++first;
    double sine = 1.0;
    for (std::size_t i = first; i < cells.size() && cells[i].z > z - apart_mm; ++i)
      sine = std::min(sine, cells[i].sine);
    z -= apart_mm * sine;
    out.push_back(std::max(z, cells.back().z));
  }
  return out;
}

}  // namespace

std::vector<Level> waterlines(const Reach& reach, const DropGrid& grid, const Mask& where, double apart_mm,
                              Job& job) {
  const std::vector<double> at = heights(grid, where, apart_mm);
  std::vector<Level> out(at.size());
  parallel_for(job, at.size(), [&](std::size_t i) {
    if (job.stop_requested()) return;
    const double z = out[i].z_mm = at[i];
    const auto border = [&](Vec2 free, Vec2 blocked) { return reach.border(free, blocked, z); };
    for (const auto& rough : level_contour(grid, z, border)) {
      // Most of a level's border may lie elsewhere.
      if (std::none_of(rough.begin(), rough.end(), [&](Vec2 p) { return where.at(p); })) continue;
      std::uint32_t hint = 0;
      const auto line = refined(
          rough, kRefined * reach.margin_mm, [&](Vec2 p) { return reach.at(p, hint) <= z; }, border);
      Run run;
      const auto close = [&] {
        if (run.size() > 1) out[i].runs.push_back(run);
        run.clear();
      };
      for (std::size_t k = 1; k < line.size(); ++k) {
        const Vec2 middle = 0.5 * (line[k - 1] + line[k]);
        // The border of a level also runs along the rim of the surface, far above it.
        const bool in = where.at(middle) && reach.at(middle, hint) > z - apart_mm;
        if (!in || !reach.is_free(line[k - 1], line[k], z, 0.5)) {
          close();
          continue;
        }
        if (run.empty()) run.push_back({line[k - 1].x, line[k - 1].y, z});
        run.push_back({line[k].x, line[k].y, z});
      }
      const bool whole = run.size() == line.size();
      // A closed border that is cut at its first point goes on over it.
      if (!whole && !run.empty() && line.front() == line.back() && !out[i].runs.empty() &&
          xy(out[i].runs.front().front()) == line.front()) {
        Run& first = out[i].runs.front();
        run.insert(run.end(), first.begin() + 1, first.end());
        first = std::move(run);
        run.clear();
      }
      close();
    }
  });
  return out;
}

}  // namespace capstan::toolpath::freeform

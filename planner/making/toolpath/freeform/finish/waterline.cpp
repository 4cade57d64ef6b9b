#include "planner/making/toolpath/freeform/finish/waterline.h"

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
      if (!is_place(z) || !where.at(grid.place(ix, iy))) continue;
      const double tangent = tangent_at(grid, ix, iy);
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

/// A piece of a border that could not be proved clear.
struct LeftOut {
  Vec2 middle;
  double length_mm = 0.0;
};

/// The grid about the mask alone: borders elsewhere are not looked for.
DropGrid about(DropGrid grid, const Mask& where) {
  const Mask near = grown(where, 1);
  for (std::size_t i = 0; i < grid.z.size(); ++i) {
    if (near.on[i] == 0) grid.z[i] = std::nan("");
  }
  return grid;
}

}  // namespace

Waterlines waterlines(const Reach& reach, const DropGrid& grid, const Mask& where, double apart_mm,
                      Job& job) {
  const std::vector<double> at = heights(grid, where, apart_mm);
  Waterlines out{.levels = std::vector<Level>(at.size()), .left_out = empty_mask(grid)};
  std::vector<std::vector<LeftOut>> left_out(at.size());
  const double step = 0.5 * where.step_mm;
  const DropGrid local = about(grid, where);
  // Follows a border, where the mask has it and the surface is at its height: the border of a level also runs
  // along the rim of the surface, far above it.
  const auto follow = [&](const std::vector<Vec2>& part, Level& level, std::vector<LeftOut>& missing) {
    const double z = level.z_mm;
    std::uint32_t hint = 0;
    const auto line = refined(
        part, kRefined * reach.margin_mm, [&](Vec2 p) { return reach.is_free(p, z, hint); },
        [&](Vec2 free, Vec2 blocked) { return reach.border(free, blocked, z, hint); });
    Run run;
    const auto close = [&] {
      if (run.size() > 1) level.runs.push_back(run);
      run.clear();
    };
    for (std::size_t k = 1; k < line.size(); ++k) {
      const Vec2 a = line[k - 1], b = line[k];
      const int n = std::max(1, static_cast<int>(std::ceil(norm(b - a) / step)));
      const auto at_share = [&](int m) { return a + (static_cast<double>(m) / n) * (b - a); };
      for (int m = 0; m < n; ++m) {
        const Vec2 from = at_share(m), to = m + 1 == n ? b : at_share(m + 1), middle = 0.5 * (from + to);
        const bool wanted = where.at(middle) && !reach.is_free(middle, z - apart_mm, hint);
        if (!wanted || !reach.is_free(from, to, z, 0.5)) {
          if (wanted) missing.push_back({middle, norm(to - from)});
          close();
          continue;
        }
        if (run.empty()) run.push_back({from.x, from.y, z});
        if (m > 0 && run.size() > 1) run.pop_back();
        run.push_back({to.x, to.y, z});
      }
    }
    close();
  };
  parallel_for(job, at.size(), [&](std::size_t i) {
    if (job.stop_requested()) return;
    Level& level = out.levels[i];
    const double z = level.z_mm = at[i];
    std::uint32_t hint = 0;
    const auto border = [&](Vec2 free, Vec2 blocked) { return reach.border(free, blocked, z, hint); };
    for (const auto& part : level_contour(local, z, border)) {
      if (part.size() > 1) follow(part, level, left_out[i]);
    }
  });
  // What a level leaves out lies as far from the next as levels do along the surface, at most.
  for (const auto& level : left_out) {
    for (const LeftOut& piece : level) {
      out.left_out_mm += piece.length_mm;
      out.left_out.set(piece.middle);
    }
  }
  if (out.left_out_mm > 0.0)
    out.left_out = grown(out.left_out, 1 + static_cast<int>(std::ceil(apart_mm / grid.step_mm)));
  return out;
}

}  // namespace capstan::toolpath::freeform

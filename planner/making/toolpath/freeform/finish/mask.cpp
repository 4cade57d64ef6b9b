#include "planner/making/toolpath/freeform/finish/mask.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "planner/making/toolpath/freeform/rough/reach.h"
#include "planner/making/toolpath/freeform/upright_step.h"

namespace capstan::toolpath::freeform {
namespace {

using geometry::Vec2;
using geometry::Vec3;

std::optional<std::size_t> nearest_point(const Mask& mask, Vec2 p) {
  const int ix = static_cast<int>(std::lround((p.x - mask.origin.x) / mask.step_mm));
  const int iy = static_cast<int>(std::lround((p.y - mask.origin.y) / mask.step_mm));
  if (ix < 0 || iy < 0 || ix >= mask.nx || iy >= mask.ny) return std::nullopt;
  return static_cast<std::size_t>(iy) * static_cast<std::size_t>(mask.nx) + static_cast<std::size_t>(ix);
}

}  // namespace

bool is_place(double z) { return !std::isnan(z) && z < kBlocked; }

double tangent_at(const DropGrid& grid, int ix, int iy,
                  const std::function<bool(int x, int y, double rise)>& counts) {
  const double z = grid.at(ix, iy);
  const auto steeper_side = [&](int dx, int dy) {
    double most = 0.0;
    for (const int sign : {-1, 1}) {
      const int x = ix + sign * dx, y = iy + sign * dy;
      if (x < 0 || y < 0 || x >= grid.nx || y >= grid.ny || !is_place(grid.at(x, y))) continue;
      const double rise = std::abs(grid.at(x, y) - z) / grid.step_mm;
      if (rise > most && (!counts || counts(x, y, rise))) most = rise;
    }
    return most;
  };
  return std::hypot(steeper_side(1, 0), steeper_side(0, 1));
}

bool Mask::at(Vec2 p) const {
  const std::optional<std::size_t> i = nearest_point(*this, p);
  return i && on[*i] != 0;
}

void Mask::set(Vec2 p) {
  if (const std::optional<std::size_t> i = nearest_point(*this, p)) on[*i] = 1;
}

bool Mask::any() const {
  return std::any_of(on.begin(), on.end(), [](char c) { return c != 0; });
}

Mask empty_mask(const DropGrid& grid) {
  return {grid.origin, grid.step_mm, grid.nx, grid.ny, std::vector<char>(grid.z.size(), 0)};
}

Mask grown(const Mask& mask, int points) {
  // Along rows, then along columns.
  Mask out = mask;
  for (const bool rows : {true, false}) {
    const std::vector<char> from = out.on;
    for (int iy = 0; iy < mask.ny; ++iy) {
      for (int ix = 0; ix < mask.nx; ++ix) {
        char any = 0;
        for (int k = -points; k <= points && any == 0; ++k) {
          const int x = rows ? ix + k : ix, y = rows ? iy : iy + k;
          if (x < 0 || y < 0 || x >= mask.nx || y >= mask.ny) continue;
          any = from[static_cast<std::size_t>(y) * static_cast<std::size_t>(mask.nx) +
                     static_cast<std::size_t>(x)];
        }
        out.on[static_cast<std::size_t>(iy) * static_cast<std::size_t>(mask.nx) +
               static_cast<std::size_t>(ix)] = any;
      }
    }
  }
  return out;
}

Mask both(const Mask& a, const Mask& b) {
  Mask out = a;
  for (std::size_t i = 0; i < out.on.size(); ++i) out.on[i] = a.on[i] != 0 && b.on[i] != 0 ? 1 : 0;
  return out;
}

Mask either(const Mask& a, const Mask& b) {
  Mask out = a;
  for (std::size_t i = 0; i < out.on.size(); ++i) out.on[i] = a.on[i] != 0 || b.on[i] != 0 ? 1 : 0;
  return out;
}

Mask inverse(const Mask& mask) {
  Mask out = mask;
  for (char& c : out.on) c = c == 0 ? 1 : 0;
  return out;
}

Mask steep_of(const DropGrid& grid, const DropCutter& drop, const MillEnd& cutter, double allowance_mm,
              double angle_rad) {
  Mask out = empty_mask(grid);
  const double limit = std::tan(angle_rad);
  for (int iy = 0; iy < grid.ny; ++iy) {
    for (int ix = 0; ix < grid.nx; ++ix) {
      if (!is_place(grid.at(ix, iy))) continue;
      const double tangent = tangent_at(grid, ix, iy, [&](int x, int y, double rise) {
        return !(rise > kSteepTangent &&
                 has_upright_step(drop, cutter, allowance_mm, grid.place(ix, iy), grid.place(x, y)));
      });
      if (tangent < limit) continue;
      out.on[static_cast<std::size_t>(iy) * static_cast<std::size_t>(grid.nx) +
             static_cast<std::size_t>(ix)] = 1;
    }
  }
  return out;
}

std::vector<Run> within(const Run& run, const Mask& mask) {
  std::vector<Run> out;
  Run piece;
  const auto close = [&] {
    if (piece.size() > 1) out.push_back(piece);
    piece.clear();
  };
  if (mask.at(xy(run.front()))) piece.push_back(run.front());
  for (std::size_t i = 1; i < run.size(); ++i) {
    const int n =
        std::max(1, static_cast<int>(std::ceil(2.0 * norm(xy(run[i]) - xy(run[i - 1])) / mask.step_mm)));
    for (int k = 1; k <= n; ++k) {
      const Vec3 p = k == n ? run[i] : run[i - 1] + (static_cast<double>(k) / n) * (run[i] - run[i - 1]);
      const bool in = mask.at(xy(p));
      if (in && (piece.empty() || k == n)) {
        piece.push_back(p);
      } else if (!in && !piece.empty()) {
        const Vec3 last = run[i - 1] + (static_cast<double>(k - 1) / n) * (run[i] - run[i - 1]);
        if (k > 1) piece.push_back(last);
        close();
      }
    }
  }
  close();
  return out;
}

std::vector<Run> within(const std::vector<Run>& runs, const Mask& mask) {
  std::vector<Run> out;
  for (const Run& run : runs) {
    for (Run& piece : within(run, mask)) out.push_back(std::move(piece));
  }
  return out;
}

}  // namespace capstan::toolpath::freeform

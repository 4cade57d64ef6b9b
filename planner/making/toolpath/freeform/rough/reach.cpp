#include "planner/making/toolpath/freeform/rough/reach.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "planner/making/toolpath/freeform/surface_line.h"

namespace capstan::toolpath::freeform {

using geometry::Vec2;

namespace {
constexpr double kMostGridPoints = 2e6;
}

double Reach::at(Vec2 p, std::uint32_t& hint, double share) const {
  if (!kept_out.empty() && geometry::contains(kept_out, p)) return kBlocked;
  const double z = drop.drop(cutter, p.x, p.y, task.allowance_mm + share * margin_mm, hint);
  if (z == DropCutter::kNoContact) return beside ? floor_mm : kBlocked;
  return std::max(z, floor_mm);
}

bool Reach::is_free(Vec2 p, double z, std::uint32_t& hint, double share) const {
  if (z < floor_mm || (!kept_out.empty() && geometry::contains(kept_out, p))) return false;
  const double by = task.allowance_mm + share * margin_mm;
  return drop.is_clear(cutter, p, z, by, hint) && (beside || drop.meets(cutter, p, by, hint));
}

Vec2 Reach::border(Vec2 free, Vec2 blocked, double z, std::uint32_t& hint) const {
  while (norm(blocked - free) > border_mm) {
    const Vec2 middle = 0.5 * (free + blocked);
    (is_free(middle, z, hint) ? free : blocked) = middle;
  }
  return free;
}

bool Reach::is_free(Vec2 a, Vec2 b, double z, double share) const {
  const double spacing =
      std::min(spacing_mm, probe_spacing(cutter.ball_mm() + task.allowance_mm, share * margin_mm));
  const int n = std::max(1, static_cast<int>(std::ceil(norm(b - a) / spacing)));
  std::uint32_t hint = 0;
  for (int k = 0; k <= n; ++k) {
    if (!is_free(a + (static_cast<double>(k) / n) * (b - a), z, hint, share)) return false;
  }
  return true;
}

std::vector<Probes> Reach::along(const Hatch& lines, Job& job) const {
  std::vector<Probes> out(lines.stripes.size());
  parallel_for(job, out.size(), [&](std::size_t i) {
    if (job.stop_requested()) return;
    const Stripe& s = lines.stripes[i];
    const int n = std::max(1, static_cast<int>(std::ceil((s.hi - s.lo) / spacing_mm)));
    out[i].step = (s.hi - s.lo) / n;
    std::uint32_t hint = 0;
    for (int k = 0; k <= n; ++k) out[i].z.push_back(at(lines.place(s.lo + k * out[i].step, s.v), hint));
  });
  return out;
}

DropGrid Reach::grid(const geometry::Region& area, Job& job) const {
  DropGrid grid;
  const geometry::Box2 box = geometry::bounds(area);
  const Vec2 size = box.hi - box.lo;
  grid.step_mm = std::max(0.125 * cutter.radius(), std::sqrt(size.x * size.y / kMostGridPoints));
  grid.origin = box.lo;
  grid.nx = static_cast<int>(size.x / grid.step_mm) + 1;
  grid.ny = static_cast<int>(size.y / grid.step_mm) + 1;
  grid.z.resize(static_cast<std::size_t>(grid.nx) * static_cast<std::size_t>(grid.ny));
  parallel_for(job, static_cast<std::size_t>(grid.ny), [&](std::size_t row) {
    if (job.stop_requested()) return;
    std::uint32_t hint = 0;
    for (int ix = 0; ix < grid.nx; ++ix) {
      const Vec2 p = grid.place(ix, static_cast<int>(row));
      grid.z[row * static_cast<std::size_t>(grid.nx) + static_cast<std::size_t>(ix)] =
          geometry::contains(area, p) ? at(p, hint) : std::nan("");
    }
  });
  return grid;
}

}  // namespace capstan::toolpath::freeform

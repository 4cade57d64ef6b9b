#include "planner/physics/engagement/front.h"

#include <algorithm>
#include <cmath>

namespace capstan::engagement {
namespace {

constexpr double kSlack = 1e-3;  // mm: heights are single precision

/// The cells along one side whose middles lie in [from, to].
struct Cells {
  int first = 0, last = -1;
};
Cells cells_in(double from, double to, double origin, double cell, int n) {
  return {std::max(0, static_cast<int>(std::ceil((from - origin) / cell - 0.5))),
          std::min(n - 1, static_cast<int>(std::floor((to - origin) / cell - 0.5)))};
}

}  // namespace

std::optional<RoundNose> round_nose(const geometry::CutterProfile& profile) {
  if (profile.pieces.empty() || profile.pieces.size() > 2) return std::nullopt;
  const geometry::ProfilePiece& round = profile.pieces.back();
  if (!(round.radius_mm > 0.0) || !geometry::ends_upright(round)) return std::nullopt;
  const bool floor = profile.pieces.size() == 2;
  if (floor && (profile.pieces.front().radius_mm > 0.0 || profile.pieces.front().slope != 0.0))
    return std::nullopt;
  return RoundNose{profile.radius_mm, round.radius_mm, floor ? round.rc_mm : 0.0};
}

double chip_over_feed(const stock::HeightMap& map, const RoundNose& nose, geometry::Vec3 tip,
                      geometry::Vec3 feed, double ceiling_mm) {
  const double round = nose.round_mm;
  // What is no higher than the ceiling lies within the outline's radius there.
  const double up = std::clamp(ceiling_mm - tip.z, 0.0, round);
  const double r = nose.centre_mm + std::sqrt(up * (2.0 * round - up));
  // A cell counts where (x, y) . feed > R f_z cos k: ahead of the axis, down hill also so far behind it.
  const double behind = std::min(0.0, nose.cutter_mm * feed.z);
  const Cells rows = cells_in(tip.y - r, tip.y + r, map.origin.y, map.cell_mm, map.ny);
  // Heights above the map's floor, less the tip's: what stands over the cutter's plane there.
  const double floor = tip.z - map.origin.z + kSlack;
  double most = 0.0;
  for (int iy = rows.first; iy <= rows.last; ++iy) {
    const double y = map.y_of(iy) - tip.y;
    const double half = std::sqrt(std::max(0.0, r * r - y * y));
    double from = -half, to = half;
    const double counts = behind - y * feed.y;  // x feed.x is more
    if (feed.x > 0.0) {
      from = std::max(from, counts / feed.x);
    } else if (feed.x < 0.0) {
      to = std::min(to, counts / feed.x);
    } else if (counts >= 0.0) {
      continue;
    }
    if (from > to) continue;
    const Cells columns = cells_in(tip.x + from, tip.x + to, map.origin.x, map.cell_mm, map.nx);
    const float* top = map.top.data() + map.index(0, iy);
    for (int ix = columns.first; ix <= columns.last; ++ix) {
      const double stands = static_cast<double>(top[ix]) - floor;
      if (stands <= 0.0) continue;
      const double x = map.x_of(ix) - tip.x;
      const double square = x * x + y * y;
      // The round lies no lower than its parabola.
      if (nose.centre_mm == 0.0 && 2.0 * round * stands <= square) continue;
      const double away = std::sqrt(square);
      const double out = std::min(away - nose.centre_mm, round);
      if (out <= 0.0) {
        most = std::max(most, -feed.z);
        continue;
      }
      const double cosine = std::sqrt(std::max(0.0, 1.0 - out * out / (round * round)));
      if (stands <= round * (1.0 - cosine)) continue;
      const double along = away > 0.0 ? (x * feed.x + y * feed.y) / away : 0.0;
      most = std::max(most, along * out / round - feed.z * cosine);
    }
  }
  return most;
}

}  // namespace capstan::engagement

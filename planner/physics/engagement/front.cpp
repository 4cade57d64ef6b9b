#include "planner/physics/engagement/front.h"

#include <algorithm>
#include <cmath>

namespace capstan::engagement {
namespace {

constexpr double kSlack = 1e-3;   // mm: heights are single precision
constexpr double kInside = 1e-9;  // mm: more than rounding of a place

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

namespace {

/// The largest share so far, and what a cell must have to have more. With s = sin k, c = cos k and a the
/// component of the feed towards the cell, its share is a s - f_z c: no more than sqrt(a^2 + f_z^2), of a
/// ball, where s is its distance over the radius, no more than (x f_x + y f_y) / R - f_z; a feed that rises
/// takes from both. Rounding is far below kSure.
class Most {
 public:
  Most(const RoundNose& nose, double feed_z) : reach_mm_(nose.round_mm), fall_(std::max(0.0, -feed_z)) {}
  void take(double share) {
    if (!(share > most_)) return;
    most_ = share;
    if (!(most_ > fall_)) return;
    ahead_mm_ = kSure * (most_ - fall_) * reach_mm_;
    square_ = kSure * (most_ * most_ - fall_ * fall_);
  }
  [[nodiscard]] double most() const { return most_; }
  /// Of a ball: a cell with a smaller x f_x + y f_y has no more.
  [[nodiscard]] double ahead_mm() const { return ahead_mm_; }
  /// A cell with a smaller square of `a`, or that lies behind the axis, has no more.
  [[nodiscard]] bool has_no_more(double ahead_mm, double square) const {
    return ahead_mm * std::abs(ahead_mm) < square_ * square;
  }

 private:
  static constexpr double kSure = 1.0 - 1e-12;
  double reach_mm_, fall_;
  double most_ = 0.0, ahead_mm_ = -1e300, square_ = -1e300;
};

}  // namespace

double chip_over_feed(const stock::HeightMap& map, const RoundNose& nose, geometry::Vec3 tip,
                      geometry::Vec3 feed, double ceiling_mm) {
  const double round = nose.round_mm;
  const bool ball = nose.centre_mm == 0.0;
  // What is no higher than the ceiling lies within the outline's radius there.
  const double up = std::clamp(ceiling_mm - tip.z, 0.0, round);
  const double r = nose.centre_mm + std::sqrt(up * (2.0 * round - up));
  // A cell counts where (x, y) . feed > R f_z cos k: ahead of the axis, down hill also so far behind it.
  const double behind = std::min(0.0, nose.cutter_mm * feed.z);
  const Cells rows = cells_in(tip.y - r, tip.y + r, map.origin.y, map.cell_mm, map.ny);
  // Heights above the map's floor, less the tip's: what stands over the cutter's plane there.
  const double floor = tip.z - map.origin.z + kSlack;
  Most most(nose, feed.z);
  const auto cell = [&](double stands, double x, double y, double ahead) {
    const double square = x * x + y * y;
    // The round lies no lower than its parabola.
    if (ball && 2.0 * round * stands <= square) return;
    const double away = std::sqrt(square);
    const double out = std::min(away - nose.centre_mm, round);
    if (out <= 0.0) return most.take(-feed.z);
    const double cosine = std::sqrt(std::max(0.0, 1.0 - out * out / (round * round)));
    if (stands <= round * (1.0 - cosine)) return;
    most.take((away > 0.0 ? ahead / away : 0.0) * out / round - feed.z * cosine);
  };
  const auto row = [&](int iy) {
    const double y = map.y_of(iy) - tip.y;
    const double half = std::sqrt(std::max(0.0, r * r - y * y));
    double from = -half, to = half;
    const double least = ball ? std::max(behind, most.ahead_mm()) : behind;
    const double counts = least - y * feed.y;  // x feed.x is more
    if (feed.x > 0.0) {
      from = std::max(from, counts / feed.x);
    } else if (feed.x < 0.0) {
      to = std::min(to, counts / feed.x);
    } else if (counts >= 0.0) {
      return;
    }
    if (from > to) return;
    const Cells columns = cells_in(tip.x + from, tip.x + to, map.origin.x, map.cell_mm, map.nx);
    const float* top = map.top.data() + map.index(0, iy);
    // From the front, so that the first that counts leaves few others.
    const auto scan = [&](int first, int last) {
      const int step = feed.x > 0.0 ? -1 : 1;
      int ix = step < 0 ? last : first;
      for (int left = last - first + 1; left > 0; --left, ix += step) {
        const double stands = static_cast<double>(top[ix]) - floor;
        if (stands <= 0.0) continue;
        const double x = map.x_of(ix) - tip.x;
        const double ahead = x * feed.x + y * feed.y;
        if (ball && ahead < most.ahead_mm()) return;
        if (!most.has_no_more(ahead, x * x + y * y)) cell(stands, x, y, ahead);
      }
    };
    // Over the plane of a bull nose all cells have the same: nothing more, where that is known.
    const double plane = nose.centre_mm * nose.centre_mm - y * y;
    if (!(plane > 0.0) || most.most() < -feed.z) return scan(columns.first, columns.last);
    const double beside = std::sqrt(plane) - kInside;
    const Cells level = cells_in(tip.x - beside, tip.x + beside, map.origin.x, map.cell_mm, map.nx);
    scan(std::max(columns.first, level.last + 1), columns.last);
    scan(columns.first, std::min(columns.last, level.first - 1));
  };
  const int foremost = std::clamp(static_cast<int>((tip.y + 0.5 * r * feed.y - map.origin.y) / map.cell_mm),
                                  rows.first, std::max(rows.first, rows.last + 1));
  for (int iy = foremost; iy <= rows.last; ++iy) row(iy);
  for (int iy = foremost - 1; iy >= rows.first; --iy) row(iy);
  return most.most();
}

}  // namespace capstan::engagement

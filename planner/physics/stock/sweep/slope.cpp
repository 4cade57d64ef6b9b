#include "planner/physics/stock/sweep/slope.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "planner/physics/stock/coverage.h"
#include "planner/physics/stock/sweep/rows.h"

namespace capstan::stock {
namespace {

using geometry::CutterProfile;
using geometry::ProfilePiece;
using geometry::Vec2;
using geometry::Vec3;
using rows::kThinnest;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

struct Chip {
  float mean = 0.0F;  ///< mean depth taken from the cell
  float top = 0.0F, bottom = 0.0F;
};

/// Lowers the covered part of a column to z. Parts are taken as nested: an edge that comes back to a cell is
/// the edge that was there before.
inline Chip lower(Column& c, float cover, float z) {
  const float before = c.mean();
  Chip chip;
  chip.top = c.top_mm;
  chip.bottom = z;
  if (cover >= 1.0F) {
    if (c.top_mm - z < kThinnest) {
      if (c.share <= 0.0F || c.low_mm - z < kThinnest) return {};
      chip.top = c.low_mm;
    }
    c.top_mm = std::min(c.top_mm, z);
    c.low_mm = std::min(c.low_mm, z);
    if (c.low_mm >= c.top_mm) c.share = 0.0F;
  } else if (c.share <= 0.0F) {
    if (c.top_mm - z < kThinnest) return {};
    c.low_mm = z;
    c.share = cover;
  } else if (z <= c.low_mm) {
    if (cover >= c.share) {
      // Deeper in the same place, or a little wider: decided by where most of the chip comes from.
      if ((cover - c.share) * (c.top_mm - c.low_mm) < c.share * (c.low_mm - z)) chip.top = c.low_mm;
      c.low_mm = z;
      c.share = cover;
    } else {
      if (c.low_mm - z < kThinnest) return {};
      chip.top = c.low_mm;
      c.low_mm = (cover * z + (c.share - cover) * c.low_mm) / c.share;
    }
  } else {
    if (cover <= c.share || c.top_mm - z < kThinnest) return {};
    c.low_mm = (c.share * c.low_mm + (cover - c.share) * z) / cover;
    c.share = cover;
  }
  chip.mean = before - c.mean();
  return chip;
}

class SlopeCells {
 public:
  SlopeCells(HeightMap& map, const CutterProfile& profile, const Slope& slope, Tally& tally)
      : map_(map),
        profile_(profile),
        f_(slope),
        tally_(tally),
        bin_scale_(static_cast<double>(Tally::kBins) / (2.0 * slope.radius)) {}

  void each() {
    const int iy0 = first(std::min(f_.a.y, f_.b.y) - f_.reach, map_.origin.y);
    const int iy1 = last(std::max(f_.a.y, f_.b.y) + f_.reach, map_.origin.y, map_.ny);
    for (int iy = iy0; iy <= iy1; ++iy) {
      const double y = map_.y_of(iy);
      Span row = capsule_row(f_.a, f_.b, f_.reach, y);
      if (f_.half) clip_ahead(row, y);
      if (row.lo > row.hi) continue;
      cells(iy, row.lo, row.hi);
    }
  }

 private:
  [[nodiscard]] int first(double p, double origin) const {
    return static_cast<int>(std::clamp((p - origin) / map_.cell_mm, 0.0, 1e9));
  }
  [[nodiscard]] int last(double p, double origin, int n) const {
    return static_cast<int>(std::clamp(std::floor((p - origin) / map_.cell_mm), -1.0, n - 1.0));
  }

  void clip_ahead(Span& row, double y) const {
    const double side = f_.ahead.y * (y - f_.a.y);
    if (std::abs(f_.ahead.x) < 1e-12) {
      if (side < -map_.cell_mm) row = {};
      return;
    }
    const double x = f_.a.x - side / f_.ahead.x;
    if (f_.ahead.x > 0.0) {
      row.lo = std::max(row.lo, x);
    } else {
      row.hi = std::min(row.hi, x);
    }
  }

  void cells(int iy, double lo, double hi) {
    const int ix0 = first(lo, map_.origin.x);
    const int ix1 = last(hi, map_.origin.x, map_.nx);
    const double cell = map_.cell_mm;
    const double inner = std::max(0.0, f_.radius - kHalfDiagonal * cell);
    const double inner2 = inner * inner;
    const auto base = static_cast<float>(std::max(0.0, f_.base));
    Vec2 p{0.0, map_.y_of(iy)};
    Sums sums;
    for (int ix = ix0; ix <= ix1; ++ix) {
      const std::size_t at = map_.index(ix, iy);
      if (map_.top[at] <= base) continue;
      p.x = map_.x_of(ix);
      const Vec2 r = p - f_.a;
      const double along = dot(r, f_.unit);
      const double across = -geometry::cross(f_.unit, r);
      const double past = along - std::clamp(along, 0.0, f_.length);
      const double distance2 = across * across + past * past;
      Column column = map_.at(at);
      Chip chip;
      if (distance2 > inner2) {
        chip = rim(column, p, std::sqrt(distance2), p - (f_.a + (along - past) * f_.unit));
      } else {
        // No part of the outline there is lower than this.
        if (static_cast<double>(column.top_mm) <= f_.base + profile_.height(std::sqrt(distance2))) continue;
        chip = lower(column, 1.0F, static_cast<float>(std::max(0.0, height(p))));
      }
      if (chip.mean <= 0.0F) continue;
      map_.set(at, column);
      take(chip, across, sums);
    }
    close_bin(sums);
    const double area = cell * cell;
    tally_.removed_mm3 += area * sums.v;
    tally_.sum_x += area * sums.vx;
    tally_.sum_y += area * 0.5 * (sums.vz - 2.0 * f_.base * sums.v);
    if (sums.right >= sums.left) {
      tally_.left_mm = std::min(tally_.left_mm, std::max(-f_.radius, sums.left - 0.5 * cell));
      tally_.right_mm = std::max(tally_.right_mm, std::min(f_.radius, sums.right + 0.5 * cell));
    }
  }

  /// Volume per cell area over one row, its moments, and the X range.
  struct Sums {
    double v = 0.0, vx = 0.0, vz = 0.0;
    double left = 1e300, right = -1e300;
    int bin = -1;
    float low = 1e30F, high = -1e30F;  ///< in that bin
  };

  /// Cutter surface above the map's floor.
  [[nodiscard]] double height(Vec2 p) const {
    const Vec2 r = p - f_.a;
    return f_.start +
           swept_height(profile_, dot(r, f_.unit), geometry::cross(f_.unit, r), f_.length, f_.rise);
  }

  /// A cell that the cutter's rim may cross. `out`: from the track to the cell.
  Chip rim(Column& column, Vec2 p, double distance, Vec2 out) const {
    const double cell = map_.cell_mm;
    if (distance >= f_.radius + kHalfDiagonal * cell) return {};
    const double cover = coverage(f_.radius - distance, out, cell);
    // The height is that in the middle of the covered part.
    const double at = distance + 0.5 * cell < f_.radius
                          ? distance
                          : 0.5 * (std::min(f_.radius, std::max(0.0, distance - 0.5 * cell)) + f_.radius);
    const Vec2 there = distance > 0.0 ? p + (at / distance - 1.0) * out : p;
    return lower(column, static_cast<float>(cover), static_cast<float>(std::max(0.0, height(there))));
  }

  void take(const Chip& chip, double across, Sums& sums) {
    const auto v = static_cast<double>(chip.mean);
    const double x = std::min(f_.radius, std::max(-f_.radius, across));
    sums.v += v;
    sums.vx += v * x;
    sums.vz += v * (static_cast<double>(chip.top) + static_cast<double>(chip.bottom));
    sums.left = std::min(sums.left, across);
    sums.right = std::max(sums.right, across);
    const int bin =
        std::min(static_cast<int>(Tally::kBins) - 1, static_cast<int>((x + f_.radius) * bin_scale_));
    if (bin != sums.bin) {
      close_bin(sums);
      sums.bin = bin;
    }
    sums.low = std::min(sums.low, chip.bottom);
    sums.high = std::max(sums.high, chip.top);
  }

  /// Neighbours in a row mostly share a bin.
  void close_bin(Sums& sums) {
    if (sums.bin >= 0) {
      const auto b = static_cast<std::size_t>(sums.bin);
      tally_.low[b] = std::min(tally_.low[b], sums.low);
      tally_.high[b] = std::max(tally_.high[b], sums.high);
    }
    sums.low = 1e30F;
    sums.high = -1e30F;
  }

  HeightMap& map_;
  const CutterProfile& profile_;
  const Slope& f_;
  Tally& tally_;
  double bin_scale_;
};

/// Offset u (cell ahead of the axis) at which z falls no further on one arc piece: profile'(d) u / d = slope.
double still_point(const ProfilePiece& p, double across, double slope) {
  const double w = std::abs(across);
  const double s = std::abs(slope);
  if (p.rc_mm == 0.0) {
    return s * std::sqrt(std::max(0.0, (p.radius_mm * p.radius_mm - w * w) / (1.0 + s * s)));
  }
  double lo = std::sqrt(std::max(0.0, p.r0_mm * p.r0_mm - w * w));
  double hi = std::sqrt(std::max(0.0, p.r1_mm * p.r1_mm - w * w));
  for (int k = 0; k < 60 && hi - lo > 1e-12; ++k) {
    const double u = 0.5 * (lo + hi);
    const double d = std::sqrt(u * u + w * w);
    const double off = d - p.rc_mm;
    const double root = std::sqrt(std::max(0.0, (p.radius_mm - off) * (p.radius_mm + off)));
    (off * u < s * d * root ? lo : hi) = u;
  }
  return 0.5 * (lo + hi);
}

/// d profile / du at a cell u ahead of the axis (from below where the outline has a kink); not a number on
/// the axis.
double steepness(const CutterProfile& profile, double u, double across) {
  const double d = std::min(std::sqrt(u * u + across * across), profile.radius_mm);
  if (d < 1e-12) return std::numeric_limits<double>::quiet_NaN();
  for (const ProfilePiece& p : profile.pieces) {
    if (d > p.r1_mm) continue;
    if (p.radius_mm <= 0.0) return p.slope * u / d;
    const double off = d - p.rc_mm;
    return off / std::sqrt(std::max(1e-300, (p.radius_mm - off) * (p.radius_mm + off))) * u / d;
  }
  return std::numeric_limits<double>::quiet_NaN();
}

}  // namespace

double swept_height(const CutterProfile& profile, double along, double across, double length, double rise) {
  const double reach2 = profile.radius_mm * profile.radius_mm - across * across;
  if (reach2 < 0.0) return kInfinity;
  const double slope = rise / length;
  const double sign = slope >= 0.0 ? 1.0 : -1.0;
  const double reach = std::sqrt(reach2);
  // u = along - position: how far the cell lies ahead of the axis.
  const double lo = std::max(along - length, -reach);
  const double hi = std::min(along, reach);
  if (lo > hi) return kInfinity;
  if (is_flat(profile)) return slope * (along - (slope >= 0.0 ? hi : lo));
  const auto z = [&](double u) {
    const double d = std::min(std::sqrt(u * u + across * across), profile.radius_mm);
    return slope * (along - u) + profile.height(d);
  };
  // z is convex in u: on a short track it mostly falls or rises all the way.
  if (steepness(profile, lo, across) >= slope) return z(lo);
  if (steepness(profile, hi, across) <= slope) return z(hi);
  double best = std::min(z(lo), z(hi));
  const auto look = [&](double u) { best = std::min(best, z(std::clamp(sign * u, lo, hi))); };
  for (const ProfilePiece& p : profile.pieces) {
    if (p.r1_mm * p.r1_mm >= across * across) look(std::sqrt(p.r1_mm * p.r1_mm - across * across));
    if (p.radius_mm > 0.0) {
      look(still_point(p, across, slope));
    } else if (p.slope > std::abs(slope)) {
      const double q = slope / p.slope;
      look(std::abs(q * across) / std::sqrt(1.0 - q * q));
    }
  }
  return best;
}

void sweep_slope(HeightMap& map, const CutterProfile& profile, const Slope& slope, Tally& tally) {
  SlopeCells(map, profile, slope, tally).each();
}

}  // namespace capstan::stock

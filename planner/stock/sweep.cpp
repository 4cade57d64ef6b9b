#include "planner/stock/sweep.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <type_traits>

#include "planner/stock/coverage.h"

namespace capstan::stock {
namespace {

using geometry::CutterProfile;
using geometry::ProfilePiece;
using geometry::Vec2;
using geometry::Vec3;

constexpr double kHalfDiagonal = 0.70711;
constexpr double kInfinity = std::numeric_limits<double>::infinity();
/// Removals thinner than this are left standing: single precision could not tell them from rounding, mm.
constexpr float kThinnest = 2e-5F;

// --- one cell
// -----------------------------------------------------------------------------------------------

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
      // Deeper in the same place, or a little wider: told by where most of the chip comes from.
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

// --- cutter outlines
// ----------------------------------------------------------------------------------------

/// Height above the tip as a function of the squared distance from the axis.
/// `clear`: told cheaply that the outline there is no lower than t; false when it may be.
struct FlatOutline {
  double operator()(double /*r2*/) const { return 0.0; }
  [[nodiscard]] bool clear(double /*r2*/, double /*t*/) const { return false; }
};
struct BallOutline {
  double radius;
  double operator()(double r2) const { return radius - std::sqrt(std::max(0.0, radius * radius - r2)); }
  [[nodiscard]] bool clear(double r2, double t) const { return t < radius && r2 >= t * (2.0 * radius - t); }
};
struct BullOutline {
  double disc, ball;
  double operator()(double r2) const {
    if (r2 <= disc * disc) return 0.0;
    const double off = std::sqrt(r2) - disc;
    return ball - std::sqrt(std::max(0.0, (ball - off) * (ball + off)));
  }
  [[nodiscard]] bool clear(double /*r2*/, double /*t*/) const { return false; }
};
struct AnyOutline {
  const CutterProfile& profile;
  double operator()(double r2) const { return profile.height(std::min(std::sqrt(r2), profile.radius_mm)); }
  [[nodiscard]] bool clear(double /*r2*/, double /*t*/) const { return false; }
};

/// Cutter surface over a level or standing track: tip and outline.
template <class Outline>
struct LevelSurface {
  double tip;
  Outline outline;
  double operator()(Vec2 /*place*/, double r2) const { return tip + outline(r2); }
  [[nodiscard]] bool clear(double r2, double top) const { return outline.clear(r2, top - tip); }
};

/// Cutter surface over a straight sloping track.
struct SlopeSurface {
  const CutterProfile& profile;
  Vec2 from, unit;
  double length, start, rise;
  double operator()(Vec2 place, double /*r2*/) const {
    const Vec2 r = place - from;
    return start + swept_height(profile, dot(r, unit), geometry::cross(unit, r), length, rise);
  }
  [[nodiscard]] bool clear(double r2, double top) const {
    return top <= start + std::min(0.0, rise) + profile.height(std::min(std::sqrt(r2), profile.radius_mm));
  }
};

// --- tracks
// -------------------------------------------------------------------------------------------------

/// Where a cell lies against a track: its squared distance and X of the section. `out` points from the track
/// to the cell.
struct Seat {
  double distance2, across;
};

struct LineSeat {
  Vec2 from, to, unit;
  double length;
  [[nodiscard]] Vec2 out(Vec2 p) const {
    const Vec2 r = p - from;
    return r - std::clamp(dot(r, unit), 0.0, length) * unit;
  }
  Seat operator()(Vec2 p) const {
    const Vec2 r = p - from;
    const double along = dot(r, unit);
    const double across = -geometry::cross(unit, r);
    const double past = along - std::clamp(along, 0.0, length);
    return {across * across + past * past, across};
  }
};

struct ArcSeat {
  Vec2 from, to, centre;
  double radius, turn;  ///< turn: +1 counter-clockwise; at most a half turn
  [[nodiscard]] bool within(Vec2 r) const {
    return turn * geometry::cross(from - centre, r) >= 0.0 && turn * geometry::cross(r, to - centre) >= 0.0;
  }
  [[nodiscard]] Vec2 out(Vec2 p) const {
    const Vec2 r = p - centre;
    const double d = norm(r);
    if (within(r) && d > 0.0) return (1.0 - radius / d) * r;
    const Vec2 a = p - from;
    const Vec2 b = p - to;
    return dot(a, a) < dot(b, b) ? a : b;
  }
  Seat operator()(Vec2 p) const {
    const Vec2 r = p - centre;
    const double off = std::sqrt(dot(r, r)) - radius;
    if (within(r)) return {off * off, turn * off};
    const Vec2 a = p - from;
    const Vec2 b = p - to;
    return {std::min(dot(a, a), dot(b, b)), turn * off};
  }
};

struct PointSeat {
  Vec2 at, heading;
  [[nodiscard]] Vec2 out(Vec2 p) const { return p - at; }
  Seat operator()(Vec2 p) const {
    const Vec2 r = p - at;
    return {dot(r, r), -geometry::cross(heading, r)};
  }
};

// --- the loop over cells
// ------------------------------------------------------------------------------------

struct Frame {
  Vec2 a, b;          ///< ends of the track
  double reach;       ///< of the capsule around the chord that holds all touched cells
  double radius;      ///< of the cutter
  double base;        ///< lowest tip height above the map's floor
  bool half = false;  ///< only cells ahead of a, in direction `ahead`
  Vec2 ahead;
  double hollow = 0.0;  ///< cells nearer than this to a are cut already
};

class Cells {
 public:
  Cells(HeightMap& map, const Frame& frame, Tally& tally)
      : map_(map),
        f_(frame),
        tally_(tally),
        bin_scale_(static_cast<double>(Tally::kBins) / (2.0 * frame.radius)) {}

  /// `seat`: Vec2 -> Seat; `surface`: (place, squared distance) -> cutter surface above the map's floor.
  template <class SeatOf, class SurfaceOf>
  void each(const SeatOf& seat, const SurfaceOf& surface) {
    const double cell = map_.cell_mm;
    const int iy0 = first(std::min(f_.a.y, f_.b.y) - f_.reach, map_.origin.y);
    const int iy1 = last(std::max(f_.a.y, f_.b.y) + f_.reach, map_.origin.y, map_.ny);
    for (int iy = iy0; iy <= iy1; ++iy) {
      const double y = map_.y_of(iy);
      Span row = capsule_row(f_.a, f_.b, f_.reach, y);
      if (f_.half) clip_ahead(row, y);
      if (row.lo > row.hi) continue;
      const double dy = y - f_.a.y;
      const double h2 = f_.hollow * f_.hollow - dy * dy;
      if (f_.hollow > 0.0 && h2 > 0.0) {
        const double h = std::sqrt(h2) - 0.5 * cell;
        if (h > 0.0) {
          cells(iy, row.lo, std::min(row.hi, f_.a.x - h), seat, surface);
          row.lo = std::max(row.lo, f_.a.x + h);
          // The cell that holds the border was done by the first run.
          row.lo = std::max(row.lo, map_.origin.x + cell * (last_done_ + 1));
        }
      }
      cells(iy, row.lo, row.hi, seat, surface);
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

  template <class SeatOf, class SurfaceOf>
  void cells(int iy, double lo, double hi, const SeatOf& seat, const SurfaceOf& surface) {
    const int ix0 = first(lo, map_.origin.x);
    const int ix1 = last(hi, map_.origin.x, map_.nx);
    last_done_ = ix1;
    const double cell = map_.cell_mm;
    const double inner = std::max(0.0, f_.radius - kHalfDiagonal * cell);
    const double inner2 = inner * inner;
    const auto base = static_cast<float>(std::max(0.0, f_.base));
    Column* const row =
        map_.columns.data() + static_cast<std::size_t>(iy) * static_cast<std::size_t>(map_.nx);
    Vec2 p{0.0, map_.y_of(iy)};
    Sums sums;
    for (int ix = ix0; ix <= ix1; ++ix) {
      Column& column = row[ix];
      if (column.top_mm <= base) continue;
      p.x = map_.x_of(ix);
      const Seat s = seat(p);
      if (s.distance2 > inner2) {
        rim(column, p, s, seat, surface, sums);
        continue;
      }
      if (surface.clear(s.distance2, static_cast<double>(column.top_mm))) continue;
      const auto z = static_cast<float>(std::max(0.0, surface(p, s.distance2)));
      if (column.share <= 0.0F) {
        const float depth = column.top_mm - z;
        if (depth < kThinnest) continue;
        take({depth, column.top_mm, z}, s.across, sums);
        column.top_mm = column.low_mm = z;
      } else {
        const Chip chip = lower(column, 1.0F, z);
        if (chip.mean > 0.0F) take(chip, s.across, sums);
      }
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

  /// A cell that the cutter's rim may cross.
  template <class SeatOf, class SurfaceOf>
  void rim(Column& column, Vec2 p, const Seat& s, const SeatOf& seat, const SurfaceOf& surface, Sums& sums) {
    const double cell = map_.cell_mm;
    const double distance = std::sqrt(s.distance2);
    if (distance >= f_.radius + kHalfDiagonal * cell) return;
    const Vec2 out = seat.out(p);
    const double cover = coverage(f_.radius - distance, out, cell);
    // The height is that in the middle of the covered part.
    const double at = distance + 0.5 * cell < f_.radius
                          ? distance
                          : 0.5 * (std::min(f_.radius, std::max(0.0, distance - 0.5 * cell)) + f_.radius);
    const Vec2 there = distance > 0.0 ? p + (at / distance - 1.0) * out : p;
    const double z = std::max(0.0, surface(there, at * at));
    const Chip chip = lower(column, static_cast<float>(cover), static_cast<float>(z));
    if (chip.mean > 0.0F) take(chip, s.across, sums);
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
  const Frame& f_;
  Tally& tally_;
  double bin_scale_;
  int last_done_ = -1;
};

bool is_flat(const CutterProfile& p) {
  return p.pieces.size() == 1 && p.pieces[0].radius_mm <= 0.0 && p.pieces[0].slope == 0.0;
}
bool is_ball(const CutterProfile& p) {
  return p.pieces.size() == 1 && p.pieces[0].radius_mm > 0.0 && p.pieces[0].rc_mm == 0.0;
}

bool is_bull(const CutterProfile& p) {
  return p.pieces.size() == 2 && p.pieces[0].radius_mm <= 0.0 && p.pieces[0].slope == 0.0 &&
         p.pieces[1].radius_mm > 0.0 && p.pieces[1].rc_mm == p.pieces[0].r1_mm;
}

/// Calls body with the cheapest form of the outline.
template <class Body>
void with_outline(const CutterProfile& profile, const Body& body) {
  if (is_flat(profile)) return body(FlatOutline{});
  if (is_ball(profile)) return body(BallOutline{profile.pieces[0].radius_mm});
  if (is_bull(profile)) return body(BullOutline{profile.pieces[1].rc_mm, profile.pieces[1].radius_mm});
  body(AnyOutline{profile});
}

void sweep_level(HeightMap& map, const CutterProfile& profile, const Track& t, const Frame& frame,
                 double length, Tally& tally) {
  const double tip = frame.base;
  const Vec2 a = frame.a;
  const Vec2 b = frame.b;
  with_outline(profile, [&](const auto& outline) {
    const LevelSurface<std::decay_t<decltype(outline)>> surface{tip, outline};
    Cells cells(map, frame, tally);
    if (t.arc) {
      cells.each(ArcSeat{a, b, t.centre, norm(a - t.centre), t.clockwise ? -1.0 : 1.0}, surface);
    } else {
      cells.each(LineSeat{a, b, (1.0 / length) * (b - a), length}, surface);
    }
  });
}

void sweep_slope(HeightMap& map, const CutterProfile& profile, const Track& t, const Frame& frame,
                 double length, Tally& tally) {
  const Vec2 unit = (1.0 / length) * (frame.b - frame.a);
  const double start = t.from.z - map.origin.z;
  const double rise = t.to.z - t.from.z;
  const SlopeSurface surface{profile, frame.a, unit, length, start, rise};
  Cells(map, frame, tally).each(LineSeat{frame.a, frame.b, unit, length}, surface);
}

void sweep_down(HeightMap& map, const CutterProfile& profile, const Frame& frame, Vec2 heading,
                Tally& tally) {
  const double tip = frame.base;
  with_outline(profile, [&](const auto& outline) {
    const LevelSurface<std::decay_t<decltype(outline)>> surface{tip, outline};
    Cells(map, frame, tally).each(PointSeat{frame.a, (1.0 / norm(heading)) * heading}, surface);
  });
}

void sweep_chords(HeightMap& map, const CutterProfile& profile, const Track& t, bool behind_is_cut,
                  Vec2 heading, Tally& tally) {
  model::CutterPath arc;
  arc.start(t.from);
  arc.arc(t.to, t.centre, t.clockwise, model::MoveRole::kCut);
  const double radius = norm(xy(t.from) - t.centre);
  // sagitta = radius (1 - cos(half)) <= cell / 20
  const double half = std::acos(std::clamp(1.0 - map.cell_mm / (20.0 * std::max(radius, 1e-9)), 0.0, 1.0));
  const int n = std::clamp(static_cast<int>(std::ceil(model::arc_sweep(arc, 1) / (2.0 * half))), 1, 10000);
  Vec3 from = t.from;
  for (int k = 1; k <= n; ++k) {
    const Vec3 to = k == n ? t.to : model::point_on_move(arc, 1, static_cast<double>(k) / n);
    sweep(map, profile, {.from = from, .to = to, .arc = false, .centre = {}, .clockwise = false},
          behind_is_cut || k > 1, heading, tally);
    from = to;
  }
}

// --- the envelope of a sloping straight track
// ---------------------------------------------------------------

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

void sweep(HeightMap& map, const CutterProfile& profile, const Track& track, bool behind_is_cut, Vec2 heading,
           Tally& tally) {
  const double rise = track.to.z - track.from.z;
  if (track.arc && rise != 0.0) return sweep_chords(map, profile, track, behind_is_cut, heading, tally);
  const Vec2 a = xy(track.from);
  const Vec2 b = xy(track.to);
  const double length = norm(b - a);
  Frame frame{.a = a,
              .b = b,
              .reach = profile.radius_mm + kHalfDiagonal * map.cell_mm,
              .radius = profile.radius_mm,
              .base = std::min(track.from.z, track.to.z) - map.origin.z,
              .ahead = {}};
  if (length < 1e-9) {
    if (behind_is_cut && rise >= 0.0) return;
    return sweep_down(map, profile, frame, heading, tally);
  }
  frame.ahead = (1.0 / length) * (b - a);
  if (track.arc) {
    const Vec2 r = a - track.centre;
    const double turn = track.clockwise ? -1.0 : 1.0;
    frame.ahead = (turn / norm(r)) * Vec2{-r.y, r.x};
    const double radius = norm(r);
    const double half_chord = std::min(0.5 * length, radius);
    frame.reach += radius - std::sqrt((radius - half_chord) * (radius + half_chord));
  }
  if (behind_is_cut && rise >= 0.0) {
    frame.half = true;
    if (is_flat(profile)) frame.hollow = std::max(0.0, profile.radius_mm - kHalfDiagonal * map.cell_mm);
  }
  if (rise == 0.0) {
    sweep_level(map, profile, track, frame, length, tally);
  } else {
    sweep_slope(map, profile, track, frame, length, tally);
  }
}

double cut(HeightMap& map, const CutterProfile& profile, const model::CutterPath& path, std::size_t i) {
  Tally tally;
  const Vec3 to = path.point(i);
  const Vec3 from = i == 0 ? to : path.point(i - 1);
  const Vec2 heading{1.0, 0.0};
  const bool arc = path.kind[i] == model::MoveKind::kArcCw || path.kind[i] == model::MoveKind::kArcCcw;
  if (!arc || i == 0) {
    sweep(map, profile, {.from = from, .to = to, .arc = false, .centre = {}, .clockwise = false}, false,
          heading, tally);
    return tally.removed_mm3;
  }
  // Thirty degrees at a time: the box around the chord then fits the arc.
  const int n =
      std::max(1, static_cast<int>(std::ceil(model::arc_sweep(path, i) / (std::numbers::pi / 6.0))));
  Vec3 last = from;
  for (int k = 1; k <= n; ++k) {
    const Vec3 next = k == n ? to : model::point_on_move(path, i, static_cast<double>(k) / n);
    sweep(map, profile,
          {.from = last,
           .to = next,
           .arc = true,
           .centre = {path.cx[i], path.cy[i]},
           .clockwise = path.kind[i] == model::MoveKind::kArcCw},
          false, heading, tally);
    last = next;
  }
  return tally.removed_mm3;
}

double cut(HeightMap& map, const CutterProfile& profile, const model::CutterPath& path) {
  double sum = 0.0;
  for (std::size_t i = 0; i < path.size(); ++i) sum += cut(map, profile, path, i);
  return sum;
}

double clear_height(const HeightMap& map, const CutterProfile& profile, Vec2 axis) {
  const double half = kHalfDiagonal * map.cell_mm;
  const double reach = profile.radius_mm + half;
  const auto index = [&](double p, double origin, int n) {
    return static_cast<int>(std::clamp(std::floor((p - origin) / map.cell_mm), 0.0, n - 1.0));
  };
  double best = 0.0;
  for (int iy = index(axis.y - reach, map.origin.y, map.ny);
       iy <= index(axis.y + reach, map.origin.y, map.ny); ++iy) {
    for (int ix = index(axis.x - reach, map.origin.x, map.nx);
         ix <= index(axis.x + reach, map.origin.x, map.nx); ++ix) {
      const auto top = static_cast<double>(map.at(ix, iy).top_mm);
      if (top <= best) continue;
      const double d = norm(Vec2{map.x_of(ix), map.y_of(iy)} - axis) - half;
      if (d > profile.radius_mm) continue;
      best = std::max(best, top - profile.height(std::max(0.0, d)));
    }
  }
  return map.origin.z + best;
}

}  // namespace capstan::stock

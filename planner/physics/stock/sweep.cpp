#include "planner/physics/stock/sweep.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "planner/ground/base/stopping.h"
#include "planner/physics/stock/sweep/rows.h"
#include "planner/physics/stock/sweep/slope.h"

namespace capstan::stock {
namespace {

using geometry::CutterProfile;
using geometry::ProfilePiece;
using geometry::Vec2;
using geometry::Vec3;

static_assert(Tally::kBins == rows::kBins);
constexpr double kLongest = 20.0;  // mm: so far single precision keeps a slope's heights

rows::Piece piece_of(const ProfilePiece& p) {
  rows::Piece out;
  out.r0 = static_cast<float>(p.r0_mm);
  out.r0_squared = out.r0 * out.r0;
  out.z0 = static_cast<float>(p.z0_mm);
  if (p.radius_mm > 0.0) {
    out.form = p.rc_mm == 0.0 ? rows::Form::kBall : rows::Form::kRound;
    out.radius = static_cast<float>(p.radius_mm);
    out.radius_squared = out.radius * out.radius;
    out.rc = static_cast<float>(p.rc_mm);
    out.zc = static_cast<float>(p.zc_mm);
  } else if (p.slope != 0.0) {
    out.form = rows::Form::kSlant;
    out.slope = static_cast<float>(p.slope);
  }
  return out;
}

/// A flat, a ball, a bull nose or a cone with or without a flat tip: outlines whose envelopes over a slope
/// are found in vectors.
bool is_plain(const CutterProfile& p) {
  const auto level = [](const ProfilePiece& q) { return q.radius_mm <= 0.0 && q.slope == 0.0; };
  const auto slant = [](const ProfilePiece& q) {
    return q.radius_mm <= 0.0 && q.slope != 0.0 && q.z0_mm == 0.0;
  };
  const auto round = [](const ProfilePiece& q) { return q.radius_mm > 0.0 && geometry::ends_upright(q); };
  if (p.pieces.size() == 1)
    return slant(p.pieces[0]) || level(p.pieces[0]) || (round(p.pieces[0]) && p.pieces[0].rc_mm == 0.0);
  return p.pieces.size() == 2 && level(p.pieces[0]) &&
         (slant(p.pieces[1]) || (round(p.pieces[1]) && p.pieces[1].rc_mm > 0.0));
}

/// The cutter, on a track from a to b.
rows::Work work_of(const HeightMap& map, const CutterProfile& profile, Vec2 a, Vec2 b, double tip_z) {
  if (profile.pieces.size() > static_cast<std::size_t>(rows::kPieces)) {
    throw std::logic_error("an outline of too many pieces");
  }
  rows::Work w;
  for (const ProfilePiece& p : profile.pieces) w.piece[w.pieces++] = piece_of(p);
  w.radius = profile.radius_mm;
  w.tip = tip_z - map.origin.z;
  w.ax = a.x;
  w.ay = a.y;
  w.bx = b.x;
  w.by = b.y;
  w.length = norm(b - a);
  return w;
}

/// Material reaches no higher than `ceiling`: that bounds the radius at which the cutter can touch it.
double touching_radius(const CutterProfile& profile, double ceiling_over_tip) {
  if (ceiling_over_tip >= profile.height(profile.radius_mm)) return profile.radius_mm;
  return ceiling_over_tip <= 0.0 ? 0.0 : profile.radius_at(ceiling_over_tip);
}

void take(HeightMap& map, const rows::Work& w, Tally& tally) {
  const rows::Grid grid{.top = map.top.data(),
                        .low = map.low.data(),
                        .share = map.share.data(),
                        .x0 = map.x_of(0),
                        .y0 = map.y_of(0),
                        .cell = map.cell_mm,
                        .nx = map.nx,
                        .ny = map.ny};
  rows::Sums sums;
  rows::best()(grid, w, sums);
  const double area = map.cell_mm * map.cell_mm;
  tally.removed_mm3 += area * sums.volume;
  tally.sum_x += area * sums.x;
  tally.sum_y += area * sums.y;
  if (sums.right < sums.left) return;
  const double half = 0.5 * map.cell_mm;
  tally.left_mm = std::min(tally.left_mm, std::max(-w.radius, static_cast<double>(sums.left) - half));
  tally.right_mm = std::max(tally.right_mm, std::min(w.radius, static_cast<double>(sums.right) + half));
  for (std::size_t b = 0; b < Tally::kBins; ++b) {
    tally.low[b] = std::min(tally.low[b], sums.low[b]);
    tally.high[b] = std::max(tally.high[b], sums.high[b]);
  }
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

}  // namespace

void sweep(HeightMap& map, const CutterProfile& profile, const Track& track, bool behind_is_cut, Vec2 heading,
           Tally& tally) {
  // By the cells under the cutter: a wide one takes as long as many narrow ones.
  const double across = 2.0 * profile.radius_mm / map.cell_mm;
  tick(1U + static_cast<unsigned>(std::min(64.0, across * across / 512.0)));
  const double rise = track.to.z - track.from.z;
  if (track.arc && rise != 0.0) return sweep_chords(map, profile, track, behind_is_cut, heading, tally);
  const Vec2 a = xy(track.from);
  const Vec2 b = xy(track.to);
  const double length = norm(b - a);
  const double half_diagonal = kHalfDiagonal * map.cell_mm;
  const double lowest = std::min(track.from.z, track.to.z);
  const bool sloping = length >= 1e-9 && rise != 0.0;
  if (sloping && !(is_plain(profile) && length < kLongest)) {
    const Vec2 unit = (1.0 / length) * (b - a);
    return sweep_slope(map, profile,
                       {.a = a,
                        .b = b,
                        .reach = profile.radius_mm + half_diagonal,
                        .radius = profile.radius_mm,
                        .base = lowest - map.origin.z,
                        .half = behind_is_cut && rise >= 0.0,
                        .ahead = unit,
                        .unit = unit,
                        .length = length,
                        .start = track.from.z - map.origin.z,
                        .rise = rise},
                       tally);
  }
  const bool standing = length < 1e-9;
  if (standing && behind_is_cut && rise >= 0.0) return;
  rows::Work w = work_of(map, profile, a, standing ? a : b, lowest);
  w.inner = profile.radius_mm - half_diagonal;
  w.reach = touching_radius(profile, track.ceiling_mm - lowest) + half_diagonal;
  if (sloping) {
    w.start = track.from.z - map.origin.z;
    w.slope = rise / length;
  }
  Vec2 ahead = standing ? heading : b - a;
  ahead = (1.0 / norm(ahead)) * ahead;
  w.ux = ahead.x;
  w.uy = ahead.y;
  if (track.arc && !standing) {
    const Vec2 from = a - track.centre;
    const Vec2 to = b - track.centre;
    w.arc = true;
    w.arc_radius = norm(from);
    w.turn = track.clockwise ? -1.0 : 1.0;
    w.ex = from.x / w.arc_radius;
    w.ey = from.y / w.arc_radius;
    w.gx = to.x / norm(to);
    w.gy = to.y / norm(to);
    ahead = w.turn * Vec2{-w.ey, w.ex};
    const double half_chord = std::min(0.5 * length, w.arc_radius);
    const double sagitta =
        w.arc_radius - std::sqrt((w.arc_radius - half_chord) * (w.arc_radius + half_chord));
    w.reach += sagitta;
    w.inner -= sagitta;
  }
  w.hx = ahead.x;
  w.hy = ahead.y;
  if (behind_is_cut && !standing && rise >= 0.0) {
    w.half = true;
    const ProfilePiece& bottom = profile.pieces.front();
    if (w.piece[0].form == rows::Form::kLevel && !sloping)
      w.hollow = std::max(0.0, bottom.r1_mm - half_diagonal);
  }
  take(map, w, tally);
}

bool Upright::goes_back(const model::CutterPath& path, std::size_t i) {
  constexpr double kSame = 1e-9;
  const Vec3 at = path.point(i);
  if (i == 0 || is_arc(path.kind[i]) || norm(xy(at) - xy(path.point(i - 1))) > kSame) {
    lowest_mm_ = at.z;
    return false;
  }
  const bool back = at.z >= lowest_mm_;
  lowest_mm_ = std::min(lowest_mm_, at.z);
  return back;
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
  Upright upright;
  for (std::size_t i = 0; i < path.size(); ++i)
    if (!upright.goes_back(path, i)) sum += cut(map, profile, path, i);
  return sum;
}

}  // namespace capstan::stock

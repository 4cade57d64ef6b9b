#include "planner/ground/geometry/profile.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace capstan::geometry {
namespace {

double height_on(const ProfilePiece& p, double r_mm) {
  if (p.radius_mm > 0.0) {
    const double d = std::min(std::abs(r_mm - p.rc_mm), p.radius_mm);
    return p.zc_mm - std::sqrt((p.radius_mm - d) * (p.radius_mm + d));
  }
  return p.z0_mm + p.slope * (r_mm - p.r0_mm);
}

double slope_on(const ProfilePiece& p, double r_mm) {
  if (p.radius_mm <= 0.0) return p.slope;
  const double off = r_mm - p.rc_mm;
  const double below = (p.radius_mm - off) * (p.radius_mm + off);
  if (below > 0.0) return off / std::sqrt(below);
  return std::copysign(std::numeric_limits<double>::infinity(), off);
}

/// Where a line that rises by `slope` stands off its foot, of a unit normal: to the side, and down.
struct Lean {
  double sine, cosine;
};
Lean lean_of(double slope) {
  if (std::isinf(slope)) return {1.0, 0.0};
  const double root = std::sqrt(1.0 + slope * slope);
  return {slope / root, 1.0 / root};
}

constexpr double kSameSlope = 1e-9;   // of two pieces that meet: rounding, no corner
constexpr double kSameHeight = 1e-9;  // mm

}  // namespace

bool ends_upright(const ProfilePiece& arc) {
  return std::abs(arc.r1_mm - arc.rc_mm - arc.radius_mm) <= kSameHeight;
}

double CutterProfile::height(double r_mm) const {
  if (r_mm > radius_mm) return std::numeric_limits<double>::infinity();
  for (const ProfilePiece& p : pieces) {
    if (r_mm <= p.r1_mm) return height_on(p, r_mm);
  }
  return std::numeric_limits<double>::infinity();
}

double CutterProfile::radius_at(double height_mm) const {
  for (auto p = pieces.rbegin(); p != pieces.rend(); ++p) {
    if (height(p->r1_mm) <= height_mm) return p->r1_mm;
    if (p->radius_mm > 0.0) {
      const double below = p->zc_mm - height_mm;  // under the arc's centre
      if (below > p->radius_mm) continue;
      const double r = p->rc_mm + std::sqrt((p->radius_mm - below) * (p->radius_mm + below));
      if (r >= p->r0_mm) return std::min(r, p->r1_mm);
    } else if (p->z0_mm <= height_mm && p->slope > 0.0) {
      return std::min(p->r0_mm + (height_mm - p->z0_mm) / p->slope, p->r1_mm);
    }
  }
  return 0.0;
}

double ConvexOutline::height(double r_mm) const {
  for (std::size_t i = 0; i + 1 < pieces; ++i)
    if (r_mm <= piece[i].r1_mm) return height_on(piece[i], r_mm);
  return height_on(piece[pieces - 1], std::min(r_mm, radius_mm));
}

double ConvexOutline::touch_radius(double slope) const {
  for (std::size_t i = 0; i < pieces; ++i) {
    const ProfilePiece& p = piece[i];
    if (slope <= slope_on(p, p.r0_mm)) return p.r0_mm;
    if (p.radius_mm > 0.0 && slope < slope_on(p, p.r1_mm))
      return std::clamp(p.rc_mm + p.radius_mm * lean_of(slope).sine, p.r0_mm, p.r1_mm);
  }
  return radius_mm;
}

double ConvexOutline::level_radius() const {
  const ProfilePiece& p = piece[0];
  return p.radius_mm <= 0.0 && p.slope == 0.0 ? p.r1_mm : 0.0;
}

double ConvexOutline::sharpest_radius() const {
  double least = std::numeric_limits<double>::infinity(), before = 0.0;
  for (std::size_t i = 0; i < pieces; ++i) {
    const ProfilePiece& p = piece[i];
    if (slope_on(p, p.r0_mm) > before + kSameSlope) return 0.0;
    before = slope_on(p, p.r1_mm);
    // Across the half-plane it is as round as its normal is long, up to the axis; that grows outwards.
    if (const double sine = lean_of(slope_on(p, p.r0_mm)).sine; sine > 0.0)
      least = std::min(least, p.r0_mm / sine);
    if (p.radius_mm > 0.0) least = std::min(least, p.radius_mm);
  }
  const ProfilePiece& last = piece[pieces - 1];
  return last.radius_mm > 0.0 && ends_upright(last) ? least : 0.0;
}

std::optional<ConvexOutline> convex_outline(const CutterProfile& profile) {
  // Grown, a piece may have a corner before it, and the last one behind it.
  if (profile.pieces.empty() || 2 * profile.pieces.size() + 1 > ConvexOutline::kMost) return std::nullopt;
  ConvexOutline out;
  out.radius_mm = profile.radius_mm;
  double r = 0.0, z = 0.0, slope = 0.0;
  for (const ProfilePiece& p : profile.pieces) {
    const double begins = slope_on(p, p.r0_mm);
    if (std::abs(p.r0_mm - r) > kSameHeight || !(p.r1_mm > p.r0_mm) ||
        std::abs(height_on(p, p.r0_mm) - z) > kSameHeight || begins < slope - kSameSlope)
      return std::nullopt;
    r = p.r1_mm;
    z = height_on(p, r);
    slope = slope_on(p, r);
    if (slope < begins) return std::nullopt;
    out.piece[out.pieces++] = p;
  }
  if (std::abs(r - profile.radius_mm) > kSameHeight || !(r > 0.0)) return std::nullopt;
  return out;
}

ConvexOutline grown(const ConvexOutline& outline, double by_mm) {
  if (!(by_mm > 0.0)) return outline;
  ConvexOutline out;
  const auto corner = [&](double r, double z, double from, double to) {
    if (!(to > from + kSameSlope)) return;
    out.piece[out.pieces++] = {.r0_mm = r + by_mm * lean_of(from).sine,
                               .r1_mm = r + by_mm * lean_of(to).sine,
                               .radius_mm = by_mm,
                               .rc_mm = r,
                               .zc_mm = z + by_mm};
  };
  double before = 0.0;
  for (std::size_t i = 0; i < outline.pieces; ++i) {
    ProfilePiece p = outline.piece[i];
    const double first = slope_on(p, p.r0_mm), last = slope_on(p, p.r1_mm);
    corner(p.r0_mm, height_on(p, p.r0_mm), before, first);
    before = last;
    const Lean from = lean_of(first), to = lean_of(last);
    if (p.radius_mm > 0.0) {
      p.radius_mm += by_mm;
      p.zc_mm += by_mm;
    } else {
      p.z0_mm += by_mm * (1.0 - from.cosine);
    }
    p.r0_mm += by_mm * from.sine;
    p.r1_mm += by_mm * to.sine;
    out.piece[out.pieces++] = p;
  }
  const ProfilePiece& rim = outline.piece[outline.pieces - 1];
  corner(outline.radius_mm, height_on(rim, outline.radius_mm), before,
         std::numeric_limits<double>::infinity());
  out.radius_mm = out.piece[out.pieces - 1].r1_mm;
  return out;
}

bool is_flat(const CutterProfile& p) {
  return p.pieces.size() == 1 && p.pieces[0].radius_mm <= 0.0 && p.pieces[0].slope == 0.0;
}

CutterProfile flat_profile(double diameter_mm, double cutting_length_mm) {
  return bull_profile(diameter_mm, 0.0, cutting_length_mm);
}

CutterProfile ball_profile(double diameter_mm, double cutting_length_mm) {
  return bull_profile(diameter_mm, 0.5 * diameter_mm, cutting_length_mm);
}

CutterProfile bull_profile(double diameter_mm, double corner_radius_mm, double cutting_length_mm) {
  const double radius = 0.5 * diameter_mm;
  const double corner = std::clamp(corner_radius_mm, 0.0, radius);
  CutterProfile out{.pieces = {}, .radius_mm = radius, .cutting_length_mm = cutting_length_mm};
  if (corner < radius) out.pieces.push_back({.r0_mm = 0.0, .r1_mm = radius - corner});
  if (corner > 0.0) {
    out.pieces.push_back({.r0_mm = radius - corner,
                          .r1_mm = radius,
                          .radius_mm = corner,
                          .rc_mm = radius - corner,
                          .zc_mm = corner});
  }
  return out;
}

CutterProfile cone_profile(double diameter_mm, double point_angle_rad, double cutting_length_mm,
                           double tip_diameter_mm) {
  const double radius = 0.5 * diameter_mm;
  const double tip = std::clamp(0.5 * tip_diameter_mm, 0.0, radius);
  CutterProfile out{.pieces = {}, .radius_mm = radius, .cutting_length_mm = cutting_length_mm};
  if (tip > 0.0) out.pieces.push_back({.r0_mm = 0.0, .r1_mm = tip});
  if (tip < radius) {
    out.pieces.push_back({.r0_mm = tip, .r1_mm = radius, .slope = 1.0 / std::tan(0.5 * point_angle_rad)});
  }
  return out;
}

CutterProfile rounding_profile(double diameter_mm, double round_radius_mm, double cutting_length_mm) {
  // A chord of a tenth of a quarter turn lies 1 - cos(4.5 degrees) of the radius off its arc. With the tip
  // these are as many pieces as the stock's kernel takes (planner/physics/stock/sweep/rows.h).
  constexpr int kChords = 10;
  const double radius = 0.5 * diameter_mm, round = std::min(round_radius_mm, radius);
  const double tip = radius - round;
  CutterProfile out{.pieces = {}, .radius_mm = radius, .cutting_length_mm = cutting_length_mm};
  if (tip > 0.0) out.pieces.push_back({.r0_mm = 0.0, .r1_mm = tip});
  double r0 = tip, z0 = 0.0;
  for (int i = 1; i <= kChords; ++i) {
    const double angle = 0.5 * std::numbers::pi * i / kChords;
    const double r1 = i == kChords ? radius : tip + round * (1.0 - std::cos(angle));
    const double z1 = i == kChords ? round : round * std::sin(angle);
    out.pieces.push_back({.r0_mm = r0, .r1_mm = r1, .z0_mm = z0, .slope = (z1 - z0) / (r1 - r0)});
    r0 = r1;
    z0 = z1;
  }
  return out;
}

}  // namespace capstan::geometry

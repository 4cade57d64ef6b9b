#include "planner/ground/geometry/profile.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace capstan::geometry {

double CutterProfile::height(double r_mm) const {
  if (r_mm > radius_mm) return std::numeric_limits<double>::infinity();
  for (const ProfilePiece& p : pieces) {
    if (r_mm > p.r1_mm) continue;
    if (p.radius_mm > 0.0) {
      const double d = std::min(std::abs(r_mm - p.rc_mm), p.radius_mm);
      return p.zc_mm - std::sqrt((p.radius_mm - d) * (p.radius_mm + d));
    }
    return p.z0_mm + p.slope * (r_mm - p.r0_mm);
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

}  // namespace capstan::geometry

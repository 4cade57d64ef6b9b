#include <algorithm>
#include <cmath>

#include "planner/ground/geometry/lines/open_line.h"
#include "planner/model/features/shape.h"

namespace capstan::model {
namespace {

using geometry::Vec2;

std::optional<double> hole_floor(const FeatureShape& s, double r) {
  const double top = 0.5 * s.diameter.nominal_mm;
  const double bottom = 0.5 * s.bottom_diameter_mm;
  if (r > std::max(top, bottom)) return std::nullopt;
  // Between the two diameters a tapered wall; from above only what narrows downwards is seen.
  if (r > bottom) return -s.depth_mm * (top - r) / (top - bottom);
  switch (s.bottom) {
    case HoleBottom::kConical:
      return -s.depth_mm - (bottom - r) * std::tan(s.bottom_angle_rad);
    case HoleBottom::kSpherical: {
      const double radius = std::max(s.bottom_hole_radius_mm, r);
      return -s.depth_mm + radius - std::sqrt(radius * radius - r * r);
    }
    case HoleBottom::kFlatWithRadius: {
      const double from_wall = bottom - r;
      const double radius = s.bottom_hole_radius_mm;
      if (from_wall >= radius) return -s.depth_mm;
      return -s.depth_mm + radius - std::sqrt(radius * radius - (radius - from_wall) * (radius - from_wall));
    }
    default:
      return -s.depth_mm;
  }
}

std::optional<double> slot_floor(const FeatureShape& s, Vec2 p) {
  if (!geometry::contains(s.area, p)) return std::nullopt;
  if (s.slot_profile.empty()) return -s.depth_mm;
  // What is seen from above: the lowest height whose half width, and that of all above it, reaches p.
  const double d = geometry::distance_to_line(s.spine, p);
  const auto& q = s.slot_profile;
  for (std::size_t i = q.size(); i-- > 0;) {
    if (q[i].y + 1e-9 >= d) continue;
    if (i + 1 == q.size()) return 0.0;
    const double f = (d - q[i].y) / (q[i + 1].y - q[i].y);
    return -s.depth_mm + q[i].x + std::clamp(f, 0.0, 1.0) * (q[i + 1].x - q[i].x);
  }
  return -s.depth_mm;
}

double wall_rise(const FeatureShape& s, double from_wall) {
  // A fillet between wall and bottom, or a sloped wall seen from inside the area at the bottom.
  const double r = s.bottom_radius_mm;
  if (r > 0.0 && from_wall < r) return r - std::sqrt(r * r - (r - from_wall) * (r - from_wall));
  return 0.0;
}

}  // namespace

std::optional<double> floor_at(const FeatureShape& s, Vec2 p) {
  if (has(s.kind, ShapeTrait::kRound)) return hole_floor(s, norm(p));
  if (has(s.kind, ShapeTrait::kSwept)) return slot_floor(s, p);
  if (s.kind == ShapeKind::kChamfer) {
    // A cone or a bevel along the outline of the edge's feature, as wide as the chamfer.
    const bool inside = geometry::contains(s.area, p);
    const double d = geometry::distance_to_boundary(s.area, p);
    if (inside || d > s.chamfer_width_mm) return std::nullopt;
    return -(s.chamfer_width_mm - d) * std::tan(s.chamfer_angle_rad);
  }
  for (const Island& i : s.islands) {
    if (geometry::contains(i.area, p))
      return i.top_z_mm < 0.0 ? std::optional<double>(i.top_z_mm) : std::nullopt;
  }
  const bool inside = geometry::contains(s.area, p);
  if (!inside) {
    if (!(s.slope_rad > 0.0)) return std::nullopt;
    const double d = geometry::distance_to_boundary(s.area, p);
    const double rise = d / std::tan(s.slope_rad);
    return rise < s.depth_mm ? std::optional<double>(-s.depth_mm + rise) : std::nullopt;
  }
  if (s.bottom_radius_mm > 0.0 && !s.open) {
    return -s.depth_mm + wall_rise(s, geometry::distance_to_boundary(s.area, p));
  }
  return -s.depth_mm;
}

}  // namespace capstan::model

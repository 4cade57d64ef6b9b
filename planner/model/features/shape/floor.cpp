#include <algorithm>
#include <cmath>

#include "planner/ground/geometry/lines/open_line.h"
#include "planner/model/features/fillet_slack.h"
#include "planner/model/features/shape.h"

namespace capstan::model {
namespace {

using geometry::Vec2;

/// The height above the bottom of a fillet of radius r so far from the wall that it touches.
double rise(double r, double from_wall) {
  return from_wall < r ? r - std::sqrt(r * r - (r - from_wall) * (r - from_wall)) : 0.0;
}

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
    case HoleBottom::kFlatWithRadius:
      return -s.depth_mm + rise(s.bottom_hole_radius_mm, bottom - r);
    default:
      return -s.depth_mm;
  }
}

std::optional<double> slot_floor(const FeatureShape& s, Vec2 p) {
  if (!geometry::contains(s.area, p)) return std::nullopt;
  if (s.slot_profile.empty() && !(s.bottom_radius_mm > 0.0)) return -s.depth_mm;
  const double d = geometry::distance_to_line(s.spine, p);
  if (s.slot_profile.empty())
    return -s.depth_mm + rise(s.bottom_radius_mm, std::max(0.0, 0.5 * s.width.nominal_mm - d));
  // What is seen from above: the lowest height whose half width, and that of all above it, reaches p.
  const auto& q = s.slot_profile;
  for (std::size_t i = q.size(); i-- > 0;) {
    if (q[i].y + 1e-9 >= d) continue;
    if (i + 1 == q.size()) return 0.0;
    const double f = (d - q[i].y) / (q[i + 1].y - q[i].y);
    return -s.depth_mm + q[i].x + std::clamp(f, 0.0, 1.0) * (q[i + 1].x - q[i].x);
  }
  return -s.depth_mm;
}

/// How far the floor rises in the fillets beside the walls and islands about p. Past a sharp corner of what
/// stands the fillets of both walls run straight on and meet in a mitre, as CAD systems draw them.
double fillet_rise(const FeatureShape& s, Vec2 p) {
  double out = 0.0;
  if (s.bottom_radius_mm > 0.0) {
    // An open area's reach ends at its walls; its holes are the islands.
    for (const geometry::Loop& loop : (s.open ? s.reach : s.area).loops) {
      if (geometry::signed_area(loop) > 0.0)
        out = std::max(out, rise(s.bottom_radius_mm, geometry::mitred_distance(loop, p)));
    }
  }
  for (const Island& i : s.islands) {
    if (!(i.foot_radius_mm > 0.0)) continue;
    const double height = std::max(0.0, i.top_z_mm + s.depth_mm);
    const double foot = rise(i.foot_radius_mm, geometry::mitred_distance(i.area, p));
    out = std::max(out, std::min(height, foot));
  }
  return out;
}

/// A bevel or a round along the outline of the edge's feature, in the material beside it.
std::optional<double> edge_floor(const FeatureShape& s, Vec2 p) {
  const bool around = s.open && !s.islands.empty();
  const geometry::Region& edge = around ? s.islands.front().area : s.area;
  if (geometry::contains(edge, p) != around) return std::nullopt;
  const double d = geometry::distance_to_boundary(edge, p);
  if (s.kind == ShapeKind::kChamfer) {
    if (d > s.chamfer_width_mm) return std::nullopt;
    return -(s.chamfer_width_mm - d) * std::tan(s.chamfer_angle_rad);
  }
  const double r = s.round_radius_mm;
  if (d >= r) return std::nullopt;
  return -r + std::sqrt(r * r - (r - d) * (r - d));
}

}  // namespace

std::optional<double> floor_fillet_mm(const FeatureShape& s) {
  double least = 1e300, most = 0.0;
  const auto foot = [&](double r) {
    least = std::min(least, r);
    most = std::max(most, r);
  };
  if (s.kind != ShapeKind::kFace && s.kind != ShapeKind::kOutside) foot(s.bottom_radius_mm);
  for (const Island& i : s.islands) foot(i.foot_radius_mm);
  if (most > 0.0 && most - least > kFilletSlackMm) return std::nullopt;
  return most;
}

double largest_fillet_mm(const FeatureShape& s) {
  double out = s.bottom_radius_mm;
  for (const Island& i : s.islands) out = std::max(out, i.foot_radius_mm);
  return out;
}

std::optional<double> floor_at(const FeatureShape& s, Vec2 p) {
  if (s.kind == ShapeKind::kChamfer || s.kind == ShapeKind::kEdgeRound) return edge_floor(s, p);
  if (has(s.kind, ShapeTrait::kRound)) return hole_floor(s, norm(p));
  if (has(s.kind, ShapeTrait::kSwept)) return slot_floor(s, p);
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
  return -s.depth_mm + fillet_rise(s, p);
}

}  // namespace capstan::model

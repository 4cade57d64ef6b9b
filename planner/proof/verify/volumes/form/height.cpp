#include <algorithm>
#include <cmath>

#include "planner/proof/verify/volumes/form/form.h"

// The height of a form's finished surface above a place, from its exact outlines: the distance to the nearest
// wall says how far up a radius at its foot, a leaning wall or a broken edge is there. Where several heights
// lie above each other (a narrow mouth over a wide bar) it is the highest: what is seen from above.

namespace capstan::verify::volumes {

using geometry::Vec2;
using geometry::Vec3;

namespace {

constexpr double kHair = 1e-9;
constexpr double kLidMm = 0.02;  ///< what is thinner is rounding of a file; default, unsourced

/// How high a quarter round is so far from the wall that it touches.
double rise(double radius, double from_wall) {
  if (!(from_wall < radius)) return 0.0;
  const double in = radius - std::max(from_wall, 0.0);
  return radius - std::sqrt(std::max(0.0, radius * radius - in * in));
}

std::optional<double> floor_of(const Bore& b, const Form& f, double r) {
  const double depth = f.depth_mm();
  if (r > std::max(b.top_radius_mm, b.bottom_radius_mm)) return std::nullopt;
  if (r > b.bottom_radius_mm) return -depth * (b.top_radius_mm - r) / (b.top_radius_mm - b.bottom_radius_mm);
  switch (b.bottom) {
    case Bore::Bottom::kCone:
      return b.bottom_radius_mm > 0.0 ? -depth - f.tip_mm * (1.0 - r / b.bottom_radius_mm) : -depth;
    case Bore::Bottom::kBall: {
      const double ball = std::max(b.radius_mm, r);
      return -depth + ball - std::sqrt(ball * ball - r * r);
    }
    case Bore::Bottom::kRounded:
      return -depth + rise(b.radius_mm, b.bottom_radius_mm - r);
    default:
      return -depth;
  }
}

std::optional<double> floor_of(const Area& a, const Form& f, Vec2 q) {
  const double depth = f.depth_mm();
  for (const Standing& s : a.standing) {
    // Where its walls lean it stands to its foot: what of the flank stays nobody cuts, so nothing is asked
    // there.
    if (!inside(s.outline, q) && !(nearest(s.outline, q).distance_mm < s.leaning_mm)) continue;
    return s.top_mm < 0.0 ? std::optional<double>(s.top_mm) : std::nullopt;
  }
  const bool taken = inside(a.outline, q) != a.around;
  if (!taken) {
    if (!(f.slope_rad > 0.0)) return std::nullopt;
    const double up = nearest(a.outline, q).distance_mm / std::tan(f.slope_rad);
    return up < depth ? std::optional<double>(-depth + up) : std::nullopt;
  }
  double up = 0.0;
  if (a.foot_radius_mm > 0.0) up = rise(a.foot_radius_mm, mitred(a.outline, q, true));
  for (const Standing& s : a.standing) {
    if (!(s.foot_radius_mm > 0.0)) continue;
    const double foot = rise(s.foot_radius_mm, mitred(s.outline, q));
    up = std::max(up, std::clamp(foot, 0.0, std::max(0.0, s.top_mm + depth)));
  }
  return -depth + up;
}

std::optional<double> floor_of_groove(const Form& f, Vec2 q) {
  if (!geometry::contains(f.area, q)) return std::nullopt;
  const auto& half = f.half_section;
  const auto* g = std::get_if<Groove>(&f.solid.form);
  const double foot = g != nullptr ? g->foot_radius_mm : 0.0;
  if (half.empty() && !(foot > 0.0)) return -f.depth_mm();
  double aside = 1e300;
  for (std::size_t i = 1; i < f.course.size(); ++i) {
    const Vec2 a = f.course[i - 1], d = f.course[i] - a;
    const double share = std::clamp(dot(q - a, d) / std::max(dot(d, d), 1e-300), 0.0, 1.0);
    aside = std::min(aside, norm(q - (a + share * d)));
  }
  if (half.empty()) return -f.depth_mm() + rise(foot, g->half_mm - aside);
  // Down from the mouth as long as the section is wide enough.
  double height = half.back().x;
  if (half.back().y < aside) return 0.0;
  for (std::size_t i = half.size() - 1; i-- > 0;) {
    const Vec2 low = half[i], high = half[i + 1];
    if (low.y >= aside - kHair) {
      height = low.x;
      continue;
    }
    const double share = (aside - low.y) / (high.y - low.y);
    return -f.depth_mm() + low.x + std::clamp(share, 0.0, 1.0) * (high.x - low.x);
  }
  return -f.depth_mm() + height;
}

std::optional<double> floor_of(const Bevel& b, Vec2 q) {
  if (inside(b.outline, q) != b.within) return std::nullopt;
  const double d = nearest(b.outline, q).distance_mm;
  if (d > b.width_mm) return std::nullopt;
  if (b.round)
    return -b.width_mm +
           std::sqrt(std::max(0.0, b.width_mm * b.width_mm - (b.width_mm - d) * (b.width_mm - d)));
  return -b.depth_mm * (1.0 - d / b.width_mm);
}

}  // namespace

std::optional<double> floor_at(const Form& f, Vec2 q) {
  if (f.area.empty()) return std::nullopt;
  if (const auto* b = f.bore()) return floor_of(*b, f, norm(q));
  if (const auto* b = f.bevel()) return floor_of(*b, q);
  if (const auto* a = std::get_if<Area>(&f.solid.form)) return floor_of(*a, f, q);
  return floor_of_groove(f, q);
}

bool level_about(const Form& f, Vec2 q, double distance_mm) {
  const auto* a = std::get_if<Area>(&f.solid.form);
  if (a == nullptr || f.area.empty() || f.slope_rad > 0.0) return false;
  const double apart = distance_mm + kHair;
  if (mitred(a->outline, q) <= apart + a->foot_radius_mm) return false;
  return std::all_of(a->standing.begin(), a->standing.end(), [&](const Standing& s) {
    return mitred(s.outline, q) > apart + std::max(s.leaning_mm, s.foot_radius_mm);
  });
}

bool takes(const Form& f, Vec3 p) {
  if (f.area.empty()) return false;
  const Vec3 q = f.frame().to_local(p);
  if (q.z > kLidMm && f.kind != model::ShapeKind::kFace) return false;
  const auto floor = floor_at(f, xy(q));
  return floor && (q.z >= *floor - kLidMm || (f.solid.through && *floor <= -f.depth_mm() + kLidMm));
}

}  // namespace capstan::verify::volumes

#include "planner/files/from_cad/nouns.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "planner/model/nouns/placed_nouns.h"

namespace capstan::from_cad {
namespace {

constexpr double kSameMm = 1e-4;  ///< lengths that differ by less are drawn alike
constexpr double kSquare = 1e-6;  ///< cosine between sides at right angles
constexpr double kDegrees = 180.0 / std::numbers::pi;

Vec2 unit(Vec2 v) { return (1.0 / norm(v)) * v; }

struct Rectangle {
  Vec2 centre, along;
  double length_mm = 0.0, width_mm = 0.0, corner_mm = 0.0;
};

/// Four sides at right angles, with sharp corners or with four arcs of one radius.
std::optional<Rectangle> rectangle_of(const std::vector<Piece>& pieces) {
  std::vector<Piece> sides;
  double corner = 0.0;
  std::size_t arcs = 0;
  for (const Piece& p : pieces) {
    if (!p.arc()) {
      sides.push_back(p);
      continue;
    }
    const bool quarter = std::abs(p.sweep_rad - std::numbers::pi / 2.0) < 1e-3;
    if (!quarter || (arcs > 0 && std::abs(p.radius_mm - corner) > kSameMm)) return std::nullopt;
    corner = p.radius_mm;
    ++arcs;
  }
  if (sides.size() != 4 || (arcs != 0 && arcs != 4) || pieces.size() != sides.size() + arcs)
    return std::nullopt;
  const Vec2 x = unit(sides[0].to - sides[0].from);
  const Vec2 y{-x.y, x.x};
  for (std::size_t i = 0; i < 4; ++i) {
    const Vec2 d = unit(sides[i].to - sides[i].from);
    if (std::abs(i % 2 == 0 ? dot(d, y) : dot(d, x)) > kSquare) return std::nullopt;
  }
  double lo_x = 1e300, hi_x = -1e300, lo_y = 1e300, hi_y = -1e300;
  for (const Piece& s : sides) {
    for (const Vec2 p : {s.from, s.to}) {
      lo_x = std::min(lo_x, dot(p, x));
      hi_x = std::max(hi_x, dot(p, x));
      lo_y = std::min(lo_y, dot(p, y));
      hi_y = std::max(hi_y, dot(p, y));
    }
  }
  Rectangle out{0.5 * (lo_x + hi_x) * x + 0.5 * (lo_y + hi_y) * y, x, hi_x - lo_x, hi_y - lo_y, corner};
  return out;
}

}  // namespace

Ref<model::CartesianPoint> Nouns::point(Vec3 p) { return model::add_point(m_, p); }

Ref<model::Direction> Nouns::direction(Vec3 d) { return model::add_direction(m_, d); }

Ref<model::Axis2Placement3d> Nouns::placement(const geometry::Placement& at) {
  return model::add_placement(m_, at);
}

Ref<model::TolerancedLengthMeasure> Nouns::length(double mm) {
  model::TolerancedLengthMeasure q;
  q.theoretical_size = mm;
  return m_.add(q);
}

Ref<model::Plane> Nouns::depth(double mm) {
  model::Plane q;
  q.name = "";
  q.position = placement({.origin = {0.0, 0.0, -mm}});
  return m_.add(q);
}

Ref<model::BoundedCurve> Nouns::curve(const std::vector<Piece>& pieces, bool closed) {
  const bool straight = std::none_of(pieces.begin(), pieces.end(), [](const Piece& p) { return p.arc(); });
  const auto flat = [&](Vec2 p) { return point({p.x, p.y, 0.0}); };
  if (straight) {
    model::Polyline line;
    line.name = "";
    for (const Piece& p : pieces) line.points.push_back(flat(p.from));
    line.points.push_back(closed ? line.points[0] : flat(pieces.back().to));
    return m_.add(line);
  }
  model::CompositeCurve out;
  out.name = "";
  out.self_intersect = model::Logical3::kFalse;
  for (const Piece& p : pieces) {
    model::CompositeCurveSegment segment;
    segment.transition = model::TransitionCode::kContinuous;
    segment.same_sense = true;
    if (p.arc()) {
      model::Circle circle;
      circle.name = "";
      circle.position = placement({.origin = {p.centre.x, p.centre.y, 0.0}});
      circle.radius = p.radius_mm;
      const double from = std::atan2(p.from.y - p.centre.y, p.from.x - p.centre.x);
      const auto at = [](double rad) {
        double degrees = std::fmod(rad * kDegrees, 360.0);
        if (degrees < 0.0) degrees += 360.0;
        model::SelectValue v;
        v.type = "PARAMETER_VALUE";
        v.real = degrees;
        return model::SelectList{{v}, true};
      };
      model::TrimmedCurve arc;
      arc.name = "";
      arc.basis_curve = m_.add(circle);
      arc.trim_1 = at(from);
      arc.trim_2 = at(from + p.sweep_rad);
      arc.sense_agreement = p.sweep_rad > 0.0;
      arc.master_representation = model::TrimmingPreference::kParameter;
      segment.parent_curve = m_.add(arc);
    } else {
      model::Polyline line;
      line.name = "";
      line.points.push_back(flat(p.from));
      line.points.push_back(flat(p.to));
      segment.parent_curve = m_.add(line);
    }
    out.segments.push_back(m_.add(segment));
  }
  return m_.add(out);
}

Ref<model::ClosedProfile> Nouns::closed_profile(const std::vector<Piece>& pieces, double& corner_mm) {
  if (pieces.size() == 1 && pieces.front().arc()) {
    model::CircularClosedProfile circle;
    circle.placement = placement({.origin = {pieces.front().centre.x, pieces.front().centre.y, 0.0}});
    circle.diameter = length(2.0 * pieces.front().radius_mm);
    return m_.add(circle);
  }
  if (const auto r = rectangle_of(pieces)) {
    model::RectangularClosedProfile box;
    geometry::Placement at;
    at.origin = {r->centre.x, r->centre.y, 0.0};
    at.x = {r->along.x, r->along.y, 0.0};
    at.y = {-r->along.y, r->along.x, 0.0};
    box.placement = placement(at);
    box.profile_length = length(r->length_mm);
    box.profile_width = length(r->width_mm);
    corner_mm = r->corner_mm;
    return m_.add(box);
  }
  model::GeneralClosedProfile out;
  out.closed_profile_shape = curve(pieces, true);
  return m_.add(out);
}

Ref<model::OpenProfile> Nouns::open_profile(const std::vector<Piece>& pieces) {
  model::GeneralProfile out;
  out.its_profile = curve(pieces, false);
  return m_.add(out);
}

}  // namespace capstan::from_cad

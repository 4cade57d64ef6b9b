#include <cmath>
#include <numbers>

#include "planner/model/nouns/geometric_item.h"
#include "planner/model/nouns/support.h"
#include "planner/model/resolve.h"
#include "planner/model/shape/build.h"

// Holes, threads, edges, compounds and patterns.

namespace capstan::model::shape {

using geometry::Vec3;

namespace {

/// A shape turned and moved as a whole, in workpiece coordinates.
FeatureShape relocated(FeatureShape s, const geometry::Placement& frame) {
  s.frame = frame;
  return s;
}

geometry::Placement turned(const geometry::Placement& about, const geometry::Placement& p, double angle_rad) {
  const double c = std::cos(angle_rad);
  const double n = std::sin(angle_rad);
  const geometry::Placement turn{.origin = {}, .x = {c, n, 0.0}, .y = {-n, c, 0.0}, .z = {0.0, 0.0, 1.0}};
  return compose(about, compose(turn, compose(inverse(about), p)));
}

geometry::Placement shifted(geometry::Placement p, Vec3 by) {
  p.origin = p.origin + by;
  return p;
}

template <class T>
bool omitted(const Model& m, const RefList<T>& list, std::int64_t a) {
  for (std::size_t i = 0; i < list.size(); ++i) {
    const auto* o = m.get<T>(list[i]);
    if (o != nullptr && o->index == a) return true;
  }
  return false;
}

constexpr std::int64_t kMaxCopies = 100'000;

}  // namespace

Result<Shapes> hole(const Model& m, AnyRef self, const RoundHole& f) {
  auto s = base(m, self, true);
  if (!s) return tl::unexpected(s.error());
  s->kind = ShapeKind::kHole;
  const auto d = length(m, f.diameter);
  if (!d) return missing(m, self, "diameter", d.error());
  if (!(d->nominal_mm > 0.0)) return unsupported(m, self, "has no diameter above 0");
  s->diameter = *d;
  s->bottom_diameter_mm = d->nominal_mm;
  if (const auto* t = m.get<DiameterTaper>(f.change_in_diameter)) {
    const auto end = length(m, t->final_diameter);
    if (!end) return missing(m, self, "final_diameter", end.error());
    s->bottom_diameter_mm = end->nominal_mm;
  } else if (const auto* a = m.get<AngleTaper>(f.change_in_diameter)) {
    s->bottom_diameter_mm = d->nominal_mm - 2.0 * s->depth_mm * std::tan(a->angle.value_or(0.0));
  }
  if (m.holds<ThroughBottomCondition>(f.bottom_condition)) {
    s->bottom = HoleBottom::kThrough;
    s->through = true;
  } else if (const auto* c = m.get<ConicalHoleBottom>(f.bottom_condition)) {
    s->bottom = HoleBottom::kConical;
    // tip_angle is the full angle of the tip; files that give the flank's angle against the plane (20 degrees
    // for a 140 degree point) are told by its being below 45 degrees.
    const double tip = c->tip_angle.value_or(0.0);
    if (!(tip > 0.0 && tip < std::numbers::pi))
      return unsupported(m, self, "its conical bottom has no tip_angle between 0 and 180 degrees");
    const bool flank = tip < std::numbers::pi / 4.0;
    s->bottom_angle_rad = flank ? tip : 0.5 * (std::numbers::pi - tip);
    if (flank)
      s->assumptions.push_back(
          "tip_angle below 45 degrees is read as the flank's angle against the bottom plane");
  } else if (const auto* r = m.get<SphericalHoleBottom>(f.bottom_condition)) {
    s->bottom = HoleBottom::kSpherical;
    const auto radius = length(m, r->radius);
    if (!radius) return missing(m, self, "bottom_condition.radius", radius.error());
    s->bottom_hole_radius_mm = radius->nominal_mm;
  } else if (const auto* w = m.get<FlatWithRadiusHoleBottom>(f.bottom_condition)) {
    s->bottom = HoleBottom::kFlatWithRadius;
    const auto radius = length(m, w->corner_radius);
    if (!radius) return missing(m, self, "bottom_condition.corner_radius", radius.error());
    s->bottom_hole_radius_mm = radius->nominal_mm;
  } else if (m.holds<FlatHoleBottom>(f.bottom_condition)) {
    s->bottom = HoleBottom::kFlat;
  } else {
    return missing(m, self, "bottom_condition");
  }
  s->area = s->reach = geometry::disc({0.0, 0.0}, 0.5 * d->nominal_mm, kAreaTolerance);
  return Shapes{*s};
}

Result<Shapes> thread(const Model& m, AnyRef self, const Thread& f, int depth) {
  if (f.applied_shape.empty()) return missing(m, self, "applied_shape");
  auto on = any(m, f.applied_shape[0], depth + 1);
  if (!on) return on;
  FeatureShape s = on->front();
  s.feature = self;
  s.name = f.its_id.value_or(s.name);
  if (s.kind != ShapeKind::kHole) return unsupported(m, self, "only threads in holes are planned");
  s.kind = ShapeKind::kThread;
  s.thread_major_mm = f.major_diameter.value_or(0.0);
  if (!(s.thread_major_mm > 0.0)) return missing(m, self, "major_diameter");
  const auto* n = m.get<NumericParameter>(f.number_of_threads);
  if (n == nullptr || !n->its_parameter_value || !(*n->its_parameter_value > 0.0))
    return missing(m, self, "number_of_threads");
  // number_of_threads counts them per unit of length, which the parameter names.
  const std::string unit = n->its_parameter_unit.value_or("");
  const bool per_inch = unit.find("in") != std::string::npos || unit.find("IN") != std::string::npos;
  s.thread_pitch_mm = (per_inch ? 25.4 : 1.0) / *n->its_parameter_value;
  s.thread_depth_mm = s.depth_mm;
  if (const auto* part = m.get<PartialAreaDefinition>(f.partial_profile)) {
    s.thread_depth_mm = part->effective_length.value_or(s.depth_mm);
  }
  if (const auto* hand = m.get<DescriptiveParameter>(f.thread_hand)) {
    const std::string text = hand->descriptive_string.value_or("");
    s.thread_left_hand = text.find("left") != std::string::npos || text.find("LEFT") != std::string::npos;
  }
  return Shapes{s};
}

Result<Shapes> transition(const Model& m, AnyRef self, const TransitionFeature& f, int depth) {
  auto first = any(m, f.first_feature, depth + 1);
  if (!first) return first;
  FeatureShape s = first->front();
  // The edge is where the first feature meets the face it opens into: its outline at the top.
  s.feature = self;
  s.name = f.its_id.value_or("");
  s.through = false;
  if (const auto* c = m.get<Chamfer>(self)) {
    s.kind = ShapeKind::kChamfer;
    const auto width = length(m, c->first_offset_amount);
    if (!width) return missing(m, self, "first_offset_amount", width.error());
    s.chamfer_width_mm = width->nominal_mm;
    s.chamfer_angle_rad = c->angle_to_plane.value_or(std::numbers::pi / 4.0);
    if (!(s.chamfer_angle_rad > 0.0 && s.chamfer_angle_rad < std::numbers::pi / 2.0)) {
      return unsupported(m, self, "its angle_to_plane is not between 0 and 90 degrees");
    }
    s.depth_mm = s.chamfer_width_mm * std::tan(s.chamfer_angle_rad);
    return Shapes{s};
  }
  if (const auto* e = m.get<EdgeRound>(self)) {
    s.kind = ShapeKind::kEdgeRound;
    const auto r = length(m, e->radius);
    if (!r) return missing(m, self, "radius", r.error());
    s.round_radius_mm = s.depth_mm = r->nominal_mm;
    return Shapes{s};
  }
  return unsupported(m, self, "is a transition that is not understood");
}

Result<Shapes> compound(const Model& m, AnyRef self, const CompoundFeature& f, int depth) {
  if (f.elements.empty()) return missing(m, self, "elements");
  Shapes out;
  for (const AnyRef element : f.elements.items) {
    auto part = any(m, element, depth + 1);
    if (!part) return part;
    for (FeatureShape& s : *part) {
      s.feature = self;
      s.name = f.its_id.value_or(s.name);
      out.push_back(std::move(s));
    }
  }
  return out;
}

Result<Shapes> replicate(const Model& m, AnyRef self, const ReplicateFeature& f, int depth) {
  const auto basis = any(m, f.replicate_base_feature, depth + 1);
  if (!basis) return basis;
  const auto about = placement_or_identity(m, f.feature_placement);
  if (!about) return tl::unexpected(about.error());
  Shapes out;
  const auto copy = [&](auto&& frame_of) {
    for (const FeatureShape& s : *basis) {
      out.push_back(relocated(s, frame_of(s.frame)));
      out.back().feature = self;
      out.back().name = f.its_id.value_or(s.name);
    }
  };
  if (const auto* c = m.get<CircularPattern>(self)) {
    const std::int64_t n = c->number_of_feature.value_or(0);
    if (n < 1 || n > kMaxCopies)
      return unsupported(m, self, "number_of_feature is not between 1 and 100,000");
    for (std::int64_t i = 0; i < n; ++i) {
      if (omitted(m, c->missing_base_feature, i + 1)) continue;
      double angle = static_cast<double>(i) * c->angle_increment.value_or(0.0);
      for (std::size_t k = 0; k < c->relocated_base_feature.size(); ++k) {
        const auto* o = m.get<CircularOffset>(c->relocated_base_feature[k]);
        if (o != nullptr && o->index == i + 1) angle += o->angular_offset.value_or(0.0);
      }
      copy([&](const geometry::Placement& p) { return turned(*about, p, angle); });
    }
    return out;
  }
  if (const auto* r = m.get<RectangularPattern>(self)) {
    const auto spacing = length(m, r->spacing);
    const auto along = direction(m, r->its_direction);
    if (!spacing) return missing(m, self, "spacing", spacing.error());
    if (!along) return missing(m, self, "its_direction");
    const std::int64_t rows = r->number_of_rows.value_or(1);
    const std::int64_t columns = r->number_of_columns.value_or(0);
    if (rows < 1 || columns < 1 || rows > kMaxCopies || columns > kMaxCopies / rows) {
      return unsupported(m, self, "its rows and columns are not between 1 and 100,000 copies");
    }
    Vec3 row_step;
    if (rows > 1) {
      const auto row_spacing = length(m, r->row_spacing);
      const auto row_direction = direction(m, r->row_layout_direction);
      if (!row_spacing) return missing(m, self, "row_spacing", row_spacing.error());
      if (!row_direction) return missing(m, self, "row_layout_direction");
      row_step = row_spacing->nominal_mm * about->direction_to_parent(*row_direction);
    }
    const Vec3 column_step = spacing->nominal_mm * about->direction_to_parent(*along);
    for (std::int64_t i = 0; i < rows; ++i) {
      for (std::int64_t j = 0; j < columns; ++j) {
        bool left_out = false;
        for (std::size_t k = 0; k < r->missing_base_feature.size(); ++k) {
          const auto* o = m.get<RectangularOmit>(r->missing_base_feature[k]);
          left_out = left_out || (o != nullptr && o->row_index == i + 1 && o->column_index == j + 1);
        }
        if (left_out) continue;
        Vec3 by = static_cast<double>(i) * row_step + static_cast<double>(j) * column_step;
        for (std::size_t k = 0; k < r->relocated_base_feature.size(); ++k) {
          const auto* o = m.get<RectangularOffset>(r->relocated_base_feature[k]);
          if (o == nullptr || o->row_index != i + 1 || o->column_index != j + 1) continue;
          if (const auto d = direction(m, o->offset_direction)) {
            by = by + o->offset_distance.value_or(0.0) * about->direction_to_parent(*d);
          }
        }
        copy([&](const geometry::Placement& p) { return shifted(p, by); });
      }
    }
    return out;
  }
  if (const auto* g = m.get<GeneralPattern>(self)) {
    // The base feature where it is, and one more at each location, which is its frame as the pattern sees it.
    copy([](const geometry::Placement& p) { return p; });
    for (std::size_t i = 0; i < g->replicate_locations.size(); ++i) {
      const auto at = placement(m, g->replicate_locations[i]);
      if (!at) return tl::unexpected(at.error());
      copy([&](const geometry::Placement&) { return compose(*about, *at); });
    }
    return out;
  }
  return unsupported(m, self, "is a pattern that is not understood");
}

}  // namespace capstan::model::shape

#include <cmath>
#include <numbers>

#include "planner/ground/base/number.h"
#include "planner/ground/vocabulary/unit_factors.h"
#include "planner/model/features/resolve.h"
#include "planner/model/features/shape/build.h"
#include "planner/model/features/tip_angle.h"
#include "planner/model/nouns/geometric_item.h"
#include "planner/model/nouns/support.h"

// Holes, threads and edges.

namespace capstan::model::shape {

namespace {

/// Of a compound its first element; of a pattern the same element of each copy.
Result<Shapes> one_of_each(Result<Shapes> shapes) {
  if (!shapes) return shapes;
  const auto element = [](const FeatureShape& s) { return s.made_of.empty() ? AnyRef{} : s.made_of.back(); };
  const AnyRef first = element(shapes->front());
  std::erase_if(*shapes, [&](const FeatureShape& s) { return element(s) != first; });
  return shapes;
}

/// What is on a feature, on each of its copies.
Shapes wherever(const FeatureShape& s, const Shapes& on) {
  Shapes out(on.size(), s);
  for (std::size_t i = 0; i < on.size(); ++i) out[i].frame = on[i].frame;
  return out;
}

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
    const double tip = c->tip_angle.value_or(0.0);
    if (!(tip > 0.0 && tip < std::numbers::pi))
      return unsupported(m, self, "its conical bottom has no tip_angle between 0 and 180 degrees");
    constexpr double kHair = 1e-6;
    const double degrees = tip * 180.0 / std::numbers::pi;
    const bool flank = degrees <= kFlankTipDegrees + kHair;
    const bool half = !flank && degrees <= kHalfTipDegrees + kHair;
    if (const auto round = length(m, c->tip_radius)) s->bottom_hole_radius_mm = round->nominal_mm;
    s->bottom_angle_rad = flank ? tip : half ? 0.5 * std::numbers::pi - tip : 0.5 * (std::numbers::pi - tip);
    if (flank || half) {
      const std::string point = trimmed(180.0 - 2.0 * s->bottom_angle_rad * 180.0 / std::numbers::pi, 2);
      s->assumptions.push_back(
          "its tip_angle of " + trimmed(degrees, 2) + " degrees is read as " +
          (flank ? "the flank's angle against the bottom plane" : "half of the point's") + ": a point of " +
          point + " degrees");
    }
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

}  // namespace

std::vector<ShapeNoun> holes_nouns() {
  return {
      shape_noun<RoundHole, hole>(),
  };
}

Result<Shapes> thread(const Model& m, AnyRef self, const Thread& f, const Within& in) {
  if (f.applied_shape.empty()) return missing(m, self, "applied_shape");
  const auto on = one_of_each(referred(m, f.applied_shape[0], in));
  if (!on) return on;
  FeatureShape s = on->front();
  s.feature = self;
  s.made_of.clear();
  s.name = f.its_id.value_or(s.name);
  if (s.kind != ShapeKind::kHole) return unsupported(m, self, "only threads in holes are planned");
  if (f.inner_or_outer_thread == false)
    return unsupported(
        m, self,
        "it lies in a hole and says that it is an outer thread; state inner_or_outer_thread as "
        "true, or the shaft that it is on");
  s.kind = ShapeKind::kThread;
  s.thread_major_mm = f.major_diameter.value_or(0.0);
  if (!(s.thread_major_mm > 0.0)) return missing(m, self, "major_diameter");
  const auto* n = m.get<NumericParameter>(f.number_of_threads);
  if (n == nullptr || !n->its_parameter_value || !(*n->its_parameter_value > 0.0))
    return missing(m, self, "number_of_threads");
  // number_of_threads counts them per unit of length, which the parameter names.
  const std::string unit = n->its_parameter_unit.value_or("");
  const bool per_inch = unit.find("in") != std::string::npos || unit.find("IN") != std::string::npos;
  s.thread_pitch_mm = (per_inch ? kMmPerInch : 1.0) / *n->its_parameter_value;
  s.thread_depth_mm = s.depth_mm;
  if (const auto* part = m.get<PartialAreaDefinition>(f.partial_profile)) {
    s.thread_depth_mm = part->effective_length.value_or(s.depth_mm);
  }
  if (const auto* hand = m.get<DescriptiveParameter>(f.thread_hand)) {
    const std::string text = hand->descriptive_string.value_or("");
    s.thread_left_hand = text.find("left") != std::string::npos || text.find("LEFT") != std::string::npos;
  }
  return wherever(s, *on);
}

namespace {

/// The refusal of an edge that leaves nothing to cut.
tl::unexpected<Diagnostic> no_size(const Model& m, AnyRef self, const std::string& attribute, double mm) {
  return unsupported(m, self,
                     "its " + attribute + " is " + trimmed(mm, 4) +
                         " mm, so that nothing is cut; state a length above 0, or leave the feature out");
}

}  // namespace

Result<Shapes> transition(const Model& m, AnyRef self, const TransitionFeature& f, const Within& in) {
  const auto first = one_of_each(referred(m, f.first_feature, in));
  if (!first) return first;
  FeatureShape s = first->front();
  s.made_of.clear();
  // The edge is where the first feature meets the face it opens into: its outline at the top.
  s.feature = self;
  s.name = f.its_id.value_or("");
  s.through = false;
  if (const auto* c = m.get<Chamfer>(self)) {
    s.kind = ShapeKind::kChamfer;
    const auto width = length(m, c->first_offset_amount);
    if (!width) return missing(m, self, "first_offset_amount", width.error());
    s.chamfer_width_mm = width->nominal_mm;
    if (!(s.chamfer_width_mm > 0.0)) return no_size(m, self, "first_offset_amount", s.chamfer_width_mm);
    s.chamfer_angle_rad = c->angle_to_plane.value_or(std::numbers::pi / 4.0);
    if (!(s.chamfer_angle_rad > 0.0 && s.chamfer_angle_rad < std::numbers::pi / 2.0)) {
      return unsupported(m, self, "its angle_to_plane is not between 0 and 90 degrees");
    }
    s.depth_mm = s.chamfer_width_mm * std::tan(s.chamfer_angle_rad);
    return wherever(s, *first);
  }
  if (const auto* e = m.get<EdgeRound>(self)) {
    s.kind = ShapeKind::kEdgeRound;
    const auto r = length(m, e->radius);
    if (!r) return missing(m, self, "radius", r.error());
    s.round_radius_mm = s.depth_mm = r->nominal_mm;
    if (!(s.round_radius_mm > 0.0)) return no_size(m, self, "radius", s.round_radius_mm);
    return wherever(s, *first);
  }
  return unsupported(m, self, "is a transition that is not understood");
}

}  // namespace capstan::model::shape

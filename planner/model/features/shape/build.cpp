#include "planner/model/features/shape/build.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>

#include "planner/ground/base/number.h"
#include "planner/model/features/curve_points.h"
#include "planner/model/features/resolve.h"
#include "planner/model/nouns/arena/kept.h"
#include "planner/model/nouns/arena/standing.h"
#include "planner/model/nouns/geometric_item.h"
#include "planner/model/nouns/support.h"

namespace capstan::model {
namespace shape {

using geometry::Loop;
using geometry::Vec2;
using geometry::Vec3;

std::string label(const Model& m, AnyRef feature) {
  const auto* f = m.get<ManufacturingFeature>(feature);
  const auto* kept = m.get<KeptInstance>(feature);
  std::string name(kept != nullptr ? kept->keyword : noun_type(feature.type).keyword);
  if (f != nullptr && f->its_id && !f->its_id->empty()) name += " '" + *f->its_id + "'";
  return name;
}

namespace {

std::vector<Vec2> in_plane(const geometry::Placement& frame, const std::vector<Vec3>& points) {
  std::vector<Vec2> out;
  for (const Vec3& p : points) {
    const Vec2 q = xy(frame.to_parent(p));
    if (out.empty() || norm(q - out.back()) > geometry::kRegionGrid) out.push_back(q);
  }
  return out;
}

Loop moved(const geometry::Placement& frame, const Loop& loop) {
  Loop out;
  for (const Vec2 p : loop) out.push_back(xy(frame.to_parent({p.x, p.y, 0.0})));
  return out;
}

}  // namespace

geometry::Region moved(const geometry::Placement& frame, const geometry::Region& r) {
  std::vector<Loop> loops;
  for (const Loop& loop : r.loops) loops.push_back(moved(frame, loop));
  // A profile seen from below turns its loops round.
  if (frame.z.z < 0.0) {
    for (Loop& loop : loops) std::reverse(loop.begin(), loop.end());
  }
  return geometry::clean(loops);
}

std::optional<Vec2> crosses_itself(const Loop& loop) {
  constexpr double kLobe = 1e-3;  // mm2: a smaller one is the ends of two curves that meet a little late
  const std::size_t n = loop.size();
  struct Side {
    double lo = 0.0, hi = 0.0;  // in x
    std::size_t i = 0;
  };
  std::vector<Side> sides;
  for (std::size_t i = 0; i < n; ++i) {
    const double a = loop[i].x, b = loop[(i + 1) % n].x;
    sides.push_back({std::min(a, b), std::max(a, b), i});
  }
  std::sort(sides.begin(), sides.end(),
            [](const Side& a, const Side& b) { return std::pair(a.lo, a.i) < std::pair(b.lo, b.i); });
  for (std::size_t p = 0; p < n; ++p) {
    for (std::size_t q = p + 1; q < n && sides[q].lo <= sides[p].hi; ++q) {
      const std::size_t i = std::min(sides[p].i, sides[q].i), j = std::max(sides[p].i, sides[q].i);
      const Vec2 a = loop[i], b = loop[(i + 1) % n], c = loop[j], d = loop[(j + 1) % n];
      const double s1 = cross(b - a, c - a), s2 = cross(b - a, d - a);
      const double s3 = cross(d - c, a - c), s4 = cross(d - c, b - c);
      if (!(s1 * s2 < 0.0 && s3 * s4 < 0.0)) continue;
      const Vec2 at = a + (s3 / (s3 - s4)) * (b - a);
      Loop lobe = {at};
      for (std::size_t k = i + 1; k <= j; ++k) lobe.push_back(loop[k]);
      const double one = geometry::signed_area(lobe);
      if (std::abs(one) > kLobe && std::abs(geometry::signed_area(loop) - one) > kLobe) return at;
    }
  }
  return std::nullopt;
}

tl::unexpected<Diagnostic> missing(const Model& m, AnyRef feature, const std::string& attribute) {
  return fail({.code = "SHP-MISSING",
               .message = label(m, feature) + " has no " + attribute + ", so its shape is not known",
               .instance = m.origin(feature).instance,
               .path = attribute,
               .hint = "give the attribute, or machine the feature by explicit toolpaths"});
}

tl::unexpected<Diagnostic> missing(const Model& m, AnyRef feature, const std::string& attribute,
                                   Diagnostic why) {
  if (why.code == "MDL-MISSING") return missing(m, feature, attribute);
  why.message = label(m, feature) + ", " + attribute + ": " + why.message;
  why.path = attribute;
  return fail(std::move(why));
}

tl::unexpected<Diagnostic> unsupported(const Model& m, AnyRef feature, const std::string& what) {
  return fail({.code = "SHP-UNSUPPORTED",
               .message = label(m, feature) + ": " + what,
               .instance = m.origin(feature).instance});
}

tl::unexpected<Diagnostic> crossed(const Model& m, AnyRef feature, const std::string& what, Vec2 at) {
  return unsupported(m, feature,
                     "its " + what + " crosses itself at (" + trimmed(at.x, 3) + ", " + trimmed(at.y, 3) +
                         ") of the feature's frame, so that it bounds no single area");
}

Result<FeatureShape> base(const Model& m, AnyRef feature, bool needs_depth) {
  FeatureShape s;
  s.feature = feature;
  const auto* named = m.get<ManufacturingFeature>(feature);
  if (named != nullptr) s.name = named->its_id.value_or("");
  if (const auto* placed = m.get<Two5dManufacturingFeature>(feature)) {
    auto frame = placement_or_identity(m, placed->feature_placement);
    if (!frame) return tl::unexpected(frame.error());
    s.frame = *frame;
  }
  if (!needs_depth) return s;
  const auto depth = depth_of(m, feature);
  if (!depth) return tl::unexpected(depth.error());
  if (depth->tilted) return unsupported(m, feature, "its depth surface is tilted against its axis");
  s.depth_mm = depth->depth_mm;
  s.depth_tolerance = depth->tolerance;
  if (s.depth_mm < 0.0) {
    return unsupported(m, feature,
                       "its depth surface lies above its placement (placements are at the top, z out)");
  }
  return s;
}

Result<geometry::Placement> profile_frame(const Model& m, const Profile& profile, FeatureShape& into) {
  auto frame = placement_or_identity(m, profile.placement);
  if (!frame) return frame;
  const bool somewhere = norm(into.frame.origin) > 0.0;
  if (somewhere && norm(frame->origin - into.frame.origin) < 1e-9) {
    const bool turned = norm(frame->z - into.frame.z) > 1e-9 || norm(frame->x - into.frame.x) > 1e-9;
    if (turned) {
      return unsupported(
          m, into.feature,
          "its profile's placement has the feature's origin and other axes, so that nobody can "
          "tell whether it is relative to the feature; state it relative to the feature");
    }
    into.assumptions.push_back(
        "the profile's placement repeats the feature's; it is read as relative to it, that is, none");
    return geometry::Placement{};
  }
  return frame;
}

Result<geometry::Region> closed_area(const Model& m, Ref<ClosedProfile> profile, FeatureShape& into) {
  const auto* p = m.get<ClosedProfile>(profile);
  if (p == nullptr) return missing(m, into.feature, "closed profile");
  const auto frame = profile_frame(m, *p, into);
  if (!frame) return tl::unexpected(frame.error());
  if (const auto* r = m.get<RectangularClosedProfile>(profile)) {
    const auto width = length(m, r->profile_width);
    const auto along = length(m, r->profile_length);
    if (!width) return tl::unexpected(width.error());
    if (!along) return tl::unexpected(along.error());
    into.width = *width;
    into.length = *along;
    const double x = 0.5 * along->nominal_mm;
    const double y = 0.5 * width->nominal_mm;
    if (!(x > 0.0 && y > 0.0)) return unsupported(m, into.feature, "its rectangle has no area");
    if (into.corner_radius_mm > std::min(x, y) + 1e-9) {
      into.assumptions.push_back(
          "its corner radius is larger than half its width; the ends are taken as half circles");
      into.corner_radius_mm = std::min(x, y);
    }
    return moved(*frame,
                 geometry::rounded_rectangle({-x, -y}, {x, y}, into.corner_radius_mm, kAreaTolerance));
  }
  if (const auto* c = m.get<CircularClosedProfile>(profile)) {
    const auto d = length(m, c->diameter);
    if (!d) return tl::unexpected(d.error());
    if (!(d->nominal_mm > 0.0)) return unsupported(m, into.feature, "its circle has no diameter");
    into.width = into.length = *d;
    return moved(*frame, geometry::disc({0.0, 0.0}, 0.5 * d->nominal_mm, kAreaTolerance));
  }
  if (const auto* n = m.get<NgonClosedProfile>(profile)) {
    const auto d = length(m, n->diameter);
    if (!d) return tl::unexpected(d.error());
    const auto sides = n->number_of_sides.value_or(0);
    if (sides < 3 || sides > 1000 || !(d->nominal_mm > 0.0))
      return unsupported(m, into.feature, "its polygon has fewer than three sides or no size");
    // circumscribed: the circle lies inside, touching the sides; otherwise the corners lie on it.
    if (!n->circumscribed) {
      into.assumptions.push_back("its polygon does not say whether its diameter of " +
                                 trimmed(d->nominal_mm, 4) +
                                 " mm is across flats or across corners (circumscribed_or_across_flats); "
                                 "across corners is taken");
    }
    const double inner = std::cos(std::numbers::pi / static_cast<double>(sides));
    const double radius = 0.5 * d->nominal_mm / (n->circumscribed.value_or(false) ? inner : 1.0);
    Loop loop;
    for (std::int64_t i = 0; i < sides; ++i) {
      const double a = 2.0 * std::numbers::pi * static_cast<double>(i) / static_cast<double>(sides);
      loop.push_back({radius * std::cos(a), radius * std::sin(a)});
    }
    return moved(*frame, geometry::Region{{loop}});
  }
  if (const auto* g = m.get<GeneralClosedProfile>(profile)) {
    const auto points = curve_points(m, g->closed_profile_shape, kAreaTolerance);
    if (!points) return tl::unexpected(points.error());
    Loop loop = in_plane(*frame, *points);
    if (loop.size() > 1 && norm(loop.front() - loop.back()) < 1e-6) loop.pop_back();
    if (loop.size() < 3)
      return unsupported(m, into.feature, "its closed profile has fewer than three points");
    if (const auto at = crosses_itself(loop)) return crossed(m, into.feature, "closed profile", *at);
    if (geometry::signed_area(loop) < 0.0) std::reverse(loop.begin(), loop.end());
    return geometry::clean({loop});
  }
  return unsupported(m, into.feature, "its closed profile is of a kind that is not understood");
}

Result<std::vector<Vec2>> open_line(const Model& m, Ref<OpenProfile> profile) {
  const auto* p = m.get<OpenProfile>(profile);
  if (p == nullptr) return fail("SHP-MISSING", "an open profile is missing");
  const auto frame = placement_or_identity(m, p->placement);
  if (!frame) return tl::unexpected(frame.error());
  if (const auto* g = m.get<GeneralProfile>(profile)) {
    const auto points = curve_points(m, g->its_profile, kAreaTolerance);
    if (!points) return tl::unexpected(points.error());
    return in_plane(*frame, *points);
  }
  if (const auto* l = m.get<LinearProfile>(profile)) {
    const auto* value = m.get<NumericParameter>(l->profile_length);
    if (value == nullptr || !value->its_parameter_value)
      return fail("SHP-MISSING", "a linear_profile has no profile_length");
    return in_plane(*frame, {{0.0, 0.0, 0.0}, {*value->its_parameter_value, 0.0, 0.0}});
  }
  if (const auto* c = m.get<PartialCircularProfile>(profile)) {
    const auto r = length(m, c->radius);
    if (!r) return tl::unexpected(r.error());
    Loop out = {{r->nominal_mm, 0.0}};
    geometry::append_arc(out, {0.0, 0.0}, out.front(), c->sweep_angle.value_or(0.0), kAreaTolerance);
    return moved(*frame, out);
  }
  return fail("SHP-UNSUPPORTED", "an open profile of this kind does not bound an area");
}

Result<std::vector<Vec2>> travel_line(const Model& m, Ref<TravelPath> path, FeatureShape& into) {
  const auto* p = m.get<TravelPath>(path);
  if (p == nullptr) return missing(m, into.feature, "course_of_travel");
  const auto frame = placement_or_identity(m, p->placement);
  if (!frame) return tl::unexpected(frame.error());
  if (const auto* l = m.get<LinearPath>(path)) {
    const auto distance = length(m, l->distance);
    if (!distance) return tl::unexpected(distance.error());
    const auto d = direction(m, l->its_direction);
    if (!d) return tl::unexpected(d.error());
    into.length = *distance;
    return in_plane(*frame, {{0.0, 0.0, 0.0}, distance->nominal_mm * *d});
  }
  if (const auto* c = m.get<CircularPath>(path)) {
    const auto r = length(m, c->radius);
    if (!r) return tl::unexpected(r.error());
    const auto* partial = m.get<PartialCircularPath>(path);
    const double sweep = partial != nullptr ? partial->sweep_angle.value_or(0.0) : 2.0 * std::numbers::pi;
    Loop out = {{r->nominal_mm, 0.0}};
    geometry::append_arc(out, {0.0, 0.0}, out.front(), sweep, kAreaTolerance);
    return moved(*frame, out);
  }
  if (const auto* g = m.get<GeneralPath>(path)) {
    const auto points = curve_points(m, g->swept_path, kAreaTolerance);
    if (!points) return tl::unexpected(points.error());
    return in_plane(*frame, *points);
  }
  return unsupported(m, into.feature, "its course of travel is of a kind that is not understood");
}

namespace {

/// By the noun nearest above the feature's own.
Result<Shapes> plain(const Model& m, AnyRef feature) {
  static const std::map<TypeId, ShapeNoun> kNouns = [] {
    std::map<TypeId, ShapeNoun> all;
    for (const std::vector<ShapeNoun>& of_a_file : shape_nouns())
      for (const ShapeNoun& s : of_a_file) all.emplace(s.noun, s);
    return all;
  }();
  for (TypeId t = feature.type; t != TypeId::kNone; t = noun_type(t).parent)
    if (const auto it = kNouns.find(t); it != kNouns.end()) return it->second.build(m, feature);
  return unsupported(m, feature, "this kind of feature is not understood");
}

}  // namespace

Result<Shapes> any(const Model& m, AnyRef feature, const Within& in) {
  if (in.depth > kNesting) return unsupported(m, feature, "is nested too deeply, or in itself");
  if (!feature.set()) return fail("SHP-MISSING", "a feature is missing");
  if (const auto* f = m.get<Thread>(feature)) return thread(m, feature, *f, in);
  if (const auto* f = m.get<TransitionFeature>(feature)) return transition(m, feature, *f, in);
  if (const auto* f = m.get<CompoundFeature>(feature)) return compound(m, feature, *f, in);
  if (const auto* f = m.get<ReplicateFeature>(feature)) return replicate(m, feature, *f, in);
  auto out = plain(m, feature);
  if (out && in.container.set()) {
    for (FeatureShape& s : *out) s.frame = compose(in.frame, s.frame);
  }
  return out;
}

}  // namespace shape

Result<std::vector<FeatureShape>> shapes_of(const Model& model, Ref<ManufacturingFeature> feature) {
  shape::Piece piece(model);
  const shape::Within workpiece{{}, {}, 0, false, &piece};
  auto out = shape::standing(model, feature, workpiece);
  if (!out) return out;
  if (auto ok = shape::spare_bosses(model, feature, workpiece, *out); !ok) return tl::unexpected(ok.error());
  for (std::size_t i = 0; i < out->size(); ++i) {
    (*out)[i].member = static_cast<int>(i);
    if (out->size() > 1) (*out)[i].name += "[" + std::to_string(i + 1) + "]";
  }
  return out;
}

Result<geometry::Placement> coordinates_of(const Model& model, AnyRef feature) {
  if (!feature.set()) return geometry::Placement{};
  shape::Piece piece(model);
  const auto in = shape::stated_in(model, feature, shape::Within{{}, {}, 0, false, &piece});
  if (!in) return tl::unexpected(in.error());
  return in->frame;
}

}  // namespace capstan::model

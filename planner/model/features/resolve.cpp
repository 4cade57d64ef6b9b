#include "planner/model/features/resolve.h"

#include <cmath>
#include <optional>

#include "planner/ground/base/number.h"
#include "planner/model/features/fit/stated.h"
#include "planner/model/nouns/feature.h"
#include "planner/model/nouns/geometric_item.h"
#include "planner/model/nouns/support.h"

namespace capstan::model {
namespace {

constexpr double kParallel = 1e-9;  // sine or cosine below which directions count as parallel or square

tl::unexpected<Diagnostic> missing(const Model& model, AnyRef at, std::string what) {
  Diagnostic d{.code = "MDL-MISSING", .message = std::move(what)};
  if (at.set()) {
    d.instance = model.origin(at).instance;
    d.line = model.origin(at).line;
  }
  return fail(std::move(d));
}

// The same place in the file, for faults of the numbers themselves.
template <class T>
Result<T> placed(const Model& model, AnyRef at, Result<T> r) {
  if (!r) {
    r.error().instance = model.origin(at).instance;
    r.error().line = model.origin(at).line;
  }
  return r;
}

}  // namespace

Result<geometry::Vec3> point(const Model& model, Ref<CartesianPoint> p) {
  const auto* noun = model.get<CartesianPoint>(p);
  if (noun == nullptr) return missing(model, p, "a point is missing");
  const auto& c = noun->coordinates.items;
  if (c.size() != 2 && c.size() != 3) return missing(model, p, "a point needs two or three coordinates");
  return geometry::Vec3{c[0], c[1], c.size() == 3 ? c[2] : 0.0};
}

Result<geometry::Vec3> direction(const Model& model, Ref<Direction> d) {
  const auto* noun = model.get<Direction>(d);
  if (noun == nullptr) return missing(model, d, "a direction is missing");
  const auto& c = noun->direction_ratios.items;
  if (c.size() != 2 && c.size() != 3) return missing(model, d, "a direction needs two or three ratios");
  const geometry::Vec3 v{c[0], c[1], c.size() == 3 ? c[2] : 0.0};
  const double n = norm(v);
  if (!(n > 0.0) || !std::isfinite(n)) {
    return placed<geometry::Vec3>(model, d, fail("GEO-DIRECTION", "a direction has no length"));
  }
  return (1.0 / n) * v;
}

Result<geometry::Placement> placement(const Model& model, Ref<Axis2Placement3d> p) {
  const auto* noun = model.get<Axis2Placement3d>(p);
  if (noun == nullptr) return missing(model, p, "a placement is missing");
  const auto origin = point(model, noun->location);
  if (!origin) return tl::unexpected(origin.error());
  geometry::Vec3 axis{0.0, 0.0, 1.0};
  if (noun->axis.set()) {
    const auto a = direction(model, noun->axis);
    if (!a) return tl::unexpected(a.error());
    axis = *a;
  }
  if (!noun->ref_direction.set()) return placed(model, p, geometry::make_placement(*origin, axis));
  const auto ref = direction(model, noun->ref_direction);
  if (!ref) return tl::unexpected(ref.error());
  return placed(model, p, geometry::make_placement(*origin, axis, *ref));
}

Result<geometry::Placement> placement_or_identity(const Model& model, Ref<Axis2Placement3d> p) {
  if (!p.set()) return geometry::Placement{};
  return placement(model, p);
}

Result<ResolvedLength> length(const Model& model, Ref<TolerancedLengthMeasure> m) {
  const auto* noun = model.get<TolerancedLengthMeasure>(m);
  if (noun == nullptr) return missing(model, m, "a length is missing");
  if (!noun->theoretical_size) return missing(model, m, "a length has no theoretical_size");
  if (*noun->theoretical_size < 0.0) {
    return placed<ResolvedLength>(
        model, m, fail("MDL-LENGTH", "a length of " + trimmed(*noun->theoretical_size, 4) + " mm is none"));
  }
  ResolvedLength out;
  out.nominal_mm = *noun->theoretical_size;
  Result<std::optional<Deviations>> d;
  if (const auto* pm = model.get<PlusMinusValue>(noun->implicit_tolerance)) d = stated(*pm);
  if (const auto* lf = model.get<LimitsAndFits>(noun->implicit_tolerance)) d = stated(out.nominal_mm, *lf);
  if (!d) return placed<ResolvedLength>(model, noun->implicit_tolerance, tl::unexpected(d.error()));
  if (!*d) return out;
  out.lower_mm = (*d)->lower_mm;
  out.upper_mm = (*d)->upper_mm;
  out.given = true;
  if (const auto grade = grade_of(out.nominal_mm, out.width())) out.grade = grade_name(*grade);
  return out;
}

Result<ResolvedDepth> depth_of(const Model& model, AnyRef feature) {
  AnyRef at;
  if (const auto* f = model.get<MachiningFeature>(feature)) at = f->depth;
  if (const auto* f = model.get<RegionProjection>(feature)) at = f->depth;
  ResolvedDepth out;
  if (model.holds<TolerancedLengthMeasure>(at)) {
    const auto l = length(model, Ref<TolerancedLengthMeasure>(at));
    if (!l) return tl::unexpected(l.error());
    out.depth_mm = l->nominal_mm;
    out.tolerance = *l;
    out.surface.origin = {0.0, 0.0, -l->nominal_mm};
    return out;
  }
  const auto* surface = model.get<ElementarySurface>(at);
  if (surface == nullptr) return missing(model, feature, "the feature has no depth");
  const auto frame = placement(model, surface->position);
  if (!frame) return tl::unexpected(frame.error());
  if (std::abs(frame->z.z) < kParallel) {
    return placed<ResolvedDepth>(model, at,
                                 fail("MDL-DEPTH", "the depth surface is parallel to the feature's axis"));
  }
  // The plane (p - origin) . n = 0 at (0, 0, z): z = origin . n / n.z.
  out.depth_mm = -dot(frame->origin, frame->z) / frame->z.z;
  out.surface = *frame;
  out.tilted = 1.0 - std::abs(frame->z.z) > kParallel;
  out.tolerance.nominal_mm = out.depth_mm;
  return out;
}

}  // namespace capstan::model

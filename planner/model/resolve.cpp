#include "planner/model/resolve.h"

#include <array>
#include <cmath>

#include "planner/model/nouns/feature.h"
#include "planner/model/nouns/geometric_item.h"
#include "planner/model/nouns/support.h"

namespace capstan::model {
namespace {

constexpr double kRounding = 1.0 + 1e-9;  // a width is a difference of decimals
constexpr double kParallel = 1e-9;        // sine or cosine below which directions count as parallel or square

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

// Deviations from nominal; see the header.
void apply(const PlusMinusValue& t, ResolvedLength& out) {
  if (!t.upper_limit || !t.lower_limit) return;
  out.upper_mm = *t.upper_limit;
  out.lower_mm = -*t.lower_limit;
  if (out.lower_mm >= out.upper_mm && *t.lower_limit < 0.0) out.lower_mm = *t.lower_limit;
  if (out.lower_mm > out.upper_mm) std::swap(out.lower_mm, out.upper_mm);
  out.given = true;
}

void apply(const LimitsAndFits& t, ResolvedLength& out) {
  if (!t.deviation || !t.grade) return;
  const double width = std::abs(*t.grade);
  const bool downwards =
      *t.deviation < 0.0 || (*t.deviation == 0.0 && t.its_fitting_type == FittingType::kShaft);
  out.lower_mm = downwards ? *t.deviation - width : *t.deviation;
  out.upper_mm = downwards ? *t.deviation : *t.deviation + width;
  out.given = true;
}

// Standard tolerances of grades 5..18, micrometres, for sizes up to `upto_mm`. Source: ISO 286-1, table 1.
struct SizeRange {
  double upto_mm;
  std::array<int, 14> tolerance_um;
};
// clang-format off
constexpr std::array<SizeRange, 13> kSizeRanges = {{
    {3.0, {4, 6, 10, 14, 25, 40, 60, 100, 140, 250, 400, 600, 1000, 1400}},
    {6.0, {5, 8, 12, 18, 30, 48, 75, 120, 180, 300, 480, 750, 1200, 1800}},
    {10.0, {6, 9, 15, 22, 36, 58, 90, 150, 220, 360, 580, 900, 1500, 2200}},
    {18.0, {8, 11, 18, 27, 43, 70, 110, 180, 270, 430, 700, 1100, 1800, 2700}},
    {30.0, {9, 13, 21, 33, 52, 84, 130, 210, 330, 520, 840, 1300, 2100, 3300}},
    {50.0, {11, 16, 25, 39, 62, 100, 160, 250, 390, 620, 1000, 1600, 2500, 3900}},
    {80.0, {13, 19, 30, 46, 74, 120, 190, 300, 460, 740, 1200, 1900, 3000, 4600}},
    {120.0, {15, 22, 35, 54, 87, 140, 220, 350, 540, 870, 1400, 2200, 3500, 5400}},
    {180.0, {18, 25, 40, 63, 100, 160, 250, 400, 630, 1000, 1600, 2500, 4000, 6300}},
    {250.0, {20, 29, 46, 72, 115, 185, 290, 460, 720, 1150, 1850, 2900, 4600, 7200}},
    {315.0, {23, 32, 52, 81, 130, 210, 320, 520, 810, 1300, 2100, 3200, 5200, 8100}},
    {400.0, {25, 36, 57, 89, 140, 230, 360, 570, 890, 1400, 2300, 3600, 5700, 8900}},
    {500.0, {27, 40, 63, 97, 155, 250, 400, 630, 970, 1550, 2500, 4000, 6300, 9700}},
}};
// clang-format on

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
  ResolvedLength out;
  out.nominal_mm = *noun->theoretical_size;
  if (const auto* pm = model.get<PlusMinusValue>(noun->implicit_tolerance)) apply(*pm, out);
  if (const auto* lf = model.get<LimitsAndFits>(noun->implicit_tolerance)) apply(*lf, out);
  if (out.given) {
    const int grade = grade_of_tolerance(out.nominal_mm, out.width());
    if (grade != 0) out.grade = "IT" + std::to_string(grade);
  }
  return out;
}

double tolerance_of_grade(int grade, double nominal_mm) {
  if (grade < 5 || grade > 18 || !(nominal_mm > 0.0) || nominal_mm > kSizeRanges.back().upto_mm) return 0.0;
  std::size_t k = 0;
  while (nominal_mm > kSizeRanges[k].upto_mm) ++k;
  return 1e-3 * kSizeRanges[k].tolerance_um[static_cast<std::size_t>(grade - 5)];
}

int grade_of_tolerance(double nominal_mm, double width_mm) {
  int best = 0;
  for (int grade = 5; grade <= 18; ++grade) {
    const double t = tolerance_of_grade(grade, nominal_mm);
    if (t > 0.0 && t <= kRounding * width_mm) best = grade;
  }
  return best;
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

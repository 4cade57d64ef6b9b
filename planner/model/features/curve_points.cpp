#include "planner/model/features/curve_points.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>

#include "planner/ground/base/number.h"
#include "planner/ground/vocabulary/unit_factors.h"
#include "planner/model/features/resolve.h"
#include "planner/model/nouns/geometric_item.h"

namespace capstan::model {
namespace {

using geometry::Vec3;
using Points = std::vector<Vec3>;

constexpr double kSameAngle = 1e-9;  // rad
constexpr double kGap = 0.01;        // mm that the pieces of a composite may be apart; default, unsourced
constexpr int kNesting = 32;         // composites of trimmed curves of ...: deeper is refused
constexpr std::size_t kMaxPoints = 2'000'000;

tl::unexpected<Diagnostic> refuse(const Model& m, AnyRef curve, const std::string& why) {
  return fail({.code = "CRV-UNSUPPORTED",
               .message = "the curve " + why,
               .instance = curve.set() ? m.origin(curve).instance : 0});
}

/// A conic with its frame: point(t) by the parameter of ISO 10303-42, angles in rad.
struct ConicAt {
  enum class Kind : std::uint8_t { kRound, kParabola, kHyperbola };
  Kind kind = Kind::kRound;
  geometry::Placement frame;
  double a = 0.0, b = 0.0;  ///< semi-axes; of a parabola the focal distance, twice
  [[nodiscard]] bool closed() const { return kind == Kind::kRound; }
  [[nodiscard]] Vec3 local(double t) const {
    if (kind == Kind::kParabola) return {a * t * t, 2.0 * a * t, 0.0};
    if (kind == Kind::kHyperbola) return {a * std::cosh(t), b * std::sinh(t), 0.0};
    return {a * std::cos(t), b * std::sin(t), 0.0};
  }
  [[nodiscard]] Vec3 point(double t) const { return frame.to_parent(local(t)); }
  [[nodiscard]] double parameter(Vec3 p) const {
    const Vec3 q = frame.to_local(p);
    if (kind == Kind::kParabola) return 0.5 * q.y / a;
    if (kind == Kind::kHyperbola) return std::asinh(q.y / b);
    return std::atan2(q.y / b, q.x / a);
  }
};

std::optional<ConicAt> conic_of(const Model& m, AnyRef curve) {
  const auto* placed = m.get<Conic>(curve);
  if (placed == nullptr) return std::nullopt;
  const auto frame = placement(m, placed->position);
  const auto positive = [](const Real& v) { return v && *v > 0.0; };
  if (!frame) return std::nullopt;
  if (const auto* c = m.get<Circle>(curve); c != nullptr && positive(c->radius))
    return ConicAt{ConicAt::Kind::kRound, *frame, *c->radius, *c->radius};
  if (const auto* e = m.get<Ellipse>(curve);
      e != nullptr && positive(e->semi_axis_1) && positive(e->semi_axis_2))
    return ConicAt{ConicAt::Kind::kRound, *frame, *e->semi_axis_1, *e->semi_axis_2};
  if (const auto* c = m.get<Parabola>(curve); c != nullptr && positive(c->focal_dist))
    return ConicAt{ConicAt::Kind::kParabola, *frame, *c->focal_dist, *c->focal_dist};
  if (const auto* h = m.get<Hyperbola>(curve);
      h != nullptr && positive(h->semi_axis) && positive(h->semi_imag_axis))
    return ConicAt{ConicAt::Kind::kHyperbola, *frame, *h->semi_axis, *h->semi_imag_axis};
  return std::nullopt;
}

/// Chords that stray no further than the tolerance. Of a round one by the sagitta of its greatest radius of
/// parameter, r (1 - cos(step / 2)); of the others by their second derivative, step^2 |c''| / 8.
std::size_t chords(const ConicAt& c, double t0, double t1, double tolerance_mm) {
  double step = 2.0 * std::acos(1.0 - std::min(tolerance_mm / std::max(c.a, c.b), 0.5));
  if (c.kind == ConicAt::Kind::kParabola) step = std::sqrt(8.0 * tolerance_mm / (2.0 * c.a));
  if (c.kind == ConicAt::Kind::kHyperbola) {
    const double t = std::max(std::abs(t0), std::abs(t1));  // its second derivative is itself
    step = std::sqrt(8.0 * tolerance_mm / std::hypot(c.a * std::cosh(t), c.b * std::sinh(t)));
  }
  const double n = std::max(2.0, std::ceil(std::abs(t1 - t0) / step));
  return n < static_cast<double>(kMaxPoints) ? static_cast<std::size_t>(n) : 0;
}

Result<Points> sample(const Model& m, AnyRef self, const ConicAt& c, double t0, double t1,
                      double tolerance_mm) {
  const std::size_t n = chords(c, t0, t1, tolerance_mm);
  if (n == 0) return refuse(m, self, "has too many points");
  Points out;
  for (std::size_t i = 0; i <= n; ++i)
    out.push_back(c.point(t0 + (t1 - t0) * static_cast<double>(i) / static_cast<double>(n)));
  return out;
}

// An arc taken for its chords would be wrong in silence: only toolpaths have via points, and they are read
// elsewhere.
Result<Points> polyline(const Model& m, AnyRef self, const Polyline& p) {
  Points out;
  for (std::size_t i = 0; i < p.points.size(); ++i) {
    if (m.holds<ViaArcPoint>(p.points[i]) || m.holds<ViaHelixPoint>(p.points[i]))
      return refuse(m, self, "has via points, which only a toolpath may have");
    auto q = point(m, p.points[i]);
    if (!q) return tl::unexpected(q.error());
    out.push_back(*q);
  }
  return out;
}

/// A trim as a point of the curve, or as its parameter.
struct Trim {
  std::optional<Vec3> point;
  std::optional<double> parameter;
};
Trim trim_of(const Model& m, const SelectList& list) {
  Trim t;
  for (const SelectValue& v : list.items) {
    if (v.real) t.parameter = v.real;
    if (v.ref.set()) {
      if (const auto p = point(m, Ref<CartesianPoint>(v.ref))) t.point = *p;
    }
  }
  return t;
}

Result<Points> between(const Model& m, AnyRef self, const TrimmedCurve& c, double tolerance_mm) {
  const Trim a = trim_of(m, c.trim_1);
  const Trim b = trim_of(m, c.trim_2);
  if (const auto* line = m.get<Line>(c.basis_curve)) {
    const auto at = [&](const Trim& t) -> std::optional<Vec3> {
      if (t.point) return t.point;
      const auto* v = m.get<Vector>(line->dir);
      const auto p = point(m, line->pnt);
      if (!t.parameter || v == nullptr || !p) return std::nullopt;
      const auto d = direction(m, v->orientation);
      if (!d) return std::nullopt;
      return *p + (*t.parameter * v->magnitude.value_or(1.0)) * *d;
    };
    const auto p = at(a);
    const auto q = at(b);
    if (!p || !q) return refuse(m, self, "is trimmed by nothing that can be found on its line");
    return Points{*p, *q};
  }
  if (const auto conic = conic_of(m, c.basis_curve)) {
    const bool by_parameter = c.master_representation == TrimmingPreference::kParameter;
    const auto at = [&](const Trim& t) -> std::optional<double> {
      if (t.point && !(by_parameter && t.parameter)) return conic->parameter(*t.point);
      if (!t.parameter) return std::nullopt;
      return conic->closed() ? *t.parameter * kRadPerTurn / 360.0
                             : *t.parameter;  // angles are in degrees here
    };
    const auto t0 = at(a);
    auto t1 = at(b);
    if (!t0 || !t1) return refuse(m, self, "is trimmed by nothing that can be found on its conic");
    if (!std::isfinite(*t0) || !std::isfinite(*t1)) return refuse(m, self, "is trimmed at infinity");
    // An open conic runs from the one to the other whatever its sense says. A closed one goes on across 0, by
    // up to a full turn, which is what ends that coincide mean.
    if (conic->closed()) {
      const bool along = c.sense_agreement.value_or(true);
      double turn = std::fmod(along ? *t1 - *t0 : *t0 - *t1, kRadPerTurn);
      if (turn < 0.0) turn += kRadPerTurn;
      if (turn < kSameAngle || turn > kRadPerTurn - kSameAngle) turn = kRadPerTurn;
      t1 = along ? *t0 + turn : *t0 - turn;
    }
    return sample(m, self, *conic, *t0, *t1, tolerance_mm);
  }
  return refuse(m, self, "is a trimmed curve on a basis that is neither line nor conic");
}

std::optional<std::vector<double>> knots_of(const Model& m, AnyRef curve, const BSplineCurve& s, int degree,
                                            std::size_t n) {
  std::vector<double> knots;
  if (const auto* k = m.get<BSplineCurveWithKnots>(curve)) {
    if (k->knots.items.size() != k->knot_multiplicities.items.size()) return std::nullopt;
    for (std::size_t i = 0; i < k->knots.items.size(); ++i) {
      const auto times = k->knot_multiplicities.items[i];
      if (times < 0 || times > degree + 1) return std::nullopt;
      knots.insert(knots.end(), static_cast<std::size_t>(times), k->knots.items[i]);
    }
  } else if (m.holds<BezierCurve>(curve) || m.holds<QuasiUniformCurve>(curve)) {
    const std::size_t spans = n - static_cast<std::size_t>(degree);
    knots.assign(static_cast<std::size_t>(degree) + 1, 0.0);
    for (std::size_t i = 1; i < spans; ++i) knots.push_back(static_cast<double>(i));
    knots.insert(knots.end(), static_cast<std::size_t>(degree) + 1, static_cast<double>(spans));
  } else {
    for (std::size_t i = 0; i < n + static_cast<std::size_t>(degree) + 1; ++i)
      knots.push_back(static_cast<double>(i));
  }
  static_cast<void>(s);
  if (knots.size() != n + static_cast<std::size_t>(degree) + 1) return std::nullopt;
  if (!std::is_sorted(knots.begin(), knots.end())) return std::nullopt;
  return knots;
}

Vec3 de_boor(const Points& control, const std::vector<double>& knots, std::size_t degree, std::size_t span,
             double t) {
  Points d(control.begin() + static_cast<std::ptrdiff_t>(span - degree),
           control.begin() + static_cast<std::ptrdiff_t>(span + 1));
  for (std::size_t r = 1; r <= degree; ++r) {
    for (std::size_t j = degree; j >= r; --j) {
      const std::size_t i = j + span - degree;
      const double width = knots[i + degree + 1 - r] - knots[i];
      const double w = width > 0.0 ? (t - knots[i]) / width : 0.0;
      d[j] = (1.0 - w) * d[j - 1] + w * d[j];
    }
  }
  return d[degree];
}

Result<Points> spline(const Model& m, AnyRef self, const BSplineCurve& s, double tolerance_mm) {
  if (!s.degree || *s.degree < 1 || *s.degree > 25) return refuse(m, self, "has a degree outside 1 to 25");
  const auto degree = static_cast<std::size_t>(*s.degree);
  Points control;
  for (std::size_t i = 0; i < s.control_points_list.size(); ++i) {
    auto p = point(m, s.control_points_list[i]);
    if (!p) return tl::unexpected(p.error());
    control.push_back(*p);
  }
  if (control.size() <= degree) return refuse(m, self, "has fewer control points than its degree needs");
  if (const auto* r = m.get<RationalBSplineCurve>(self)) {
    for (const double w : r->weights_data.items) {
      if (w != 1.0) return refuse(m, self, "is a rational B-spline, which is not read yet");
    }
  }
  const auto knots = knots_of(m, self, s, static_cast<int>(degree), control.size());
  if (!knots) return refuse(m, self, "has knots that do not match its control points");
  Points out;
  for (std::size_t span = degree; span < control.size(); ++span) {
    const double t0 = (*knots)[span];
    const double t1 = (*knots)[span + 1];
    if (!(t1 > t0)) continue;
    // Enough chords for the control polygon's second differences (a bound on the curvature in this span).
    double bend = 0.0;
    for (std::size_t i = span - degree; i + 2 <= span; ++i) {
      bend = std::max(bend, norm(control[i + 2] - 2.0 * control[i + 1] + control[i]));
    }
    const double d = static_cast<double>(degree);
    const int n =
        std::clamp(static_cast<int>(std::ceil(std::sqrt(d * d * bend / (8.0 * tolerance_mm)))), 1, 4096);
    for (int i = out.empty() ? 0 : 1; i <= n; ++i) {
      out.push_back(de_boor(control, *knots, degree, span, t0 + (t1 - t0) * i / n));
    }
  }
  return out;
}

Result<Points> points(const Model& m, AnyRef curve, double tolerance_mm, int depth);

Result<Points> composite(const Model& m, const CompositeCurve& c, double tolerance_mm, int depth) {
  Points out;
  for (const AnyRef item : c.segments.items) {
    const auto* segment = m.get<CompositeCurveSegment>(item);
    auto part = points(m, segment != nullptr ? AnyRef(segment->parent_curve) : item, tolerance_mm, depth + 1);
    if (!part) return part;
    if (segment != nullptr && !segment->same_sense.value_or(true)) std::reverse(part->begin(), part->end());
    const double gap = out.empty() || part->empty() ? 0.0 : norm(out.back() - part->front());
    if (gap > kGap) return refuse(m, item, "has a gap of " + trimmed(gap, 3) + " mm before it");
    const bool joined = !out.empty() && !part->empty() && norm(out.back() - part->front()) < 1e-6;
    out.insert(out.end(), part->begin() + (joined ? 1 : 0), part->end());
  }
  return out;
}

// Nesting is bounded by kNesting: files may hold a composite of itself.
Result<Points> points(const Model& m, AnyRef curve, double tolerance_mm, int depth) {
  if (depth > kNesting) return refuse(m, curve, "is nested too deeply, or in itself");
  Result<Points> out = refuse(m, curve, "is of a kind that is not read");
  if (const auto* p = m.get<Polyline>(curve)) {
    out = polyline(m, curve, *p);
  } else if (const auto* t = m.get<TrimmedCurve>(curve)) {
    out = between(m, curve, *t, tolerance_mm);
  } else if (const auto* c = m.get<CompositeCurve>(curve)) {
    out = composite(m, *c, tolerance_mm, depth);
  } else if (const auto* s = m.get<BSplineCurve>(curve)) {
    out = spline(m, curve, *s, tolerance_mm);
  } else if (const auto conic = conic_of(m, curve); conic && conic->closed()) {
    out = sample(m, curve, *conic, 0.0, kRadPerTurn, tolerance_mm);
  }
  if (out && out->size() > kMaxPoints) return refuse(m, curve, "has too many points");
  return out;
}

}  // namespace

Result<std::vector<geometry::Vec3>> curve_points(const Model& model, AnyRef curve, double tolerance_mm) {
  if (!curve.set()) return fail("CRV-MISSING", "a curve is missing");
  return points(model, curve, tolerance_mm, 0);
}

}  // namespace capstan::model

#include <algorithm>
#include <cmath>
#include <numbers>

#include "planner/model/nouns/all.h"
#include "planner/proof/verify/volumes/nouns.h"

// Curves of ISO 10303-42 as exact edges. A curve is evaluated in its own parameter: lines and circles become
// one edge each, in the sense in which the trimmed curve runs (sense_agreement; the parameter of a circle is
// its angle); conics that are no circles and B-splines are halved until each chord is near enough to its
// middle and quarters. B-splines are evaluated by their basis functions (Cox and de Boor), with weights.

namespace capstan::verify::volumes {

using geometry::Placement;
using geometry::Vec2;
using geometry::Vec3;
using model::AnyRef;
using model::Model;

namespace {

constexpr double kPi = std::numbers::pi;
constexpr int kDeepest = 32;               ///< composites of composites
constexpr int kHalvings = 14;              ///< of one span of a spline
constexpr std::size_t kMostEdges = 50000;  ///< more are not looked at
constexpr double kFlat = 1e-6;             ///< mm out of the plane, sine of an angle against its axis

Course refuse(const char* why) { return {{}, 0.0, why}; }

/// A curve as a function of its own parameter, over an interval.
template <class At>
void halve(const At& at, double a, double b, Vec3 from, Vec3 to, int depth, std::vector<Vec3>& out) {
  bool straight = depth >= kHalvings;
  if (!straight) {
    straight = true;
    const Vec3 d = to - from;
    const double n = norm(d);
    for (const double share : {0.25, 0.5, 0.75}) {
      const Vec3 p = at(a + share * (b - a)) - from;
      const double off = n > 0.0 ? norm(cross(p, d)) / n : norm(p);
      straight = straight && off < kSplineMm && (n > 0.0 || norm(p) < kSplineMm);
    }
  }
  if (straight) {
    out.push_back(to);
    return;
  }
  const double c = 0.5 * (a + b);
  const Vec3 mid = at(c);
  halve(at, a, c, from, mid, depth + 1, out);
  halve(at, c, b, mid, to, depth + 1, out);
}

Course through(const std::vector<Vec3>& points) {
  Course out;
  if (points.size() < 2) return refuse("a curve has fewer than two points");
  out.height_mm = points.front().z;
  for (std::size_t i = 1; i < points.size(); ++i) {
    if (std::abs(points[i].z - out.height_mm) > kFlat) return refuse("a curve does not lie in one plane");
    const Vec2 a = xy(points[i - 1]), b = xy(points[i]);
    if (norm(b - a) > 1e-9) out.edges.push_back(straight(a, b));
  }
  if (out.edges.empty()) return refuse("a curve has no length");
  return out;
}

Course polyline(const Model& m, const model::Polyline& p) {
  std::vector<Vec3> points;
  for (const AnyRef r : p.points.items) {
    if (m.holds<model::ViaArcPoint>(r) || m.holds<model::ViaHelixPoint>(r))
      return refuse("a polyline has via points, which only toolpaths have");
    const auto q = point_of(m, r);
    if (!q) return refuse("a polyline has a point without coordinates");
    points.push_back(*q);
  }
  return through(points);
}

/// A conic: the plane curve c + A f(t) + B g(t).
struct ConicAt {
  Placement frame;
  double a = 0.0, b = 0.0;
  enum class Kind : std::uint8_t { kEllipse, kParabola, kHyperbola } kind = Kind::kEllipse;
  [[nodiscard]] Vec3 at(double t) const {
    switch (kind) {
      case Kind::kParabola:
        return frame.to_parent({a * t * t, 2.0 * a * t, 0.0});
      case Kind::kHyperbola:
        return frame.to_parent({a * std::cosh(t), b * std::sinh(t), 0.0});
      default:
        return frame.to_parent({a * std::cos(t), b * std::sin(t), 0.0});
    }
  }
  [[nodiscard]] double parameter(Vec3 p) const {
    const Vec3 d = p - frame.origin;
    const double x = dot(d, frame.x), y = dot(d, frame.y);
    switch (kind) {
      case Kind::kParabola:
        return y / (2.0 * a);
      case Kind::kHyperbola:
        return std::asinh(y / b);
      default:
        return std::atan2(y / b, x / a);
    }
  }
};

std::optional<ConicAt> conic_of(const Model& m, AnyRef r) {
  const auto* c = m.get<model::Conic>(r);
  const auto frame = c == nullptr ? std::nullopt : frame_of(m, c->position);
  if (!frame) return std::nullopt;
  using Kind = ConicAt::Kind;
  ConicAt out{*frame, 0.0, 0.0, Kind::kEllipse};
  if (const auto* k = m.get<model::Circle>(r)) {
    out.a = out.b = k->radius.value_or(0.0);
  } else if (const auto* e = m.get<model::Ellipse>(r)) {
    out.a = e->semi_axis_1.value_or(0.0);
    out.b = e->semi_axis_2.value_or(0.0);
  } else if (const auto* p = m.get<model::Parabola>(r)) {
    out.a = out.b = p->focal_dist.value_or(0.0);
    out.kind = Kind::kParabola;
  } else if (const auto* h = m.get<model::Hyperbola>(r)) {
    out.a = h->semi_axis.value_or(0.0);
    out.b = h->semi_imag_axis.value_or(0.0);
    out.kind = Kind::kHyperbola;
  }
  if (!(out.a > 0.0 && out.b > 0.0)) return std::nullopt;
  return out;
}

/// From one parameter to another; a circle that lies flat is one arc.
Course between(const Model& m, AnyRef self, const ConicAt& c, double t0, double t1) {
  const bool circle = m.holds<model::Circle>(self);
  const double up = c.frame.z.z;
  if (circle && std::abs(std::abs(up) - 1.0) < kFlat) {
    // Seen from below the circle turns the other way round.
    const double start = std::atan2(c.frame.x.y, c.frame.x.x);
    const double sign = up > 0.0 ? 1.0 : -1.0;
    Course out;
    out.height_mm = c.frame.origin.z;
    out.edges.push_back(round(xy(c.frame.origin), c.a, start + sign * t0, sign * (t1 - t0)));
    return out;
  }
  std::vector<Vec3> points{c.at(t0)};
  constexpr int kParts = 8;
  for (int i = 0; i < kParts; ++i) {
    const double a = t0 + (t1 - t0) * i / kParts, b = t0 + (t1 - t0) * (i + 1) / kParts;
    const Vec3 from = points.back();
    halve([&](double t) { return c.at(t); }, a, b, from, c.at(b), 0, points);
  }
  return through(points);
}

/// A trim: a point of the curve, or its parameter.
struct Trim {
  std::optional<Vec3> point;
  std::optional<double> parameter;
};
Trim trim_of(const Model& m, const model::SelectList& list) {
  Trim out;
  for (const auto& v : list.items) {
    if (v.ref.set()) out.point = point_of(m, v.ref);
    if (v.real && std::isfinite(*v.real)) out.parameter = v.real;
  }
  return out;
}

Course course_of(const Model& m, const model::TrimmedCurve& t) {
  const Trim first = trim_of(m, t.trim_1), second = trim_of(m, t.trim_2);
  const bool along = t.sense_agreement.value_or(true);
  if (const auto* line = m.get<model::Line>(t.basis_curve)) {
    const auto* vector = m.get<model::Vector>(line->dir);
    const auto origin = point_of(m, line->pnt);
    const auto d = unit_of(m, vector != nullptr ? AnyRef(vector->orientation) : AnyRef{});
    const bool known = origin.has_value() && d.has_value();
    const Vec3 start = origin.value_or(Vec3{});
    const Vec3 step = (vector != nullptr ? vector->magnitude.value_or(1.0) : 1.0) * d.value_or(Vec3{});
    const auto place = [&](const Trim& trim) -> std::optional<Vec3> {
      if (trim.point) return trim.point;
      if (!trim.parameter || !known) return std::nullopt;
      return start + *trim.parameter * step;
    };
    const auto a = place(first), b = place(second);
    if (!a || !b) return refuse("a line is trimmed at no place that is stated");
    return through({*a, *b});
  }
  const auto conic = conic_of(m, t.basis_curve);
  if (!conic) return refuse("a trimmed curve is on a basis that is neither a line nor a conic");
  const bool by_number = t.master_representation == model::TrimmingPreference::kParameter;
  const bool closed = conic->kind == ConicAt::Kind::kEllipse;
  const auto place = [&](const Trim& trim) -> std::optional<double> {
    if (trim.parameter && (by_number || !trim.point))
      return closed ? *trim.parameter * kPi / 180.0 : *trim.parameter;  // plane angles of files are degrees
    if (trim.point) return conic->parameter(*trim.point);
    return std::nullopt;
  };
  const auto a = place(first), b = place(second);
  if (!a || !b || !std::isfinite(*a) || !std::isfinite(*b))
    return refuse("a conic is trimmed at no place that is stated");
  if (!closed) return between(m, t.basis_curve, *conic, *a, *b);
  // Along the basis the parameter grows from the first trim to the second, else it falls.
  double turn = along ? *b - *a : *a - *b;
  turn -= 2.0 * kPi * std::floor(turn / (2.0 * kPi));
  if (turn < 1e-9 || turn > 2.0 * kPi - 1e-9) turn = 2.0 * kPi;
  return between(m, t.basis_curve, *conic, *a, *a + (along ? turn : -turn));
}

struct Spline {
  int degree = 0;
  std::vector<Vec3> points;
  std::vector<double> weights, knots;
  /// By the basis functions that are not zero in the span of t.
  [[nodiscard]] Vec3 at(double t, std::size_t span) const {
    const auto p = static_cast<std::size_t>(degree);
    std::vector<double> n(p + 1, 0.0);
    n[0] = 1.0;
    for (std::size_t k = 1; k <= p; ++k) {
      double saved = 0.0;
      for (std::size_t r = 0; r < k; ++r) {
        const double right = knots[span + r + 1] - t, left = t - knots[span + 1 - (k - r)];
        const double share = right + left > 0.0 ? n[r] / (right + left) : 0.0;
        n[r] = saved + right * share;
        saved = left * share;
      }
      n[k] = saved;
    }
    Vec3 sum;
    double w = 0.0;
    for (std::size_t i = 0; i <= p; ++i) {
      const double k = n[i] * weights[span - p + i];
      sum = sum + k * points[span - p + i];
      w += k;
    }
    return (1.0 / w) * sum;
  }
};

Course spline(const Model& m, AnyRef self, const model::BSplineCurve& c) {
  Spline s;
  const auto degree = c.degree.value_or(0);
  if (degree < 1 || degree > 25) return refuse("a B-spline has no degree from 1 to 25");
  s.degree = static_cast<int>(degree);
  for (const AnyRef r : c.control_points_list.items) {
    const auto p = point_of(m, r);
    if (!p) return refuse("a B-spline has a control point without coordinates");
    s.points.push_back(*p);
  }
  const std::size_t n = s.points.size(), p = static_cast<std::size_t>(degree);
  if (n <= p || n > 10000) return refuse("a B-spline has too few control points, or too many");
  s.weights.assign(n, 1.0);
  if (const auto* r = m.get<model::RationalBSplineCurve>(self)) {
    if (r->weights_data.items.size() != n) return refuse("a rational B-spline has not a weight per point");
    s.weights = r->weights_data.items;
    for (const double w : s.weights) {
      if (!(w > 0.0)) return refuse("a rational B-spline has a weight that is not above 0");
    }
  }
  if (const auto* k = m.get<model::BSplineCurveWithKnots>(self)) {
    const auto& times = k->knot_multiplicities.items;
    if (times.size() != k->knots.items.size()) return refuse("a B-spline has not a multiplicity per knot");
    for (std::size_t i = 0; i < times.size(); ++i) {
      for (std::int64_t j = 0; j < times[i] && s.knots.size() <= n + p + 1; ++j)
        s.knots.push_back(k->knots.items[i]);
    }
  } else {
    const bool clamped = m.holds<model::BezierCurve>(self) || m.holds<model::QuasiUniformCurve>(self);
    for (std::size_t i = 0; i < n + p + 1; ++i) {
      const double at = static_cast<double>(i) - static_cast<double>(p);
      s.knots.push_back(clamped ? std::clamp(at, 0.0, static_cast<double>(n - p)) : at);
    }
  }
  if (s.knots.size() != n + p + 1 || !std::is_sorted(s.knots.begin(), s.knots.end()))
    return refuse("a B-spline has knots that do not fit its control points");
  std::vector<Vec3> out;
  for (std::size_t span = p; span < n; ++span) {
    const double a = s.knots[span], b = s.knots[span + 1];
    if (!(b > a)) continue;
    const auto at = [&](double t) { return s.at(t, span); };
    if (out.empty()) out.push_back(at(a));
    const Vec3 from = out.back();
    halve(at, a, b, from, at(b), 0, out);
    if (out.size() > kMostEdges) return refuse("a B-spline has too many chords");
  }
  return through(out);
}

Course read(const Model& m, AnyRef r, int depth);

Course composite(const Model& m, const model::CompositeCurve& c, int depth) {
  Course out;
  for (const AnyRef item : c.segments.items) {
    const auto* segment = m.get<model::CompositeCurveSegment>(item);
    Course part = read(m, segment != nullptr ? AnyRef(segment->parent_curve) : item, depth + 1);
    if (!part.fault.empty()) return part;
    if (segment != nullptr && !segment->same_sense.value_or(true)) {
      std::reverse(part.edges.begin(), part.edges.end());
      for (Edge& e : part.edges) e = e.reversed();
    }
    if (!out.edges.empty()) {
      if (std::abs(part.height_mm - out.height_mm) > kFlat)
        return refuse("a composite curve does not lie in one plane");
      if (norm(part.edges.front().from - out.edges.back().to) > kJoin)
        return refuse("a composite curve has a gap");
    } else {
      out.height_mm = part.height_mm;
    }
    out.edges.insert(out.edges.end(), part.edges.begin(), part.edges.end());
    if (out.edges.size() > kMostEdges) return refuse("a composite curve has too many pieces");
  }
  if (out.edges.empty()) return refuse("a composite curve has no segments");
  return out;
}

Course read(const Model& m, AnyRef r, int depth) {
  if (!r.set()) return refuse("a curve is missing");
  if (depth > kDeepest) return refuse("a curve is nested in itself, or too deeply");
  if (const auto* p = m.get<model::Polyline>(r)) return polyline(m, *p);
  if (const auto* t = m.get<model::TrimmedCurve>(r)) return course_of(m, *t);
  if (const auto* c = m.get<model::CompositeCurve>(r)) return composite(m, *c, depth);
  if (const auto* s = m.get<model::BSplineCurve>(r)) return spline(m, r, *s);
  if (const auto c = conic_of(m, r); c && c->kind == ConicAt::Kind::kEllipse)
    return between(m, r, *c, 0.0, 2.0 * kPi);
  return refuse("a curve is of a kind that this reading does not know");
}

}  // namespace

Course edges_of(const Model& m, AnyRef curve) { return read(m, curve, 0); }

Course moved(const Course& c, const Placement& inner) {
  if (!c.fault.empty()) return c;
  const double up = inner.z.z;
  if (std::abs(std::abs(up) - 1.0) > kFlat) return refuse("a profile does not lie in its feature's plane");
  Course out;
  out.height_mm = inner.to_parent({0.0, 0.0, c.height_mm}).z;
  const double turned = std::atan2(inner.x.y, inner.x.x);
  for (const Edge& e : c.edges) {
    if (!e.arc()) {
      out.edges.push_back(straight(xy(inner.to_parent({e.from.x, e.from.y, 0.0})),
                                   xy(inner.to_parent({e.to.x, e.to.y, 0.0}))));
    } else {
      const Vec2 centre = xy(inner.to_parent({e.centre.x, e.centre.y, 0.0}));
      const double sign = up > 0.0 ? 1.0 : -1.0;
      out.edges.push_back(round(centre, e.radius_mm, turned + sign * e.start_rad, sign * e.sweep_rad));
    }
    out.edges.back().open = e.open;
  }
  return out;
}

}  // namespace capstan::verify::volumes

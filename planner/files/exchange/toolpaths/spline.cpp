#include <algorithm>
#include <cmath>

#include "planner/files/exchange/toolpaths/segments.h"
#include "planner/ground/base/number.h"
#include "planner/model/features/resolve.h"
#include "planner/model/nouns/all.h"

namespace capstan::exchange::curves {

using geometry::Vec3;
using model::AnyRef;

namespace {

struct Spline {
  std::size_t degree = 0;
  std::vector<Vec3> points;
  std::vector<double> knots;    // full vector, points + degree + 1
  std::vector<double> weights;  // empty: all one

  // de Boor's algorithm in homogeneous coordinates. Source: de Boor, A Practical Guide to Splines.
  [[nodiscard]] Vec3 at(double u) const {
    std::size_t k = degree;
    while (k + 1 < points.size() && u >= knots[k + 1]) ++k;
    std::vector<Vec3> p(degree + 1);
    std::vector<double> w(degree + 1);
    for (std::size_t j = 0; j <= degree; ++j) {
      const std::size_t i = k - degree + j;
      w[j] = weights.empty() ? 1.0 : weights[i];
      p[j] = w[j] * points[i];
    }
    for (std::size_t r = 1; r <= degree; ++r) {
      for (std::size_t j = degree; j >= r; --j) {
        const std::size_t i = k - degree + j;
        const double span = knots[i + degree - r + 1] - knots[i];
        const double a = span > 0.0 ? (u - knots[i]) / span : 0.0;
        p[j] = (1.0 - a) * p[j - 1] + a * p[j];
        w[j] = (1.0 - a) * w[j - 1] + a * w[j];
      }
    }
    return (1.0 / w[degree]) * p[degree];
  }
};

std::vector<double> uniform_knots(std::size_t points, std::size_t degree, bool clamped) {
  std::vector<double> out;
  for (std::size_t i = 0; i < points + degree + 1; ++i) {
    const auto d = static_cast<double>(degree);
    const double u = static_cast<double>(i) - d;
    out.push_back(clamped ? std::clamp(u, 0.0, static_cast<double>(points) - d) : u);
  }
  return out;
}

Result<Spline> spline_of(const model::Model& m, AnyRef at) {
  const auto bad = [&](const char* what) -> Result<Spline> {
    return fail(
        {.code = "EXC-CURVE", .message = what, .line = m.origin(at).line, .instance = m.origin(at).instance});
  };
  const auto& c = m.at<model::BSplineCurve>(at);
  if (!c.degree || *c.degree < 1 || *c.degree > 100) return bad("a B-spline has an impossible degree");
  Spline s;
  s.degree = static_cast<std::size_t>(*c.degree);
  for (std::size_t i = 0; i < c.control_points_list.size(); ++i) {
    // One coordinate: a curve of plain numbers.
    const auto* bare = m.get<model::CartesianPoint>(c.control_points_list[i]);
    if (bare != nullptr && bare->coordinates.items.size() == 1) {
      s.points.push_back({bare->coordinates.items.front(), 0.0, 0.0});
      continue;
    }
    const auto p = model::point(m, c.control_points_list[i]);
    if (!p) return fail(p.error());
    s.points.push_back(*p);
  }
  if (s.points.size() <= s.degree) return bad("a B-spline has too few points for its degree");
  if (const auto* k = m.get<model::BSplineCurveWithKnots>(at)) {
    for (std::size_t i = 0; i < std::min(k->knots.items.size(), k->knot_multiplicities.items.size()); ++i) {
      const std::int64_t n = k->knot_multiplicities.items[i];
      if (n < 1 || n > *c.degree + 1) return bad("a B-spline has impossible multiplicities");
      s.knots.insert(s.knots.end(), static_cast<std::size_t>(n), k->knots.items[i]);
    }
  } else if (at.type == model::TypeId::kBezierCurve) {
    if ((s.points.size() - 1) % s.degree != 0) return bad("a BEZIER_CURVE has a wrong number of points");
    for (std::size_t i = 0; i <= (s.points.size() - 1) / s.degree; ++i) {
      const bool end = i == 0 || i == (s.points.size() - 1) / s.degree;
      s.knots.insert(s.knots.end(), s.degree + (end ? 1 : 0), static_cast<double>(i));
    }
  } else {
    s.knots = uniform_knots(s.points.size(), s.degree, at.type != model::TypeId::kUniformCurve);
  }
  if (const auto* r = m.get<model::RationalBSplineCurve>(at)) {
    s.weights = r->weights_data.items;
    const bool positive = std::all_of(s.weights.begin(), s.weights.end(), [](double w) { return w > 0.0; });
    if (s.weights.size() != s.points.size() || !positive) return bad("a B-spline has impossible weights");
  }
  if (s.knots.size() != s.points.size() + s.degree + 1)
    return bad("a B-spline's multiplicities do not match");
  return s;
}

}  // namespace

// Each span is halved until the middle and the quarters lie within the tolerance of the chord.
Result<std::vector<Vec3>> sample_spline(const model::Model& m, AnyRef curve, double from, double to,
                                        bool whole, const CurveOptions& o) {
  const auto spline = spline_of(m, curve);
  if (!spline) return fail(spline.error());
  const double lo = spline->knots[spline->degree], hi = spline->knots[spline->points.size()];
  const double a = whole ? lo : std::clamp(from, lo, hi);
  const double b = whole ? hi : std::clamp(to, lo, hi);
  std::vector<double> cuts = {a};
  for (const double k : spline->knots) {
    if (k > std::min(a, b) && k < std::max(a, b) && k != cuts.back()) cuts.push_back(k);
  }
  if (b < a) std::reverse(cuts.begin() + 1, cuts.end());
  cuts.push_back(b);
  std::vector<Vec3> out = {spline->at(a)};
  for (std::size_t i = 1; i < cuts.size(); ++i) {
    std::vector<std::pair<double, double>> pending = {{cuts[i - 1], cuts[i]}};
    while (!pending.empty()) {
      const auto [u, v] = pending.back();
      pending.pop_back();
      const Vec3 p = spline->at(u), q = spline->at(v);
      const Vec3 chord = q - p;
      double off = 0.0;
      for (const double t : {0.25, 0.5, 0.75}) {
        const Vec3 r = spline->at(u + t * (v - u)) - p;
        const double length = norm(chord);
        off = std::max(off, length > 0.0 ? norm(cross(r, chord)) / length : norm(r));
      }
      if (off > o.chord_tolerance_mm && std::abs(v - u) > 1e-9 * std::abs(hi - lo)) {
        pending.emplace_back(0.5 * (u + v), v);
        pending.emplace_back(u, 0.5 * (u + v));
      } else {
        out.push_back(q);
        if (out.size() > o.max_moves)
          return fail("EXC-CURVE", "a B-spline needs more points than " + std::to_string(o.max_moves) +
                                       " to stay within " + shortest(o.chord_tolerance_mm) + " mm of it");
      }
    }
  }
  return out;
}

Result<std::vector<double>> values_of_spline(const model::Model& m, AnyRef curve,
                                             const std::vector<double>& from, const std::vector<double>& to) {
  const auto spline = spline_of(m, curve);
  if (!spline) return fail(spline.error());
  const double lo = spline->knots[spline->degree], hi = spline->knots[spline->points.size()];
  double first = 0.0, last = 0.0;
  for (std::size_t i = 1; i < from.size(); ++i) {
    first = std::min({i == 1 ? from[i] : first, from[i], to[i]});
    last = std::max({i == 1 ? to[i] : last, from[i], to[i]});
  }
  if (!(last > first)) {
    return fail({.code = "EXC-SPEED-PROFILE",
                 .message = "a toolpath's basic curve has no parameter that its speed curve could go by",
                 .line = m.origin(curve).line,
                 .instance = m.origin(curve).instance});
  }
  constexpr int kSamples = 8;  // of one move
  std::vector<double> out = {spline->at(lo).x};
  for (std::size_t i = 1; i < from.size(); ++i) {
    double least = 0.0;
    for (int k = 0; k <= kSamples; ++k) {
      const double u = from[i] + (to[i] - from[i]) * k / kSamples;
      const double v = spline->at(std::clamp(lo + (hi - lo) * (u - first) / (last - first), lo, hi)).x;
      least = k == 0 ? v : std::min(least, v);
    }
    out.push_back(least);
  }
  return out;
}

}  // namespace capstan::exchange::curves

#include "planner/files/exchange/toolpaths/segments.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "planner/files/exchange/toolpaths/distance_text.h"
#include "planner/files/exchange/toolpaths/left_helix.h"
#include "planner/files/exchange/toolpaths/via.h"
#include "planner/ground/base/number.h"
#include "planner/ground/vocabulary/unit_factors.h"
#include "planner/model/features/curve_points.h"
#include "planner/model/features/resolve.h"
#include "planner/model/nouns/all.h"

namespace capstan::exchange::curves {

using geometry::Placement;
using geometry::Vec3;
using model::AnyRef;

namespace {

constexpr double kSameAngle = 1e-9;
constexpr int kMaxDepth = 32;
constexpr double kMostTurns = 1e5;  // of one helix; default, unsourced

tl::unexpected<Diagnostic> bad(const model::Model& m, AnyRef at, std::string what) {
  Diagnostic d{.code = "EXC-CURVE", .message = std::move(what)};
  if (at.set()) {
    d.instance = m.origin(at).instance;
    d.line = m.origin(at).line;
  }
  return fail(std::move(d));
}

/// An end of a trimmed curve: a point, a parameter, or both.
struct Trim {
  std::optional<Vec3> point;
  std::optional<double> parameter;
};

class Walker {
 public:
  Walker(const model::Model& m, const CurveOptions& o, Job& job) : m_(m), o_(o), job_(job) {}

  Result<std::vector<Segment>> curve(AnyRef at, int depth) {
    if (depth > kMaxDepth) return bad(m_, at, "curves are nested too deeply");
    if (const auto* c = m_.get<model::Polyline>(at)) return polyline(at, *c);
    if (const auto* c = m_.get<model::CompositeCurve>(at)) return composite(at, *c, depth);
    if (const auto* c = m_.get<model::TrimmedCurve>(at)) return trimmed(at, *c);
    if (m_.holds<model::BSplineCurve>(at)) return spline(at, 0.0, 0.0, true);
    if (const auto* c = m_.get<model::Circle>(at)) return circle(at, *c);
    if (m_.holds<model::Ellipse>(at)) return sampled(at);
    return bad(m_, at,
               std::string(at.set() ? model::noun_type(at.type).keyword : "nothing") +
                   " is no curve that a tool can follow");
  }

 private:
  static std::vector<Segment> lines(const std::vector<Vec3>& points) {
    std::vector<Segment> out;
    for (std::size_t i = 1; i < points.size(); ++i)
      out.push_back({points[i - 1], points[i], false, {}, {}, 0.0});
    return out;
  }

  // The parameter of a polyline is its points' number, from 0. The same point twice in a row advances it
  // without a move: there, what follows the parameter may jump.
  Result<std::vector<Segment>> polyline(AnyRef at, const model::Polyline& c) {
    const auto& items = c.points.items;
    if (items.size() < 2) return bad(m_, at, "a POLYLINE needs two points");
    for (const AnyRef end : {items.front(), items.back()}) {
      if (is_via(end)) return bad(m_, end, "a via point begins or ends a POLYLINE");
    }
    if (const auto helix = named_helix(c)) return std::vector<Segment>{*helix};
    std::vector<Segment> out;
    auto from = model::point(m_, c.points[0]);
    if (!from) return fail(from.error());
    for (std::size_t i = 0; i + 1 < items.size();) {
      std::vector<Vec3> via;
      std::size_t j = i + 1;
      for (; is_via(items[j]); ++j) {
        if (items[j].type != items[i + 1].type)
          return bad(m_, items[j], "an arc's via points are of two kinds");
        const auto p = model::point(m_, c.points[j]);
        if (!p) return fail(p.error());
        via.push_back(*p);
      }
      const auto to = model::point(m_, c.points[j]);
      if (!to) return fail(to.error());
      if (j != i + 1 || items[j] != items[i]) {
        auto s = arc_through(*from, via, *to, via_options(items[i + 1]));
        if (!s) return bad(m_, items[i + 1], s.error().message);
        s->u_from = static_cast<double>(i);
        s->u_to = static_cast<double>(j);
        out.push_back(*s);
      }
      from = to;
      i = j;
    }
    if (out.empty()) return bad(m_, at, "a POLYLINE stays where it is");
    // The same point twice at an end: no move goes with it, and the parameter still runs from 0 to the last.
    out.front().u_from = 0.0;
    out.back().u_to = static_cast<double>(items.size() - 1);
    return out;
  }

  [[nodiscard]] std::optional<Segment> named_helix(const model::Polyline& c) const {
    if (!c.name || c.name->empty()) return std::nullopt;
    std::vector<Vec3> points;
    for (const AnyRef at : c.points.items) {
      const auto p = model::point(m_, model::Ref<model::CartesianPoint>(at));
      if (!p || is_via(at)) return std::nullopt;
      points.push_back(*p);
    }
    return left_helix(*c.name, points);
  }

  static bool is_via(AnyRef p) {
    return p.type == model::TypeId::kViaArcPoint || p.type == model::TypeId::kViaHelixPoint;
  }
  [[nodiscard]] ViaOptions via_options(AnyRef via) const {
    return {.coincident_mm = o_.coincident_mm,
            .radius_mm = o_.gap_mm,
            .helix = via.type == model::TypeId::kViaHelixPoint,
            .axis = o_.helix_axis};
  }

  Result<std::vector<Segment>> composite(AnyRef at, const model::CompositeCurve& c, int depth) {
    std::vector<Segment> out;
    for (const AnyRef item : c.segments.items) {
      const auto* s = m_.get<model::CompositeCurveSegment>(item);
      // Files name curves themselves where segments are due.
      if (s == nullptr && !m_.holds<model::BoundedCurve>(item))
        return bad(m_, at, "a COMPOSITE_CURVE has a segment that is none");
      auto part = curve(s != nullptr ? AnyRef(s->parent_curve) : item, depth + 1);
      if (!part) return part;
      if (s != nullptr && !s->same_sense.value_or(true)) reverse(*part);
      follow_on(out, *part);
      if (!out.empty() && norm(part->front().from - out.back().to) > o_.gap_mm) {
        return bad(
            m_, item,
            "a COMPOSITE_CURVE has a gap of " + distance_text(norm(part->front().from - out.back().to), 4));
      }
      out.insert(out.end(), part->begin(), part->end());
      if (out.size() > o_.max_moves) return bad(m_, at, "a curve has too many pieces");
    }
    if (out.empty()) return bad(m_, at, "a COMPOSITE_CURVE has no segments");
    return out;
  }
  // The parameter of a composite runs on from piece to piece (ISO 10303-42).
  static void follow_on(std::vector<Segment>& before, std::vector<Segment>& part) {
    const auto unknown = [](const Segment& s) { return s.u_from == s.u_to; };
    if (std::any_of(before.begin(), before.end(), unknown) ||
        std::any_of(part.begin(), part.end(), unknown)) {
      for (auto* list : {&before, &part}) {
        for (Segment& s : *list) s.u_from = s.u_to = 0.0;
      }
      return;
    }
    const double offset = (before.empty() ? 0.0 : before.back().u_to) - part.front().u_from;
    for (Segment& s : part) {
      s.u_from += offset;
      s.u_to += offset;
    }
  }

  Result<Trim> trim(AnyRef at, const model::SelectList& list) {
    Trim out;
    for (const auto& v : list.items) {
      if (v.ref.set()) {
        const auto p = model::point(m_, model::Ref<model::CartesianPoint>(v.ref));
        if (!p) return fail(p.error());
        out.point = *p;
      } else if (v.real) {
        out.parameter = *v.real;
      }
    }
    if (!out.point && !out.parameter) return bad(m_, at, "a TRIMMED_CURVE lacks an end");
    return out;
  }

  Result<std::vector<Segment>> trimmed(AnyRef at, const model::TrimmedCurve& c) {
    auto a = trim(at, c.trim_1);
    if (!a) return fail(a.error());
    auto b = trim(at, c.trim_2);
    if (!b) return fail(b.error());
    if (c.master_representation == model::TrimmingPreference::kParameter && a->parameter && b->parameter) {
      a->point.reset();
      b->point.reset();
    }
    const bool along = c.sense_agreement.value_or(true);
    if (const auto* line = m_.get<model::Line>(c.basis_curve)) return on_line(at, *line, *a, *b, along);
    if (const auto* circle = m_.get<model::Circle>(c.basis_curve)) {
      return on_arc(at, circle->position, circle->radius, std::nullopt, *a, *b, along);
    }
    if (const auto* helix = m_.get<model::Helix>(c.basis_curve)) {
      return on_arc(at, helix->position, helix->radius, helix->pitch, *a, *b, along);
    }
    if (m_.holds<model::BSplineCurve>(c.basis_curve) && a->parameter && b->parameter) {
      return spline(c.basis_curve, *a->parameter, *b->parameter, false);
    }
    if (m_.holds<model::Conic>(c.basis_curve)) return sampled(at);
    return bad(m_, at, "a TRIMMED_CURVE of this kind cannot be followed");
  }

  // Conics that no control follows: chords.
  Result<std::vector<Segment>> sampled(AnyRef at) {
    auto points = model::curve_points(m_, at, o_.chord_tolerance_mm);
    if (!points) return fail(points.error());
    if (points->size() > o_.max_moves) return bad(m_, at, "a curve has too many pieces");
    return lines(*points);
  }

  Result<std::vector<Segment>> on_line(AnyRef at, const model::Line& line, Trim& a, Trim& b, bool along) {
    const auto origin = model::point(m_, line.pnt);
    if (!origin) return fail(origin.error());
    const auto* v = m_.get<model::Vector>(line.dir);
    if (v == nullptr || !v->magnitude) return bad(m_, at, "a LINE has no direction");
    const auto d = model::direction(m_, v->orientation);
    if (!d) return fail(d.error());
    for (Trim* t : {&a, &b}) {
      if (!t->point) t->point = *origin + (*t->parameter * *v->magnitude) * *d;
    }
    const double advance = dot(*b.point - *a.point, *d);
    if ((advance > 0.0) != along && advance != 0.0) {
      job_.report({.code = "EXC-SENSE",
                   .severity = Severity::kNote,
                   .message = "a trimmed LINE's sense contradicts its ends; it runs from trim_1 to trim_2",
                   .line = m_.origin(at).line,
                   .instance = m_.origin(at).instance});
    }
    return std::vector<Segment>{{*a.point, *b.point, false, {}, {}, 0.0}};
  }

  // A circle, or a helix that rises by `pitch` in one counter-clockwise turn.
  Result<std::vector<Segment>> on_arc(AnyRef at, model::Ref<model::Axis2Placement3d> position,
                                      model::Real radius, model::Real pitch, const Trim& a, const Trim& b,
                                      bool along) {
    const auto frame = model::placement(m_, position);
    if (!frame) return fail(frame.error());
    if (!radius || !(*radius > 0.0)) return bad(m_, at, "an arc has no radius");
    // Angle and height of the ends; parameters are plane angles in degrees, as ISO 14649 measures them.
    const auto angle = [&](const Trim& t) {
      if (!t.point) return *t.parameter * std::numbers::pi / 180.0;
      const Vec3 p = frame->to_local(*t.point);
      return std::atan2(p.y, p.x);
    };
    const auto place = [&](const Trim& t) {
      if (t.point) return *t.point;
      const double w = angle(t);
      const double z = pitch ? *pitch * w / kRadPerTurn : 0.0;
      return frame->to_parent({*radius * std::cos(w), *radius * std::sin(w), z});
    };
    Segment s{.from = place(a),
              .to = place(b),
              .arc = true,
              .centre = frame->origin,
              .axis = frame->z,
              .sweep = 0.0};
    if (!a.point && !b.point && pitch) {
      s.sweep = angle(b) - angle(a);
      if (!(std::abs(s.sweep) <= kMostTurns * kRadPerTurn)) return bad(m_, at, "a HELIX has too many turns");
      return std::vector<Segment>{s};
    }
    double turn = std::fmod(along ? angle(b) - angle(a) : angle(a) - angle(b), kRadPerTurn);
    if (turn < 0.0) turn += kRadPerTurn;
    if (turn < kSameAngle || turn > kRadPerTurn - kSameAngle) turn = kRadPerTurn;
    if (pitch) {
      if (!(*pitch > 0.0)) return bad(m_, at, "a HELIX has no pitch");
      const double rise = std::abs(dot(s.to - s.from, s.axis));
      const double turns = std::round((rise / *pitch) - turn / kRadPerTurn);
      if (!(std::abs(turns) <= kMostTurns)) return bad(m_, at, "a HELIX has too many turns");
      turn = std::max(0.0, turn + kRadPerTurn * turns);
      if (turn == 0.0) return std::vector<Segment>{{s.from, s.to, false, {}, {}, 0.0}};
    }
    s.sweep = along ? turn : -turn;
    return std::vector<Segment>{s};
  }

  Result<std::vector<Segment>> circle(AnyRef at, const model::Circle& c) {
    const auto frame = model::placement(m_, c.position);
    if (!frame) return fail(frame.error());
    if (!c.radius || !(*c.radius > 0.0)) return bad(m_, at, "a CIRCLE has no radius");
    const Vec3 start = frame->to_parent({*c.radius, 0.0, 0.0});
    return std::vector<Segment>{{start, start, true, frame->origin, frame->z, kRadPerTurn}};
  }

  Result<std::vector<Segment>> spline(AnyRef at, double from, double to, bool whole) {
    const auto points = sample_spline(m_, at, from, to, whole, o_);
    if (!points) return fail(points.error());
    return lines(*points);
  }

  const model::Model& m_;
  const CurveOptions& o_;
  Job& job_;
};

}  // namespace

Vec3 at(const Segment& s, double t) {
  if (!s.arc) return s.from + t * (s.to - s.from);
  const Vec3 r = s.from - s.centre;
  const Vec3 along = dot(r, s.axis) * s.axis;
  const Vec3 flat = r - along;
  const double w = t * s.sweep;
  const double rise = dot(s.to - s.from, s.axis);
  return s.centre + along + std::cos(w) * flat + std::sin(w) * cross(s.axis, flat) + (t * rise) * s.axis;
}

void reverse(std::vector<Segment>& segments) {
  std::reverse(segments.begin(), segments.end());
  for (Segment& s : segments) {
    std::swap(s.from, s.to);
    s.sweep = -s.sweep;
  }
  // The parameter runs the other way, from where it began.
  const double ends = segments.empty() ? 0.0 : segments.front().u_to + segments.back().u_from;
  for (Segment& s : segments) {
    const double from = s.u_from;
    s.u_from = ends - s.u_to;
    s.u_to = ends - from;
  }
}

Result<std::vector<Segment>> segments_of(const model::Model& m, AnyRef curve, const CurveOptions& options,
                                         Job& job) {
  return Walker(m, options, job).curve(curve, 0);
}

}  // namespace capstan::exchange::curves

#include "planner/files/exchange/toolpaths/via.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "planner/files/exchange/toolpaths/distance_text.h"
#include "planner/ground/base/number.h"
#include "planner/ground/vocabulary/unit_factors.h"
#include "planner/model/features/resolve.h"
#include "planner/model/nouns/all.h"

namespace capstan::exchange::curves {

using geometry::Vec3;

namespace {

constexpr double kGridMm = 1e-9;    // of decimals that people and programs write
constexpr double kNoiseMm = 1e-11;  // error of a centre computed from three points

tl::unexpected<Diagnostic> bad(std::string what) {
  return fail({.code = "EXC-VIA", .message = "via points: " + std::move(what)});
}

double tidy(double v) {
  const double on_grid = std::round(v / kGridMm) * kGridMm;
  return std::abs(on_grid - v) < kNoiseMm ? on_grid : v;
}

Segment straight(Vec3 from, Vec3 to) { return {from, to, false, {}, {}, 0.0}; }

/// Points in the plane through `from`, with the centre of their circle.
struct Round {
  Vec3 centre, axis;
  double radius = 0.0;
  [[nodiscard]] double angle(Vec3 start, Vec3 p) const {
    const Vec3 u = start - centre, v = p - centre;
    const double w = std::atan2(dot(cross(u, v), axis), dot(u, v) - dot(u, axis) * dot(v, axis));
    return w < 0.0 ? w + kRadPerTurn : w;
  }
};

// Through three points that are no line. Counter-clockwise about `axis`, in the order given.
Round round_through(Vec3 a, Vec3 b, Vec3 c) {
  const Vec3 u = b - a, v = c - a;
  const Vec3 n = cross(u, v);
  Round r;
  r.axis = (1.0 / norm(n)) * n;
  r.centre = a + (1.0 / (2.0 * dot(n, n))) * (dot(u, u) * cross(v, n) + dot(v, v) * cross(n, u));
  r.centre = {tidy(r.centre.x), tidy(r.centre.y), tidy(r.centre.z)};
  r.radius = norm(a - r.centre);
  return r;
}

/// Works on one arc: keeps what the checks need.
class Through {
 public:
  Through(Vec3 from, std::span<const Vec3> via, Vec3 to, const ViaOptions& o) : o_(o), from_(from), to_(to) {
    // A point on top of its neighbour says nothing.
    Vec3 last = from;
    for (const Vec3 p : via) {
      if (norm(p - last) > o.coincident_mm && norm(p - to) > o.coincident_mm) via_.push_back(last = p);
    }
  }

  Result<Segment> run() {
    if (via_.empty()) return straight(from_, to_);
    const auto flat = [&](Vec3 p) { return o_.helix ? p - dot(p - from_, o_.axis) * o_.axis : p; };
    const Vec3 a = from_, c = flat(to_);
    std::vector<Vec3> flats;
    for (const Vec3 p : via_) flats.push_back(flat(p));
    const bool closed = norm(c - a) <= o_.coincident_mm;
    const auto at_start = [&](Vec3 p) { return norm(p - a) <= o_.coincident_mm; };
    if (closed && std::all_of(flats.begin(), flats.end(), at_start)) return straight(from_, to_);
    if (closed && flats.size() < 2) return bad("a full turn takes two");
    const Vec3 b = closed ? flats.front() : flats[flats.size() / 2];
    const Vec3 d = closed ? flats[1] : c;
    if (const auto on_line = between(a, b, d)) {
      if (*on_line && !closed) return all_between(a, flats, c);
      return bad("no circle goes through them");
    }
    Round r = round_through(a, b, d);
    double sweep = closed ? kRadPerTurn : r.angle(a, c);
    double last = 0.0;
    for (std::size_t i = 0; i < flats.size(); ++i) {
      const Vec3 p = flats[i];
      const double out = std::hypot(norm(p - r.centre) - r.radius, dot(p - r.centre, r.axis));
      if (out > o_.radius_mm)
        return bad("one is " + distance_text(out, 4) + " off the circle through the others");
      const double w = r.angle(a, p);
      if (w <= last || w >= sweep) return bad("they are not in order along the arc");
      last = w;
      if (auto even = check_rise(i, w / sweep); !even) return fail(even.error());
    }
    if (o_.helix && dot(r.axis, o_.axis) < 0.0) {
      r.axis = -1.0 * r.axis;
      sweep = -sweep;
    }
    return Segment{from_, to_, true, r.centre, r.axis, sweep};
  }

 private:
  // Nothing when the points are no line; else whether b lies between the others.
  [[nodiscard]] std::optional<bool> between(Vec3 a, Vec3 b, Vec3 c) const {
    const double length = norm(c - a);
    if (!(length > o_.coincident_mm))
      return norm(b - a) <= o_.coincident_mm ? std::optional(false) : std::nullopt;
    const Vec3 along = (1.0 / length) * (c - a);
    const double t = dot(b - a, along);
    if (norm(b - a - t * along) > o_.coincident_mm) return std::nullopt;
    return t > 0.0 && t < length;
  }

  Result<Segment> all_between(Vec3 a, const std::vector<Vec3>& points, Vec3 c) const {
    for (const Vec3 p : points) {
      if (!between(a, p, c).value_or(false)) return bad("some lie on a line and others do not");
    }
    return straight(from_, to_);
  }

  // A helix rises evenly with its angle.
  [[nodiscard]] Status check_rise(std::size_t i, double t) const {
    if (!o_.helix) return {};
    const double rise = dot(to_ - from_, o_.axis), here = dot(via_[i] - from_, o_.axis);
    if (std::abs(here - t * rise) <= o_.radius_mm) return {};
    return bad("a helix does not rise evenly: one is " + distance_text(here - t * rise, 4) +
               " off its height");
  }

  const ViaOptions& o_;
  Vec3 from_, to_;
  std::vector<Vec3> via_;
};

}  // namespace

Result<Segment> arc_through(Vec3 from, std::span<const Vec3> via, Vec3 to, const ViaOptions& options) {
  return Through(from, via, to, options).run();
}

std::size_t degenerate_via_points(model::Model& m, model::Ref<model::Polyline> at, double uncertainty_mm) {
  auto items = m.at<model::Polyline>(at).points.items;
  const auto via = [&](std::size_t i) {
    return items[i].type == model::TypeId::kViaArcPoint || items[i].type == model::TypeId::kViaHelixPoint;
  };
  const auto near = [&](std::size_t i, std::size_t j) {
    const auto p = model::point(m, model::Ref<model::CartesianPoint>(items[i]));
    const auto q = model::point(m, model::Ref<model::CartesianPoint>(items[j]));
    return p && q && norm(*p - *q) <= uncertainty_mm;
  };
  std::size_t count = 0;
  const auto look = [&](std::size_t i, std::size_t neighbour) {
    if (!via(i) || items[i] == items[neighbour] || !near(i, neighbour)) return;
    items[i] = items[neighbour];
    ++count;
  };
  // Ordinary neighbours first: what is left in between coincides with another via point, and says the same.
  for (std::size_t i = 1; i + 1 < items.size(); ++i) {
    if (!via(i - 1)) look(i, i - 1);
  }
  for (std::size_t i = items.size(); i-- > 2;) {
    if (!via(i)) look(i - 1, i);
  }
  for (std::size_t i = 1; i + 1 < items.size(); ++i) look(i, i - 1);
  if (count != 0) m.at<model::Polyline>(at).points.items = std::move(items);
  return count;
}

std::size_t via_count(double sweep) { return std::abs(sweep) > kRadPerTurn - 1e-9 ? 2 : 1; }

}  // namespace capstan::exchange::curves

#include "planner/proof/verify/sweep/target/corners.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

// Inside corners. What a mill of radius r leaves there is the area without its opening by a disc of that
// radius (Serra, Image Analysis and Mathematical Morphology, 1982), within the distance r / tan(a / 2) of the
// corner, a its angle: elsewhere the opening lacks what the mill does not enter, and that is no corner.

namespace capstan::verify {

using geometry::Loop;
using geometry::Region;
using geometry::Vec2;

namespace {

constexpr double kSharpRad = 20.0 / 180.0 * std::numbers::pi;  ///< arcs are drawn by smaller turns
constexpr double kWidestRad = 150.0 / 180.0 * std::numbers::pi;
/// Points of an arc that is narrower than the mill are nearer together, by the mill's radius: chords of 45
/// degrees. Default, unsourced.
constexpr double kOfOneArc = 0.77;
constexpr double kBesideMm = 0.05;  ///< as left.cpp looks beside a wall; default, unsourced
constexpr double kChord = 0.001;
constexpr double kSameMm = 1e-3;  ///< of radii in a record; default, unsourced

/// A corner of a loop: the points before, at and after it, and its turn.
struct Corner {
  Vec2 before, from, to, after;
  double turn_rad = 0.0;
};

double turn_at(const Loop& loop, std::size_t i) {
  const std::size_t n = loop.size();
  const Vec2 in = loop[i] - loop[(i + n - 1) % n], on = loop[(i + 1) % n] - loop[i];
  return std::atan2(cross(in, on), dot(in, on));
}

std::vector<Corner> corners_of(const Loop& loop, double radius, bool rounded) {
  const std::size_t n = loop.size();
  std::vector<Corner> out;
  // Whether a point and the next one belong to one arc that the mill does not enter.
  const auto joined = [&](std::size_t i) {
    return rounded && norm(loop[(i + 1) % n] - loop[i % n]) < kOfOneArc * radius &&
           turn_at(loop, i % n) > 0.0 && turn_at(loop, (i + 1) % n) > 0.0;
  };
  std::size_t begin = 0;
  while (begin < n && joined(begin + n - 1))
    ++begin;  // all of it: a circle that no mill enters has no corner
  for (std::size_t i = begin; begin < n && i < begin + n;) {
    std::size_t last = i;
    double turn = turn_at(loop, i % n);
    while (last + 1 < begin + n && joined(last)) turn += turn_at(loop, ++last % n);
    if (turn >= kSharpRad)
      out.push_back({loop[(i + n - 1) % n], loop[i % n], loop[last % n], loop[(last + 1) % n], turn});
    i = last + 1;
  }
  return out;
}

/// Where the walls beside a corner would meet.
Vec2 apex_of(const Corner& c) {
  const Vec2 in = c.from - c.before, on = c.after - c.to, across = c.to - c.from;
  const double side = cross(in, on);
  if (c.turn_rad >= kWidestRad || std::abs(side) < 1e-12) return 0.5 * (c.from + c.to);
  return c.from + (cross(across, on) / side) * in;
}

/// The narrowest mill of a form, of a surface the last ball: of a feature with one form only its steps
/// tell, of others the widest is taken.
double mill_of(const PartShapes& part, const volumes::Form& form, const Asked& a) {
  if (form.kind == model::ShapeKind::kFreeform) return a.ball_mm;
  const PartShapes::Entry* e = part.find(a.feature);
  return e != nullptr && e->shapes.size() == 1 ? a.radius_mm : a.widest_mm;
}

bool states_corners(const volumes::Form& f) {
  return f.corner_radius_mm > 0.0 || f.corner_stated || f.kind == model::ShapeKind::kSlot;
}

}  // namespace

Region in_corners(const Region& area, const Region& open, double radius_mm, double more_mm, bool rounded) {
  Region discs;
  for (const Loop& loop : area.loops) {
    for (const Corner& c : corners_of(loop, radius_mm, rounded)) {
      const auto opens = [&](Vec2 from, Vec2 to) {
        const Vec2 d = to - from, p = 0.5 * (from + to);
        return norm(d) > 1e-6 && geometry::contains(open, p + (kBesideMm / norm(d)) * Vec2{d.y, -d.x});
      };
      if (!open.empty() && (opens(c.before, c.from) || opens(c.to, c.after))) continue;
      const double half =
          0.5 * (std::numbers::pi - (rounded ? std::min(c.turn_rad, kWidestRad) : c.turn_rad));
      const double reach = radius_mm / std::max(std::tan(half), 1e-3) + more_mm;
      discs = geometry::unite(discs, geometry::disc(apex_of(c), reach, 0.01));
    }
  }
  if (discs.empty()) return discs;
  // A slot may be just as wide as its mill: rounding must not close it.
  const double r = rounded ? radius_mm - 2.0 * kChord : radius_mm, chord = rounded ? kChord : 0.01;
  const Region reached = geometry::offset(geometry::offset(area, -r, chord), r, chord);
  const Region missed = geometry::subtract(area, reached);
  return geometry::intersect(geometry::offset(missed, more_mm, 0.01), discs);
}

std::optional<model::CornerRest> recorded_rest(const model::Plan& plan, const PartShapes& part,
                                               const volumes::Form& form, const Asked& asked) {
  auto r = model::corner_rest_of(plan, form.name);
  if (r) r->radius_mm = std::min(r->radius_mm, mill_of(part, form, asked));
  return r;
}

void check_corner_records(const model::Plan& plan, const PartShapes& part, const std::vector<Asked>& asked,
                          bool partly, Findings& out) {
  for (const model::CornerRest& r : model::corner_rests(plan)) {
    const std::string says = "the plan records that a radius of " + plain(r.radius_mm) +
                             " mm stays in the corners of '" + r.feature + "' in place of " +
                             plain(r.stated_mm) + " mm, ";
    bool found = false;
    if (!(r.stated_mm >= 0.0) || !(r.radius_mm > r.stated_mm) || !std::isfinite(r.radius_mm))
      out.error(36, "CHK-REST-RECORD", {Findings::kWhole, "", -1},
                says + "which is no wider radius than that: remove the record, or plan again");
    for (const Asked& a : asked) {
      const PartShapes::Entry* e = part.find(a.feature);
      if (e == nullptr) continue;
      for (const volumes::Form& f : e->shapes) {
        if (f.name != r.feature) continue;
        found = true;
        if (const double mill = mill_of(part, f, a); r.radius_mm > mill + kSameMm)
          out.error(36, "CHK-REST-RECORD", a.where,
                    says + "and the mills of its steps leave " + plain(mill) +
                        " mm: the record is not what planning wrote; plan the feature again");
        if (states_corners(f) && std::abs(r.stated_mm - f.corner_radius_mm) > kSameMm)
          out.error(36, "CHK-REST-RECORD", a.where,
                    says + "and the feature states " + plain(f.corner_radius_mm) +
                        " mm: the record is of another feature, or this one was changed; plan it again");
      }
    }
    if (!found && !partly)
      out.error(36, "CHK-REST-RECORD", {Findings::kWhole, "", -1},
                says + "and no feature of that name is made: remove the record, or plan again");
  }
}

}  // namespace capstan::verify

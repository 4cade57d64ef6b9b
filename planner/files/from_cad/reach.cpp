#include "planner/files/from_cad/reach.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "planner/ground/base/number.h"
#include "planner/ground/geometry/region.h"

namespace capstan::from_cad {
namespace {

using exchange::Carrier;
using recognise::kSameAngleRad;

/// Of the area of a feature so much may be out of reach by rounding.
constexpr double kOutOfReach = 1e-3;

bool along(Vec3 a, Vec3 b) { return norm(a - b) < kSameAngleRad; }
bool across(Vec3 a, Vec3 b) { return std::abs(dot(a, b)) < kSameAngleRad; }

std::vector<Vec3> directions(const Part& part, const recognise::Feature& feature) {
  std::vector<Vec3> out;
  const auto add = [&](Vec3 d) {
    if (norm(d) > 0.5 && std::none_of(out.begin(), out.end(), [&](Vec3 k) { return along(k, d); }))
      out.push_back(d);
  };
  add(feature.access);
  for (const recognise::Alternative& a : feature.alternatives) add(a.access);
  if (feature.through) add(-1.0 * feature.access);
  for (const std::uint32_t f : feature.faces) {
    const exchange::Face& face = part.brep().faces[f];
    if (face.carrier == Carrier::kPlane) add(normal_of(face));
    if (face.carrier == Carrier::kCylinder) {
      add(face.axis);
      add(-1.0 * face.axis);
    }
  }
  return out;
}

/// Walls that lean more are floors. Default, unsourced: drafts are of 1 to 10 degrees.
constexpr double kMostSlopeRad = 25.0 * std::numbers::pi / 180.0;

/// By how much a wall leans outwards, rad; nothing: it is none, or upright.
std::optional<double> lean_of(const exchange::Face& face, Vec3 access) {
  double lean = 0.0;
  if (face.carrier == Carrier::kPlane) lean = std::asin(std::clamp(dot(normal_of(face), access), -1.0, 1.0));
  if (face.carrier == Carrier::kCone && !face.outward && along(face.axis, access)) lean = face.half_angle;
  if (lean < kSameAngleRad || lean > kMostSlopeRad) return std::nullopt;
  return lean;
}

/// The way along a direction, if all faces are floors, walls of one slope, or fillets between them.
std::optional<Way> seen_along(const Part& part, const recognise::Feature& feature, Vec3 access) {
  Way way;
  way.frame = Part::frame_along(access);
  std::vector<std::uint32_t> walls;
  for (const std::uint32_t f : feature.faces) {
    const exchange::Face& face = part.brep().faces[f];
    if (const auto lean = lean_of(face, access)) {
      if (way.slope_rad > 0.0 && std::abs(way.slope_rad - *lean) > kSameAngleRad) return std::nullopt;
      way.slope_rad = *lean;
      continue;
    }
    switch (face.carrier) {
      case Carrier::kPlane:
        if (along(normal_of(face), access)) {
          const double z = part.span(way.frame, {f}).first;
          const bool known = std::any_of(way.levels_mm.begin(), way.levels_mm.end(),
                                         [&](double k) { return std::abs(k - z) < kLevelMm; });
          if (!known) way.levels_mm.push_back(z);
        } else if (across(normal_of(face), access)) {
          walls.push_back(f);
        } else {
          return std::nullopt;
        }
        break;
      case Carrier::kCylinder:
      case Carrier::kTorus:
      case Carrier::kSphere: {
        if (face.carrier == Carrier::kCylinder && norm(cross(face.axis, access)) < kSameAngleRad) {
          walls.push_back(f);
          break;
        }
        const double r = face.carrier == Carrier::kTorus ? face.minor_radius : face.radius;
        const bool other = !way.blends.empty() && std::abs(r - way.blend_radius_mm) > kLevelMm;
        if (face.outward || other) return std::nullopt;
        way.blends.push_back(f);
        way.blend_radius_mm = r;
        break;
      }
      default:
        return std::nullopt;
    }
  }
  if (way.slope_rad > 0.0 && (way.levels_mm.size() != 1 || !walls.empty() || !way.blends.empty()))
    return std::nullopt;
  if (way.levels_mm.empty()) {
    if (!way.blends.empty() || walls.empty()) return std::nullopt;
    way.levels_mm.push_back(part.span(way.frame, walls).first);
    way.no_floor = true;
  }
  std::sort(way.levels_mm.begin(), way.levels_mm.end());
  return way;
}

/// Whether fillets meet in a sharp edge that is no mitre of two straight walls, with a corner of 60 degrees
/// or more between them: what a cutter leaves that goes straight past the corner.
bool creased(const Part& part, const Way& way) {
  const auto& faces = part.brep().faces;
  const auto is_blend = [&](std::uint32_t f) {
    return std::binary_search(way.blends.begin(), way.blends.end(), f);
  };
  return std::any_of(part.brep().edges.begin(), part.brep().edges.end(), [&](const exchange::Edge& e) {
    if (e.convexity != exchange::Convexity::kConvex || !is_blend(e.face[0]) || !is_blend(e.face[1]))
      return false;
    const bool straight = std::all_of(e.face.begin(), e.face.end(), [&](std::uint32_t f) {
      return faces[f].carrier == Carrier::kCylinder && across(faces[f].axis, way.frame.z);
    });
    const Vec3 run = way.frame.to_local(e.end) - way.frame.to_local(e.start);
    return !straight || norm(xy(run)) > geometry::kMitreLimit * way.blend_radius_mm + kLevelMm;
  });
}

/// How much of a feature no tool along the way comes to, mm2, and of how much.
std::pair<double, double> out_of_reach(const Part& part, const recognise::Feature& feature, const Way& way) {
  double missed = 0.0;
  double all = 0.0;
  for (const std::uint32_t f : feature.faces) {
    if (std::binary_search(way.blends.begin(), way.blends.end(), f)) continue;
    for (const Part::Spot& s : part.spots(f)) {
      const bool floor = dot(s.normal, way.frame.z) > 0.5;
      const Vec3 at = way.frame.to_local(floor ? s.at : s.at + kInFrontMm * s.normal);
      // The floor that it belongs to: the highest that is not above it.
      double level = way.levels_mm.front();
      for (const double z : way.levels_mm) {
        if (z < at.z + kLevelMm) level = z;
      }
      if (at.z < level - kLevelMm) continue;  // a wall that goes on below, into what is deeper
      all += s.area_mm2;
      // In front of a wall there is room down to its floor, or to a higher one, or the outside of the raw
      // piece.
      const auto reached = [&](const Cleared& c) {
        return room_at(c, xy(at)) >= 0 || (!floor && !geometry::contains(c.raw, xy(at)));
      };
      if (reached(part.cleared(way.frame, level, way.blends))) continue;
      if (floor || !reached(part.cleared(way.frame, at.z, way.blends))) missed += s.area_mm2;
    }
  }
  return {missed, all};
}

/// Depth of the lowest floor below the raw piece's surface, mm.
double depth(const Part& part, const Way& way) {
  return part.raw_span(way.frame).second - way.levels_mm.front();
}

/// The ways along the raw piece's sides along which all of the faces are walls, no deeper than the first way:
/// a bevelled corner of a plate is milled from above as well as square to its plane.
std::vector<Way> as_walls(const Part& part, const recognise::Feature& feature,
                          const std::vector<Way>& known) {
  std::vector<Way> out;
  if (known.empty()) return out;
  for (const double sign : {1.0, -1.0}) {
    for (const Vec3 axis : {Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}}) {
      const Vec3 d = sign * axis;
      if (std::any_of(known.begin(), known.end(), [&](const Way& w) { return along(w.frame.z, d); }))
        continue;
      const auto way = seen_along(part, feature, d);
      if (!way || depth(part, *way) > depth(part, known.front()) + kLevelMm) continue;
      const auto [missed, all] = out_of_reach(part, feature, *way);
      if (missed <= kOutOfReach * all) out.push_back(*way);
    }
  }
  return out;
}

std::string words(Vec3 d) {
  return "(" + trimmed(d.x, 3) + ", " + trimmed(d.y, 3) + ", " + trimmed(d.z, 3) + ")";
}

}  // namespace

std::vector<Way> ways_of(const Part& part, const recognise::Feature& feature, std::string& why) {
  std::vector<Way> out;
  for (const Vec3 d : directions(part, feature)) {
    auto way = seen_along(part, feature, d);
    if (!way) continue;
    if (creased(part, *way)) {
      if (why.empty())
        why =
            "the fillets at its floor meet in sharp creases that are no mitres of straight walls with a "
            "corner "
            "of 60 degrees or more; a mill rolls round these";
      continue;
    }
    const auto [missed, all] = out_of_reach(part, feature, *way);
    if (missed <= kOutOfReach * all) {
      out.push_back(*std::move(way));
    } else if (why.empty()) {
      why = "a tool along " + words(way->frame.z) + " does not reach " + trimmed(missed, 2) + " of its " +
            trimmed(all, 2) + " mm2: the part itself stands above";
    }
  }
  for (const Way& way : as_walls(part, feature, out)) out.push_back(way);
  if (out.empty() && why.empty())
    why =
        "along no direction are all of its faces floors, upright walls, or fillets of one radius between "
        "them";
  return out;
}

}  // namespace capstan::from_cad

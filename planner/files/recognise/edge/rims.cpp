#include "planner/files/recognise/edge/rims.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <optional>

// A rim is found by its neighbours: each of its strips (an oblique plane, a cone about the direction; a
// cylinder across it, a torus about it, a ball where corners are as round as the edge) meets a plane that
// looks along the direction at the upper end and upright walls at the lower, by edges that are convex, or
// smooth where it is a round. Strips that meet end to end are one rim: first those that go round; then
// chamfers of several strips that other features interrupt. Rounds that do not go round are left to the other
// rules, for which they are corners of an outline. Source: derived.

namespace capstan::recognise {
namespace {

using exchange::Carrier;
using exchange::Convexity;
using geometry::dot;

/// Planes and cones that lean less against the floor or the wall are none of a rim. Default, unsourced:
/// chamfers are of 30 to 60 degrees.
constexpr double kLeastLeanRad = 5.0 * std::numbers::pi / 180.0;

/// What a patch would be as a part of a rim: as high as all of it, at one slope.
struct Strip {
  bool round = false;
  double lo = 0.0, hi = 0.0;  ///< along the direction, mm
  double angle_rad = 0.0;     ///< of a chamfer against the plane above

  [[nodiscard]] bool meets(const Strip& o) const {
    return round == o.round && std::abs(lo - o.lo) < kSameLengthMm && std::abs(hi - o.hi) < kSameLengthMm &&
           std::abs(angle_rad - o.angle_rad) < kSameAngleRad;
  }
};

std::optional<Strip> strip_of(const Context& context, std::uint32_t index, Direction3 access) {
  const Patch& p = context.graph.patches[index];
  Strip out;
  switch (p.carrier) {
    case Carrier::kPlane:
      out.angle_rad = std::acos(std::clamp(dot(p.axis, access), -1.0, 1.0));
      break;
    case Carrier::kCone:
      // A boss narrows upwards, a hole widens.
      if (!parallel(p.axis, access) || (dot(p.axis, access) > 0.0) == p.outward) return std::nullopt;
      out.angle_rad = 0.5 * std::numbers::pi - p.half_angle;
      break;
    case Carrier::kCylinder:
      out.round = p.outward && perpendicular(p.axis, access);
      break;
    case Carrier::kTorus:
      out.round = p.outward && parallel(p.axis, access);
      break;
    case Carrier::kSphere:
      out.round = p.outward;
      break;
    default:
      return std::nullopt;
  }
  const bool leans = out.angle_rad > kLeastLeanRad && out.angle_rad < 0.5 * std::numbers::pi - kLeastLeanRad;
  if (out.round == leans) return std::nullopt;
  const Extent extent = extent_along(context, {index}, access);
  out.lo = extent.lo;
  out.hi = extent.hi;
  const double radius = p.carrier == Carrier::kTorus ? p.minor_radius : p.radius;
  if (out.round && std::abs(extent.length() - radius) > kSameLengthMm) return std::nullopt;
  return out;
}

/// Whether all of some edges lie at one height.
bool all_at(const Context& context, const std::vector<std::uint32_t>& edges, Direction3 access, double mm) {
  return std::all_of(edges.begin(), edges.end(), [&](std::uint32_t e) {
    const exchange::Edge& edge = context.brep.edges[e];
    return std::abs(dot(edge.start, access) - mm) < kSameLengthMm &&
           std::abs(dot(edge.middle, access) - mm) < kSameLengthMm &&
           std::abs(dot(edge.end, access) - mm) < kSameLengthMm;
  });
}

/// The rims that are seen from one direction.
class Rims {
 public:
  Rims(const Context& context, const std::vector<bool>& taken, Direction3 access)
      : context_(context), access_(access), strips_(context.graph.patches.size()) {
    for (std::uint32_t p = 0; p < strips_.size(); ++p) {
      if (!taken[p]) strips_[p] = strip_of(context, p, access);
    }
  }

  /// The rims that go round; with `interrupted` those of several strips that do not, too.
  std::vector<std::vector<std::uint32_t>> find(bool interrupted) {
    // A strip with another neighbour than a rim has is none; nor, where rims go round, one with an end in the
    // open: then those that met it have an end in the open.
    std::vector<std::uint32_t> open(strips_.size());
    std::iota(open.begin(), open.end(), 0U);
    while (!open.empty()) {
      const std::uint32_t p = open.back();
      open.pop_back();
      if (!strips_[p] || fits(p, interrupted)) continue;
      strips_[p].reset();
      for (const std::uint32_t i : context_.graph.patches[p].joins)
        open.push_back(context_.graph.joins[i].other(p));
    }
    Groups groups(strips_.size());
    for (const Join& j : context_.graph.joins) {
      if (strips_[j.a] && strips_[j.b] && strips_[j.a]->meets(*strips_[j.b])) groups.join(j.a, j.b);
    }
    auto out = groups.members([&](std::uint32_t p) { return strips_[p].has_value(); });
    if (interrupted) std::erase_if(out, [](const auto& patches) { return patches.size() < 2; });
    return out;
  }

  [[nodiscard]] Feature feature(const std::vector<std::uint32_t>& patches) const {
    const Strip& s = *strips_[patches.front()];
    Feature out;
    out.rim = true;
    out.access = access_;
    out.faces = faces_of(context_.graph, patches);
    if (s.round) {
      out.type = TypeId::kEdgeRound;
      out.parameters = {{"radius", s.hi - s.lo}};
      out.reason = "one round all along an edge, between walls and the plane above them";
    } else {
      out.type = TypeId::kChamfer;
      out.parameters = {{"width", (s.hi - s.lo) / std::tan(s.angle_rad)}, {"angle_to_plane", s.angle_rad}};
      out.reason = "one bevel all along an edge, between walls and the plane above them";
    }
    return out;
  }

 private:
  /// Whether a strip has a plane above and walls below. `interrupted`: its ends may be edges to anything;
  /// else nothing but strips that go on.
  [[nodiscard]] bool fits(std::uint32_t p, bool interrupted) const {
    const Strip& s = *strips_[p];
    const Convexity meets = s.round ? Convexity::kSmooth : Convexity::kConvex;
    // A ball at a corner meets the plane at its pole alone.
    const bool ball = context_.graph.patches[p].carrier == Carrier::kSphere;
    bool above = ball;
    bool below = false;
    std::size_t ends = 0;
    for (const std::uint32_t i : context_.graph.patches[p].joins) {
      const Join& j = context_.graph.joins[i];
      const std::uint32_t o = j.other(p);
      if (j.convexity == Convexity::kConcave) return false;
      if (strips_[o] && strips_[o]->meets(s)) {
        ends += j.edges.size();
        continue;
      }
      const Patch& other = context_.graph.patches[o];
      if (all_at(context_, j.edges, access_, s.hi)) {
        above =
            j.convexity == meets && other.carrier == Carrier::kPlane && same_direction(other.axis, access_);
        if (!above) return false;
      } else if (all_at(context_, j.edges, access_, s.lo)) {
        below = j.convexity == meets &&
                (other.carrier == Carrier::kPlane
                     ? perpendicular(other.axis, access_)
                     : other.carrier == Carrier::kCylinder && parallel(other.axis, access_));
        if (!below) return false;
      } else if (!interrupted) {
        return false;
      }
    }
    return above && below && (interrupted ? !s.round : ends == 2 || (ends == 0 && !ball));
  }

  const Context& context_;
  Direction3 access_;
  std::vector<std::optional<Strip>> strips_;
};

}  // namespace

std::vector<Feature> take_rims(const Context& context, std::vector<bool>& taken) {
  std::vector<Feature> out;
  for (const bool interrupted : {false, true}) {
    for (const Direction3 axis : context.raw.axis) {
      for (const Direction3 access : {axis, -1.0 * axis}) {
        Rims rims(context, taken, access);
        for (const auto& patches : rims.find(interrupted)) {
          out.push_back(rims.feature(patches));
          for (const std::uint32_t p : patches) taken[p] = true;
        }
      }
    }
  }
  return out;
}

}  // namespace capstan::recognise

#include "planner/files/recognise/rings.h"

#include <algorithm>
#include <map>
#include <numbers>
#include <set>

namespace capstan::recognise {
namespace {

using exchange::Carrier;
using geometry::cross;
using geometry::dot;

/// A point of an edge without its height: edges that lie above each other are one place.
Point3 place_of(const exchange::Edge& edge, Direction3 access) {
  return edge.middle - dot(edge.middle, access) * access;
}

/// Whether every side meets others at two places: its two neighbours, or one of them twice.
bool meets_at_both_ends(const Context& context, const std::vector<std::vector<std::uint32_t>>& sides,
                        Direction3 access, bool over_convex_edges) {
  std::map<std::uint32_t, std::size_t> of_patch;
  for (std::size_t s = 0; s < sides.size(); ++s) {
    for (const std::uint32_t p : sides[s]) of_patch[p] = s;
  }
  for (std::size_t s = 0; s < sides.size(); ++s) {
    std::vector<Point3> places;
    for (const std::uint32_t p : sides[s]) {
      for (const std::uint32_t j : context.graph.patches[p].joins) {
        const Join& join = context.graph.joins[j];
        const auto other = of_patch.find(join.other(p));
        if (other == of_patch.end() || other->second == s) continue;
        if (join.convexity == exchange::Convexity::kConvex && !over_convex_edges) continue;
        for (const std::uint32_t e : join.edges) {
          const Point3 at = place_of(context.brep.edges[e], access);
          if (std::none_of(places.begin(), places.end(),
                           [&](Point3 q) { return geometry::norm(q - at) < kSameLengthMm; })) {
            places.push_back(at);
          }
        }
      }
    }
    if (places.size() < 2) return false;
  }
  return true;
}

/// Whether sides run all round. A wall that another feature cut in two is one wall where its ends are
/// concave; where slots cross at one depth, the walls between two corners are convex there, and each piece
/// must run on by itself.
bool closed(const Context& context, const std::vector<Surface>& sides, Direction3 access) {
  if (sides.size() == 1) {
    const Patch& only = context.graph.patches[sides[0].first];
    return only.carrier != Carrier::kPlane && runs_round(context, only);
  }
  std::vector<std::vector<std::uint32_t>> surfaces;
  std::vector<std::vector<std::uint32_t>> pieces;
  for (const Surface& s : sides) {
    surfaces.push_back(s.patches);
    for (const std::uint32_t p : s.patches) pieces.push_back({p});
  }
  return meets_at_both_ends(context, surfaces, access, false) ||
         meets_at_both_ends(context, pieces, access, true);
}

/// Whether the material is inside of a closed ring: its sides look away from the middle of it.
bool is_island(const Context& context, const std::vector<Surface>& sides) {
  if (sides.size() == 1) return context.graph.patches[sides[0].first].outward;
  Point3 middle{};
  double area = 0.0;
  std::vector<std::pair<const Patch*, Point3>> places;
  for (const Surface& s : sides) {
    for (const std::uint32_t p : s.patches) {
      const Patch& patch = context.graph.patches[p];
      Point3 centre{};
      double corners = 0.0;
      for (const std::uint32_t f : patch.faces) {
        for (const exchange::Loop& loop : context.brep.faces[f].loops) {
          for (const std::uint32_t e : loop.edges) {
            centre = centre + context.brep.edges[e].length * context.brep.edges[e].middle;
            corners += context.brep.edges[e].length;
          }
        }
      }
      if (corners > 0.0) centre = (1.0 / corners) * centre;
      middle = middle + patch.area * centre;
      area += patch.area;
      places.emplace_back(&patch, centre);
    }
  }
  if (area > 0.0) middle = (1.0 / area) * middle;
  double outwards = 0.0;
  for (const auto& [patch, centre] : places) {
    if (patch->carrier == Carrier::kPlane) outwards += patch->area * dot(patch->axis, centre - middle);
  }
  if (outwards != 0.0) return outwards > 0.0;
  return std::all_of(places.begin(), places.end(), [](const auto& place) { return place.first->outward; });
}

/// Whether a patch reaches its own axis: a cone with its apex.
bool reaches_axis(const Context& context, const Patch& p) {
  const auto on_axis = [&](Point3 q) { return geometry::norm(cross(q - p.point, p.axis)) < kSameLengthMm; };
  for (const std::uint32_t f : p.faces) {
    for (const exchange::Loop& loop : context.brep.faces[f].loops) {
      for (const std::uint32_t e : loop.edges) {
        if (on_axis(context.brep.edges[e].start) || on_axis(context.brep.edges[e].end)) return true;
      }
    }
  }
  return false;
}

/// Whether the boundary of a patch turns about its axis once at every end that it has, whatever curves it
/// ends in.
bool turns_at_its_ends(const Context& context, const Patch& p) {
  const Direction3 x = geometry::normalised(std::abs(p.axis.x) < 0.7 ? cross(p.axis, Direction3{1, 0, 0})
                                                                     : cross(p.axis, Direction3{0, 1, 0}));
  const Direction3 y = cross(p.axis, x);
  const auto angle = [&](Point3 q) { return std::atan2(dot(q - p.point, y), dot(q - p.point, x)); };
  const auto turn = [](double from, double to) {
    return std::abs(std::remainder(to - from, 2.0 * std::numbers::pi));
  };
  double total = 0.0;
  for (const std::uint32_t j : p.joins) {
    for (const std::uint32_t e : context.graph.joins[j].edges) {
      const exchange::Edge& edge = context.brep.edges[e];
      const double middle = angle(edge.middle);
      total += turn(angle(edge.start), middle) + turn(middle, angle(edge.end));
    }
  }
  const int ends = p.carrier == Carrier::kCone && reaches_axis(context, p) ? 1 : 2;
  return total > 2.0 * ends * std::numbers::pi - 1e-3;
}

}  // namespace

bool runs_round(const Context& context, const Patch& p) {
  std::vector<std::pair<double, double>> turned;  // height, angle
  for (const std::uint32_t f : p.faces) {
    for (const exchange::Loop& loop : context.brep.faces[f].loops) {
      for (const std::uint32_t e : loop.edges) {
        const exchange::Edge& edge = context.brep.edges[e];
        if (edge.curve != exchange::Curve::kCircle || edge.radius < kSameLengthMm) continue;
        if (!parallel(edge.axis, p.axis)) continue;
        if (geometry::norm(cross(edge.centre - p.point, p.axis)) > kSameLengthMm) continue;
        const double height = dot(edge.centre - p.point, p.axis);
        const double angle = edge.length / edge.radius;
        const auto same = std::find_if(turned.begin(), turned.end(), [&](const auto& t) {
          return std::abs(t.first - height) < kSameLengthMm;
        });
        if (same == turned.end()) {
          turned.emplace_back(height, angle);
        } else {
          same->second += angle;
        }
      }
    }
  }
  // Lengths of arcs come from integrals: a millirad is far from the next arc that could be missing.
  return std::any_of(turned.begin(), turned.end(),
                     [](const auto& t) { return t.second > 2.0 * std::numbers::pi - 1e-3; }) ||
         turns_at_its_ends(context, p);
}

std::vector<Ring> rings_of(const Context& context, const std::vector<Surface>& sides, Direction3 access) {
  std::map<std::uint32_t, std::uint32_t> of_patch;
  for (std::uint32_t s = 0; s < sides.size(); ++s) {
    for (const std::uint32_t p : sides[s].patches) of_patch[p] = s;
  }
  Groups groups(sides.size());
  for (const auto& [patch, side] : of_patch) {
    for (const std::uint32_t j : context.graph.patches[patch].joins) {
      const auto other = of_patch.find(context.graph.joins[j].other(patch));
      if (other != of_patch.end()) groups.join(side, other->second);
    }
  }
  std::map<std::uint32_t, Ring> by_root;
  for (std::uint32_t s = 0; s < sides.size(); ++s) by_root[groups.root(s)].sides.push_back(sides[s]);
  std::vector<Ring> rings;
  for (auto& [root, ring] : by_root) {
    ring.closed = closed(context, ring.sides, access);
    ring.island = ring.closed && is_island(context, ring.sides);
    rings.push_back(std::move(ring));
  }
  return rings;
}

}  // namespace capstan::recognise

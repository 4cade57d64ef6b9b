#include "planner/files/recognise/view.h"

#include <algorithm>
#include <map>
#include <optional>
#include <tuple>

namespace capstan::recognise {
namespace {

using exchange::Carrier;
using exchange::Convexity;
using geometry::cross;
using geometry::dot;

std::vector<Surface> surfaces_of(const Graph& graph, const std::vector<std::uint32_t>& patches) {
  std::vector<Surface> found;
  for (const std::uint32_t p : patches) {
    const auto same = std::find_if(found.begin(), found.end(), [&](const Surface& s) {
      return same_surface(graph.patches[s.first], graph.patches[p]);
    });
    if (same == found.end()) {
      found.push_back({p, {p}});
    } else {
      same->patches.push_back(p);
    }
  }
  return found;
}

std::optional<View> view_along(const Graph& graph, const std::vector<Surface>& surfaces, Direction3 access,
                               double slope = 0.0) {
  View view;
  view.access = access;
  view.slope = slope;
  for (const Surface& s : surfaces) {
    const Patch& p = graph.patches[s.first];
    switch (p.carrier) {
      case Carrier::kPlane:
        if (same_direction(p.axis, access)) {
          view.floors.push_back(s);
        } else if (std::abs(dot(p.axis, access) - std::sin(slope)) < kSameAngleRad) {
          view.walls.push_back(s);
        } else {
          return std::nullopt;
        }
        break;
      case Carrier::kCylinder:
        (parallel(p.axis, access) ? view.bends : view.blends).push_back(s);
        break;
      case Carrier::kCone:
        // The corner between two drafted walls opens towards the tool.
        if (p.outward || !same_direction(p.axis, access) || std::abs(p.half_angle - slope) > kSameAngleRad) {
          return std::nullopt;
        }
        view.bends.push_back(s);
        break;
      case Carrier::kTorus:
      case Carrier::kSphere:
        view.blends.push_back(s);
        break;
      default:
        return std::nullopt;
    }
  }
  return view;
}

/// Directions that a tool could come from: along the normal of a plane, across two walls, along a cylinder.
std::vector<View> all_views(const Graph& graph, const std::vector<Surface>& surfaces) {
  std::vector<Direction3> directions;
  const auto add = [&](Direction3 d) {
    if (std::none_of(directions.begin(), directions.end(),
                     [&](Direction3 k) { return same_direction(k, d); })) {
      directions.push_back(d);
    }
  };
  for (const Surface& a : surfaces) {
    const Patch& p = graph.patches[a.first];
    if (p.carrier == Carrier::kPlane) add(p.axis);
  }
  for (const Surface& a : surfaces) {
    const Patch& p = graph.patches[a.first];
    if (p.carrier == Carrier::kCylinder) {
      add(p.axis);
      add(-1.0 * p.axis);
    }
    if (p.carrier != Carrier::kPlane) continue;
    for (const Surface& b : surfaces) {
      const Patch& q = graph.patches[b.first];
      if (q.carrier != Carrier::kPlane || parallel(p.axis, q.axis)) continue;
      add(geometry::normalised(cross(p.axis, q.axis)));
    }
  }
  std::vector<View> found;
  for (const Surface& a : surfaces) {
    const Patch& p = graph.patches[a.first];
    if (p.carrier != Carrier::kCone || p.outward) continue;
    if (auto view = view_along(graph, surfaces, p.axis, p.half_angle)) found.push_back(std::move(*view));
    break;
  }
  for (const Direction3 d : directions) {
    if (auto view = view_along(graph, surfaces, d)) found.push_back(std::move(*view));
  }
  return found;
}

/// Smaller is better: along an axis of the raw piece; one floor, then none, then several at different depths;
/// then the shallower.
std::tuple<bool, int, double> rank(const Context& context, const std::vector<std::uint32_t>& patches,
                                   const View& view) {
  const std::size_t floors = view.floors.size();
  return {!along_raw(context.raw, view.access),
          floors == 1   ? 0
          : floors == 0 ? 1
                        : 2,
          extent_along(context, patches, view.access).length()};
}

/// For how long a patch meets what already belongs to a floor, by floor.
std::map<std::size_t, double> met(const Context& context, std::uint32_t patch,
                                  const std::map<std::uint32_t, std::size_t>& floor_of) {
  std::map<std::size_t, double> lengths;
  for (const std::uint32_t j : context.graph.patches[patch].joins) {
    const Join& join = context.graph.joins[j];
    const auto other = floor_of.find(join.other(patch));
    if (other == floor_of.end() || join.convexity == Convexity::kConvex) continue;
    for (const std::uint32_t e : join.edges) lengths[other->second] += context.brep.edges[e].length;
  }
  return lengths;
}

}  // namespace

bool along_raw(const RawBox& raw, Direction3 d) {
  return std::any_of(raw.axis.begin(), raw.axis.end(), [&](Direction3 a) { return parallel(a, d); });
}

std::vector<View> views(const Context& context, const std::vector<std::uint32_t>& patches) {
  std::vector<View> found = all_views(context.graph, surfaces_of(context.graph, patches));
  std::stable_sort(found.begin(), found.end(), [&](const View& a, const View& b) {
    return rank(context, patches, a) < rank(context, patches, b);
  });
  return found;
}

void tell_rings(const Context& context, View& view) {
  std::vector<Surface> sides = view.walls;
  sides.insert(sides.end(), view.bends.begin(), view.bends.end());
  view.walls.clear();
  view.bends.clear();
  for (Ring& ring : rings_of(context, sides, view.access)) {
    if (ring.island) {
      ++view.islands;
      continue;
    }
    view.closed = view.closed || ring.closed;
    for (Surface& s : ring.sides) {
      const bool wall = context.graph.patches[s.first].carrier == Carrier::kPlane;
      (wall ? view.walls : view.bends).push_back(std::move(s));
    }
  }
}

std::vector<std::vector<std::uint32_t>> floors_apart(const Context& context,
                                                     const std::vector<std::uint32_t>& patches) {
  const std::vector<View> found = views(context, patches);
  if (found.empty() || found.front().floors.size() < 2) return {patches};
  const View& view = found.front();
  std::map<std::uint32_t, std::size_t> floor_of;
  for (std::size_t f = 0; f < view.floors.size(); ++f) {
    for (const std::uint32_t p : view.floors[f].patches) floor_of[p] = f;
  }
  // From the floors outwards: what meets them, then what meets that.
  for (;;) {
    std::map<std::uint32_t, std::size_t> next;
    for (const std::uint32_t p : patches) {
      if (floor_of.count(p) != 0) continue;
      const auto lengths = met(context, p, floor_of);
      const auto longest = std::max_element(lengths.begin(), lengths.end(),
                                            [](const auto& a, const auto& b) { return a.second < b.second; });
      if (longest != lengths.end()) next[p] = longest->first;
    }
    if (next.empty()) break;
    floor_of.insert(next.begin(), next.end());
  }
  std::vector<std::vector<std::uint32_t>> parts(view.floors.size());
  std::vector<std::uint32_t> rest;
  for (const std::uint32_t p : patches) {
    const auto floor = floor_of.find(p);
    (floor == floor_of.end() ? rest : parts[floor->second]).push_back(p);
  }
  if (!rest.empty()) parts.push_back(std::move(rest));
  return parts;
}

}  // namespace capstan::recognise

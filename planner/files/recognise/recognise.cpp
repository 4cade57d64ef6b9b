#include "planner/files/recognise/recognise.h"

#include <algorithm>
#include <iterator>
#include <optional>
#include <string>

#include "planner/files/recognise/edge/rims.h"
#include "planner/files/recognise/edge/rounds.h"
#include "planner/files/recognise/graph.h"
#include "planner/files/recognise/holes.h"
#include "planner/files/recognise/interrupted.h"
#include "planner/files/recognise/prismatic.h"
#include "planner/files/recognise/view.h"

namespace capstan::recognise {
namespace {

using exchange::Carrier;
using exchange::Convexity;

/// Whether two patches belong to one feature: they meet at a concave edge, or one is a fillet between them.
bool tied(const Graph& graph, const Join& join) {
  if (join.convexity == Convexity::kConcave) return true;
  const auto fillet = [](const Patch& p) { return p.carrier != Carrier::kPlane && !p.outward; };
  return join.convexity == Convexity::kSmooth &&
         (fillet(graph.patches[join.a]) || fillet(graph.patches[join.b]));
}

/// The patches that are not of the raw piece nor taken, in groups that concave edges and fillets tie
/// together.
std::vector<std::vector<std::uint32_t>> tied_groups(const Graph& graph, const std::vector<bool>& taken) {
  Groups groups(graph.patches.size());
  for (const Join& join : graph.joins) {
    if (!taken[join.a] && !taken[join.b] && tied(graph, join)) groups.join(join.a, join.b);
  }
  return groups.members([&](std::uint32_t p) { return !taken[p]; });
}

std::vector<std::vector<std::uint32_t>> tied_groups(const Graph& graph,
                                                    const std::vector<std::uint32_t>& of) {
  std::vector<bool> taken(graph.patches.size(), true);
  for (const std::uint32_t p : of) taken[p] = false;
  return tied_groups(graph, taken);
}

/// The part of a group that a tool sees from one side: what is a floor, a wall, or a bend or blend between
/// those.
struct Seen {
  std::vector<std::uint32_t> patches;
  double area = 0;
};

/// The largest tied part of a group with a floor that one of the raw piece's axes sees whole.
std::optional<Seen> largest_seen(const Context& context, const std::vector<std::uint32_t>& group) {
  std::optional<Seen> best;
  for (const Direction3 axis : context.raw.axis) {
    for (const Direction3 access : {axis, -1.0 * axis}) {
      std::vector<std::uint32_t> fitting;
      for (const std::uint32_t p : group) {
        const Patch& patch = context.graph.patches[p];
        const bool fits = patch.carrier == Carrier::kPlane
                              ? same_direction(patch.axis, access) || perpendicular(patch.axis, access)
                              : patch.carrier == Carrier::kCylinder && parallel(patch.axis, access);
        if (fits) fitting.push_back(p);
      }
      for (std::vector<std::uint32_t>& part : tied_groups(context.graph, fitting)) {
        Seen seen{std::move(part), 0.0};
        bool floor = false;
        for (const std::uint32_t p : seen.patches) {
          seen.area += context.graph.patches[p].area;
          floor = floor || same_direction(context.graph.patches[p].axis, access);
        }
        if (floor && (!best || seen.area > best->area)) best = std::move(seen);
      }
    }
  }
  return best;
}

/// Whether a tool along `access` comes to every triangle of some patches from outside, by their normals.
bool faces_up(const Context& context, const std::vector<std::uint32_t>& patches, Direction3 access) {
  for (const std::uint32_t p : patches) {
    const Patch& patch = context.graph.patches[p];
    if (patch.carrier == Carrier::kPlane) {
      if (geometry::dot(patch.axis, access) < -kSameAngleRad) return false;
      continue;
    }
    for (const std::uint32_t f : patch.faces) {
      const exchange::Face& face = context.brep.faces[f];
      if (face.triangle_count == 0) return false;  // nothing to judge by
      for (std::uint32_t t = face.first_triangle; t < face.first_triangle + face.triangle_count; ++t) {
        const auto& [a, b, c] = context.brep.triangles[t];
        const auto& points = context.brep.points;
        const Direction3 normal = geometry::cross(points[b] - points[a], points[c] - points[a]);
        // A facet of a wall leans by up to what its chord lets it.
        if (geometry::dot(normal, access) < -0.05 * geometry::norm(normal)) return false;
      }
    }
  }
  return true;
}

/// A surface that an axis of the raw piece reaches: milled as a freeform region.
std::optional<Feature> region(const Context& context, const std::vector<std::uint32_t>& patches) {
  std::vector<Direction3> reached;
  for (const Direction3 axis : context.raw.axis) {
    for (const Direction3 access : {axis, -1.0 * axis}) {
      if (faces_up(context, patches, access)) reached.push_back(access);
    }
  }
  if (reached.empty()) return std::nullopt;
  Feature feature;
  feature.type = TypeId::kRegionSurfaceList;
  feature.access = reached.front();
  feature.faces = faces_of(context.graph, patches);
  feature.parameters.push_back({"depth", extent_along(context, patches, feature.access).length()});
  feature.reason =
      "no walls and floors along one direction, but every point is reached along an axis of the raw piece";
  for (std::size_t i = 1; i < reached.size(); ++i) {
    feature.alternatives.push_back({TypeId::kRegionSurfaceList, reached[i], "from another side"});
  }
  return feature;
}

/// Patches of a group are compared all with all: a larger group, such as a surface in facets, is named and not
/// recognised. Default, unsourced: groups of real parts have some 40, 200 take about a second.
constexpr std::size_t kMostInGroup = 200;

/// Recognises a group of tied patches as one feature, or takes parts off it until the rest is one, or is
/// named.
void recognise_group(const Context& context, const std::vector<std::uint32_t>& group, Recognition& result) {
  std::vector<std::vector<std::uint32_t>> open{group};
  while (!open.empty()) {
    const std::vector<std::uint32_t> patches = std::move(open.back());
    open.pop_back();
    if (patches.size() > kMostInGroup) {
      result.unrecognised.push_back({faces_of(context.graph, patches),
                                     "they hang together in a group of " + std::to_string(patches.size()) +
                                         " surfaces, more than are compared (" +
                                         std::to_string(kMostInGroup) + ")"});
      continue;
    }
    if (auto parts = floors_apart(context, patches); parts.size() > 1) {
      for (auto& part : parts) open.push_back(std::move(part));
      continue;
    }
    auto feature = prismatic(context, patches);
    if (!feature) feature = conical_chamfer(context, patches);
    std::optional<Seen> seen;
    if (!feature) {
      seen = largest_seen(context, patches);
      if (seen && seen->patches.size() < patches.size()) feature = prismatic(context, seen->patches);
      if (!feature) seen.reset();
    }
    if (!feature) feature = region(context, patches);
    if (!feature) {
      result.unrecognised.push_back(
          {faces_of(context.graph, patches), "no axis of the raw piece reaches all of these faces"});
      continue;
    }
    if (seen) {
      feature->reason += "; its other neighbours belong to other directions";
      std::vector<std::uint32_t> rest;
      std::set_difference(patches.begin(), patches.end(), seen->patches.begin(), seen->patches.end(),
                          std::back_inserter(rest));
      for (auto& part : tied_groups(context.graph, rest)) open.push_back(std::move(part));
    }
    result.features.push_back(std::move(*feature));
  }
}

}  // namespace

Recognition recognise(const exchange::Brep& brep, std::size_t body) {
  Recognition result;
  if (body >= brep.bodies.size()) return result;
  Graph graph = make_graph(brep, brep.bodies[body]);
  result.raw = make_raw_box(brep, brep.bodies[body], graph);
  const Context context{brep, graph, result.raw};

  std::vector<bool> taken(graph.patches.size(), false);
  for (std::uint32_t p = 0; p < graph.patches.size(); ++p) {
    if (graph.patches[p].side < 0) continue;
    taken[p] = true;
    result.on_raw.insert(result.on_raw.end(), graph.patches[p].faces.begin(), graph.patches[p].faces.end());
  }
  std::sort(result.on_raw.begin(), result.on_raw.end());

  result.features = take_holes(context, taken);
  for (Feature& rim : take_rims(context, taken)) result.features.push_back(std::move(rim));
  for (Feature& round : take_rounds(context, taken)) result.features.push_back(std::move(round));
  for (const std::vector<std::uint32_t>& patches : tied_groups(graph, taken)) {
    recognise_group(context, patches, result);
  }
  join_interrupted(context, result);
  std::stable_sort(result.features.begin(), result.features.end(),
                   [](const Feature& a, const Feature& b) { return a.faces.front() < b.faces.front(); });
  std::stable_sort(result.unrecognised.begin(), result.unrecognised.end(),
                   [](const Rest& a, const Rest& b) { return a.faces.front() < b.faces.front(); });
  return result;
}

bool is_angle(const Parameter& p) {
  return p.name == "slope" || p.name == "angle" || p.name == "angle_to_plane";
}

std::string faces_in_words(const exchange::Brep& brep, const std::vector<std::uint32_t>& faces) {
  std::string text;
  for (const std::uint32_t f : faces) {
    const std::int64_t id = brep.faces[f].id;
    text += (text.empty() ? "#" : " #") + std::to_string(id != 0 ? id : static_cast<std::int64_t>(f) + 1);
  }
  return text;
}

}  // namespace capstan::recognise

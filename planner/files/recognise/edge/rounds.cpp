#include "planner/files/recognise/edge/rounds.h"

#include <algorithm>
#include <cmath>

namespace capstan::recognise {
namespace {

using exchange::Carrier;
using exchange::Convexity;

double round_radius(const Patch& p) { return p.carrier == Carrier::kTorus ? p.minor_radius : p.radius; }

bool is_round(const Graph& graph, std::uint32_t index) {
  const Patch& p = graph.patches[index];
  const bool curved =
      p.carrier == Carrier::kCylinder || p.carrier == Carrier::kTorus || p.carrier == Carrier::kSphere;
  if (!curved || !p.outward) return false;
  std::size_t tangent = 0;
  for (const std::uint32_t j : p.joins) {
    const Join& join = graph.joins[j];
    if (join.convexity == Convexity::kConcave) return false;
    if (join.convexity != Convexity::kSmooth) continue;
    const Patch& other = graph.patches[join.other(index)];
    if (other.carrier != Carrier::kPlane && !other.outward)
      return false;  // the corner of an island, with a fillet
    tangent += join.edges.size();
  }
  return tangent >= 2 || (tangent == 1 && p.carrier != Carrier::kCylinder);
}

}  // namespace

std::vector<Feature> take_rounds(const Context& context, std::vector<bool>& taken) {
  const Graph& graph = context.graph;
  std::vector<bool> round(graph.patches.size());
  for (std::uint32_t p = 0; p < graph.patches.size(); ++p) round[p] = !taken[p] && is_round(graph, p);
  Groups groups(graph.patches.size());
  for (const Join& join : graph.joins) {
    if (!round[join.a] || !round[join.b]) continue;
    const double a = round_radius(graph.patches[join.a]);
    const double b = round_radius(graph.patches[join.b]);
    if (std::abs(a - b) < kSameLengthMm) groups.join(join.a, join.b);
  }
  std::vector<Feature> found;
  for (const auto& patches : groups.members([&](std::uint32_t p) { return round[p]; })) {
    const Patch& lowest = graph.patches[patches.front()];
    Feature feature;
    feature.type = TypeId::kEdgeRound;
    feature.through = true;
    feature.faces = faces_of(graph, patches);
    feature.access = lowest.axis;
    feature.parameters.push_back({"radius", round_radius(lowest)});
    feature.reason = "tangent to both its neighbours, with the material inside";
    if (lowest.carrier == Carrier::kCylinder) {
      feature.alternatives.push_back(
          {TypeId::kGeneralOutsideProfile, feature.access, "mill it as a part of the outside contour"});
    }
    found.push_back(std::move(feature));
    for (const std::uint32_t p : patches) taken[p] = true;
  }
  return found;
}

std::optional<Feature> conical_chamfer(const Context& context, const std::vector<std::uint32_t>& patches) {
  for (const std::uint32_t p : patches) {
    if (!same_surface(context.graph.patches[p], context.graph.patches[patches.front()])) return std::nullopt;
  }
  const Patch& cone = context.graph.patches[patches.front()];
  if (cone.carrier != Carrier::kCone) return std::nullopt;
  const Extent extent = extent_along(context, patches, cone.axis);
  Feature feature;
  feature.type = TypeId::kChamfer;
  feature.faces = faces_of(context.graph, patches);
  // The tool comes from where a hole widens, or a boss narrows.
  feature.access = cone.outward ? -1.0 * cone.axis : cone.axis;
  feature.parameters = {{"width", extent.length() / std::cos(cone.half_angle)},
                        {"angle_to_plane", cone.half_angle}};
  feature.reason = cone.outward ? "a cone round the edge of a boss" : "a cone round the edge of a hole";
  return feature;
}

}  // namespace capstan::recognise

#include "planner/files/recognise/interrupted.h"

#include <algorithm>
#include <iterator>
#include <optional>

namespace capstan::recognise {
namespace {

bool is_hole(TypeId type) {
  return type == TypeId::kRoundHole || type == TypeId::kCounterboreHole || type == TypeId::kCountersunkHole;
}

/// Patches of each feature, ascending.
std::vector<std::vector<std::uint32_t>> patches_of(const Context& context, const Recognition& found) {
  std::vector<std::uint32_t> of_face(context.brep.faces.size());
  for (std::uint32_t p = 0; p < context.graph.patches.size(); ++p) {
    for (const std::uint32_t f : context.graph.patches[p].faces) of_face[f] = p;
  }
  std::vector<std::vector<std::uint32_t>> patches;
  for (const Feature& feature : found.features) {
    std::vector<std::uint32_t> own;
    for (const std::uint32_t f : feature.faces) own.push_back(of_face[f]);
    std::sort(own.begin(), own.end());
    own.erase(std::unique(own.begin(), own.end()), own.end());
    patches.push_back(std::move(own));
  }
  return patches;
}

/// The features that each feature meets, ascending.
std::vector<std::vector<std::size_t>> neighbours_of(const Context& context,
                                                    const std::vector<std::vector<std::uint32_t>>& patches) {
  const std::size_t none = patches.size();
  std::vector<std::size_t> of_patch(context.graph.patches.size(), none);
  for (std::size_t f = 0; f < patches.size(); ++f) {
    for (const std::uint32_t p : patches[f]) of_patch[p] = f;
  }
  std::vector<std::vector<std::size_t>> met(patches.size());
  for (const Join& join : context.graph.joins) {
    const std::size_t a = of_patch[join.a];
    const std::size_t b = of_patch[join.b];
    if (a == none || b == none || a == b) continue;
    met[a].push_back(b);
    met[b].push_back(a);
  }
  for (auto& list : met) {
    std::sort(list.begin(), list.end());
    list.erase(std::unique(list.begin(), list.end()), list.end());
  }
  return met;
}

bool on_surfaces_of(const Graph& graph, const std::vector<std::uint32_t>& some,
                    const std::vector<std::uint32_t>& others) {
  return std::all_of(some.begin(), some.end(), [&](std::uint32_t p) {
    return std::any_of(others.begin(), others.end(),
                       [&](std::uint32_t q) { return same_surface(graph.patches[p], graph.patches[q]); });
  });
}

/// Two features as one, or nothing where they are not one feature of their kind.
std::optional<Feature> joined(const Context& context, const Feature& a,
                              const std::vector<std::uint32_t>& patches) {
  if (!is_hole(a.type)) {
    auto feature = prismatic(context, patches);
    if (!feature || feature->type != a.type || feature->profile != a.profile) return std::nullopt;
    feature->reason += "; another feature cuts it in two";
    return feature;
  }
  Feature feature = a;
  feature.faces = faces_of(context.graph, patches);
  for (Parameter& p : feature.parameters) {
    if (p.name == "depth") p.value = extent_along(context, patches, a.access).length();
  }
  feature.reason += "; another feature cuts it in two";
  return feature;
}

/// Joins one pair; false where there is none.
bool join_a_pair(const Context& context, Recognition& found) {
  const auto patches = patches_of(context, found);
  const auto met = neighbours_of(context, patches);
  for (std::size_t a = 0; a < patches.size(); ++a) {
    for (std::size_t b = a + 1; b < patches.size(); ++b) {
      const Feature& one = found.features[a];
      const Feature& other = found.features[b];
      if (one.type != other.type || one.profile != other.profile || one.walls != other.walls) continue;
      std::vector<std::size_t> common;
      std::set_intersection(met[a].begin(), met[a].end(), met[b].begin(), met[b].end(),
                            std::back_inserter(common));
      if (common.empty() || !on_surfaces_of(context.graph, patches[a], patches[b]) ||
          !on_surfaces_of(context.graph, patches[b], patches[a])) {
        continue;
      }
      std::vector<std::uint32_t> both;
      std::set_union(patches[a].begin(), patches[a].end(), patches[b].begin(), patches[b].end(),
                     std::back_inserter(both));
      auto feature = joined(context, one, both);
      if (!feature) continue;
      found.features[a] = std::move(*feature);
      found.features.erase(found.features.begin() + static_cast<std::ptrdiff_t>(b));
      return true;
    }
  }
  return false;
}

}  // namespace

void join_interrupted(const Context& context, Recognition& found) {
  while (join_a_pair(context, found)) {
  }
}

}  // namespace capstan::recognise

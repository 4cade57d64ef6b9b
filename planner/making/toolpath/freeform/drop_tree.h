#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "planner/ground/geometry/mesh.h"

namespace capstan::toolpath::freeform {

/// The mesh with vertices at equal coordinates made one; order of first appearance.
[[nodiscard]] geometry::Mesh weld(const geometry::Mesh& mesh);

/// An edge of the mesh, a < b, and the triangles at it.
struct MeshEdge {
  std::uint32_t a = 0, b = 0;
  std::uint32_t count = 0;                  ///< triangles that have it
  std::array<std::uint32_t, 2> triangle{};  ///< the first two
};

struct LeafRange {
  std::uint32_t first = 0, last = 0;  ///< in Tree::order
};

struct TreeNode {
  geometry::Box3 box;
  std::uint32_t left = 0, right = 0;  ///< children; equal: a leaf, and its number
};

/// A plane that no triangle of a node stands above: z <= base_mm + dot(slope, (x, y)).
struct NodePlane {
  geometry::Vec2 slope;
  double base_mm = 0.0;
  bool made = false;  ///< of small nodes that are not upright; of others nothing is known but their box
};

/// So many nodes lie below each other at most, whatever the mesh.
inline constexpr std::size_t kDeepestTree = 100;

/// A tree of boxes over the triangles; each half of a node has an eighth of its triangles or more, but where
/// they face otherwise.
struct Tree {
  std::vector<std::uint32_t> order;  ///< triangles, leaf by leaf
  std::vector<LeafRange> leaves;
  std::vector<TreeNode> nodes;    ///< node 0 is the root; empty for an empty mesh
  std::vector<NodePlane> planes;  ///< of the nodes
  std::vector<MeshEdge> edges;
  std::vector<std::array<std::uint32_t, 3>> edge_of;  ///< per triangle, side i joins corner i and i + 1
};
[[nodiscard]] Tree build_tree(const geometry::Mesh& welded);

/// Which edges a convex cutter coming from above touches never before their facets: exactly two triangles,
/// on either side seen from above, neither upright, that meet in a valley or lie flat. All others count,
/// folds and borders above all.
[[nodiscard]] std::vector<bool> valley_edges(const geometry::Mesh& welded,
                                             const std::vector<MeshEdge>& edges);

}  // namespace capstan::toolpath::freeform

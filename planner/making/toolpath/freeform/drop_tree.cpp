#include "planner/making/toolpath/freeform/drop_tree.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>
#include <tuple>

namespace capstan::toolpath::freeform {
namespace {

using geometry::Box3;
using geometry::Mesh;
using geometry::Vec2;
using geometry::Vec3;

constexpr std::uint32_t kLeafSize = 4;

std::vector<MeshEdge> collect_edges(const Mesh& mesh, std::vector<std::array<std::uint32_t, 3>>& edge_of) {
  struct Side {
    std::uint32_t a, b, triangle, side;
  };
  std::vector<Side> sides;
  sides.reserve(3 * mesh.triangles.size());
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    for (std::uint32_t k = 0; k < 3; ++k) {
      const auto [a, b] = std::minmax(mesh.triangles[t][k], mesh.triangles[t][(k + 1) % 3]);
      sides.push_back({a, b, t, k});
    }
  }
  std::sort(sides.begin(), sides.end(), [](const Side& p, const Side& q) {
    return std::tie(p.a, p.b, p.triangle, p.side) < std::tie(q.a, q.b, q.triangle, q.side);
  });
  std::vector<MeshEdge> edges;
  edge_of.resize(mesh.triangles.size());
  for (const Side& s : sides) {
    if (edges.empty() || edges.back().a != s.a || edges.back().b != s.b) {
      edges.push_back({.a = s.a, .b = s.b, .count = 0, .triangle = {}});
    }
    MeshEdge& e = edges.back();
    if (e.count < 2) e.triangle[e.count] = s.triangle;
    ++e.count;
    edge_of[s.triangle][s.side] = static_cast<std::uint32_t>(edges.size() - 1);
  }
  return edges;
}

struct Item {
  Box3 box;
  Vec2 centre;
};

class TreeBuilder {
 public:
  TreeBuilder(Tree& tree, const Mesh& mesh) : tree_(tree) {
    items_.resize(mesh.triangles.size());
    for (std::size_t t = 0; t < items_.size(); ++t) {
      for (const std::uint32_t v : mesh.triangles[t]) items_[t].box.add(mesh.vertices[v]);
      items_[t].centre = 0.5 * (xy(items_[t].box.lo) + xy(items_[t].box.hi));
    }
    tree_.order.resize(items_.size());
    std::iota(tree_.order.begin(), tree_.order.end(), 0U);
  }

  void run() {
    struct Task {
      std::uint32_t node, first, last;
    };
    tree_.nodes.push_back({});
    std::vector<Task> tasks{{0, 0, static_cast<std::uint32_t>(items_.size())}};
    while (!tasks.empty()) {
      const Task t = tasks.back();
      tasks.pop_back();
      tree_.nodes[t.node].box = box(t.first, t.last);
      if (t.last - t.first <= kLeafSize) {
        const auto number = static_cast<std::uint32_t>(tree_.leaves.size());
        tree_.leaves.push_back({t.first, t.last});
        tree_.nodes[t.node].left = tree_.nodes[t.node].right = number;
        continue;
      }
      const std::uint32_t middle = split(t.first, t.last);
      const auto left = static_cast<std::uint32_t>(tree_.nodes.size());
      tree_.nodes.push_back({});
      tree_.nodes.push_back({});
      tree_.nodes[t.node].left = left;
      tree_.nodes[t.node].right = left + 1;
      tasks.push_back({left + 1, middle, t.last});
      tasks.push_back({left, t.first, middle});
    }
  }

 private:
  [[nodiscard]] Box3 box(std::uint32_t first, std::uint32_t last) const {
    Box3 b;
    for (std::uint32_t k = first; k < last; ++k) {
      b.add(items_[tree_.order[k]].box.lo);
      b.add(items_[tree_.order[k]].box.hi);
    }
    return b;
  }

  std::uint32_t split(std::uint32_t first, std::uint32_t last) {
    Vec2 lo{1e300, 1e300};
    Vec2 hi{-1e300, -1e300};
    for (std::uint32_t k = first; k < last; ++k) {
      const Vec2 c = items_[tree_.order[k]].centre;
      lo = {std::min(lo.x, c.x), std::min(lo.y, c.y)};
      hi = {std::max(hi.x, c.x), std::max(hi.y, c.y)};
    }
    const bool by_x = hi.x - lo.x >= hi.y - lo.y;
    const std::uint32_t middle = first + (last - first) / 2;
    const auto key = [&](std::uint32_t t) {
      return std::pair{by_x ? items_[t].centre.x : items_[t].centre.y, t};
    };
    std::nth_element(tree_.order.begin() + first, tree_.order.begin() + middle, tree_.order.begin() + last,
                     [&](std::uint32_t p, std::uint32_t q) { return key(p) < key(q); });
    return middle;
  }

  Tree& tree_;
  std::vector<Item> items_;
};

Vec3 upward_normal(const Mesh& mesh, std::uint32_t t) {
  const auto& c = mesh.triangles[t];
  const Vec3 n = cross(mesh.vertices[c[1]] - mesh.vertices[c[0]], mesh.vertices[c[2]] - mesh.vertices[c[0]]);
  return n.z < 0.0 ? -1.0 * n : n;
}

std::uint32_t third_corner(const Mesh& mesh, const MeshEdge& e, std::uint32_t t) {
  for (const std::uint32_t v : mesh.triangles[t]) {
    if (v != e.a && v != e.b) return v;
  }
  return e.a;
}

bool is_valley(const Mesh& mesh, const MeshEdge& e) {
  if (e.count != 2) return false;
  const Vec2 a = xy(mesh.vertices[e.a]);
  const Vec2 d = xy(mesh.vertices[e.b]) - a;
  double sum = 0.0;
  double side[2];
  for (std::size_t k = 0; k < 2; ++k) {
    const std::uint32_t t = e.triangle[k];
    const Vec3 n = upward_normal(mesh, t);
    if (!(n.z > 1e-6 * norm(n))) return false;
    side[k] = cross(d, xy(mesh.vertices[third_corner(mesh, e, t)]) - a);
    const double sign = side[k] > 0.0 ? 1.0 : -1.0;
    // slope of the facet away from the edge: gradient times the edge's normal towards the facet
    sum += sign * (-n.x * -d.y + -n.y * d.x) / n.z;
  }
  return side[0] * side[1] < 0.0 && sum >= -1e-12 * norm(d);
}

}  // namespace

Mesh weld(const Mesh& mesh) {
  std::vector<std::uint32_t> order(mesh.vertices.size());
  std::iota(order.begin(), order.end(), 0U);
  const auto key = [&](std::uint32_t i) {
    const Vec3& v = mesh.vertices[i];
    return std::tuple{v.x, v.y, v.z, i};
  };
  for (const Vec3& v : mesh.vertices) {
    if (!std::isfinite(v.x) || !std::isfinite(v.y) || !std::isfinite(v.z)) {
      throw std::logic_error("a mesh to drop on has a vertex that is not finite");
    }
  }
  std::sort(order.begin(), order.end(), [&](std::uint32_t p, std::uint32_t q) { return key(p) < key(q); });
  std::vector<std::uint32_t> first(order.size());
  for (std::size_t k = 0; k < order.size(); ++k) {
    const bool same = k > 0 && mesh.vertices[order[k]] == mesh.vertices[order[k - 1]];
    first[order[k]] = same ? first[order[k - 1]] : order[k];
  }
  constexpr std::uint32_t kUnset = 0xFFFFFFFFU;
  std::vector<std::uint32_t> number(order.size(), kUnset);
  Mesh out;
  out.triangles.reserve(mesh.triangles.size());
  for (const auto& t : mesh.triangles) {
    std::array<std::uint32_t, 3> corners{};
    for (std::size_t k = 0; k < 3; ++k) {
      if (t[k] >= first.size()) throw std::logic_error("a triangle names a vertex that is not there");
      const std::uint32_t v = first[t[k]];
      if (number[v] == kUnset) {
        number[v] = static_cast<std::uint32_t>(out.vertices.size());
        out.vertices.push_back(mesh.vertices[v]);
      }
      corners[k] = number[v];
    }
    out.triangles.push_back(corners);
  }
  return out;
}

Tree build_tree(const Mesh& welded) {
  Tree tree;
  tree.edges = collect_edges(welded, tree.edge_of);
  if (!welded.triangles.empty()) TreeBuilder(tree, welded).run();
  return tree;
}

std::vector<bool> valley_edges(const Mesh& welded, const std::vector<MeshEdge>& edges) {
  std::vector<bool> out(edges.size());
  for (std::size_t i = 0; i < edges.size(); ++i) out[i] = is_valley(welded, edges[i]);
  return out;
}

}  // namespace capstan::toolpath::freeform

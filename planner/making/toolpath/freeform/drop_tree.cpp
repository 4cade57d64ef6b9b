#include "planner/making/toolpath/freeform/drop_tree.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>
#include <tuple>

#include "planner/ground/geometry/region.h"

namespace capstan::toolpath::freeform {
namespace {

using geometry::Box3;
using geometry::Mesh;
using geometry::Vec2;
using geometry::Vec3;

constexpr std::uint32_t kLeafSize = 4;
/// Nodes of so many triangles have a plane: above them the surface bends too much for one to say more than
/// the box. Default, unsourced.
constexpr std::uint32_t kMostInPlane = 64;
constexpr double kUpright = 1e-6;  ///< of unit normals

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
  int faces = 0;  ///< 1: up, -1: down, 0: it is upright, or nearly so
};

Vec3 normal(const Mesh& mesh, std::uint32_t t) {
  const auto& c = mesh.triangles[t];
  return cross(mesh.vertices[c[1]] - mesh.vertices[c[0]], mesh.vertices[c[2]] - mesh.vertices[c[0]]);
}

Vec3 upward_normal(const Mesh& mesh, std::uint32_t t) {
  const Vec3 n = normal(mesh, t);
  return n.z < 0.0 ? -1.0 * n : n;
}

class TreeBuilder {
 public:
  TreeBuilder(Tree& tree, const Mesh& mesh) : tree_(tree), mesh_(mesh) {
    items_.resize(mesh.triangles.size());
    for (std::size_t t = 0; t < items_.size(); ++t) {
      for (const std::uint32_t v : mesh.triangles[t]) items_[t].box.add(mesh.vertices[v]);
      items_[t].centre = 0.5 * (xy(items_[t].box.lo) + xy(items_[t].box.hi));
      const Vec3 n = normal(mesh, static_cast<std::uint32_t>(t));
      if (std::abs(n.z) > kUpright * norm(n)) items_[t].faces = n.z > 0.0 ? 1 : -1;
    }
    tree_.order.resize(items_.size());
    std::iota(tree_.order.begin(), tree_.order.end(), 0U);
  }

  void run() {
    struct Task {
      std::uint32_t node, first, last;
      std::size_t depth;
    };
    tree_.nodes.push_back({});
    tree_.planes.push_back({});
    std::vector<Task> tasks{{0, 0, static_cast<std::uint32_t>(items_.size()), 0}};
    while (!tasks.empty()) {
      const Task t = tasks.back();
      tasks.pop_back();
      tree_.nodes[t.node].box = box(t.first, t.last);
      if (t.last - t.first <= kMostInPlane) tree_.planes[t.node] = plane(t.first, t.last);
      if (t.last - t.first <= kLeafSize) {
        const auto number = static_cast<std::uint32_t>(tree_.leaves.size());
        tree_.leaves.push_back({t.first, t.last});
        tree_.nodes[t.node].left = tree_.nodes[t.node].right = number;
        continue;
      }
      const std::uint32_t middle = split(t.first, t.last, t.depth);
      const auto left = static_cast<std::uint32_t>(tree_.nodes.size());
      tree_.nodes.resize(tree_.nodes.size() + 2);
      tree_.planes.resize(tree_.nodes.size());
      tree_.nodes[t.node].left = left;
      tree_.nodes[t.node].right = left + 1;
      tasks.push_back({left + 1, middle, t.last, t.depth + 1});
      tasks.push_back({left, t.first, middle, t.depth + 1});
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

  /// The first triangle of the second half. Triangles that face up, stand upright and face down are told
  /// apart first: what lies beneath a solid would else spread the boxes of what lies on it. Then the half
  /// perimeters of both boxes times their numbers are made small, over cuts of x and y into equal parts.
  /// Source  the surface area heuristic of ray tracing (MacDonald and Booth 1990), seen along z.
  std::uint32_t split(std::uint32_t first, std::uint32_t last, std::size_t depth) {
    const auto begin = tree_.order.begin();
    const int faces = items_[*(begin + first)].faces;
    const auto apart = std::partition(begin + first, begin + last,
                                      [&](std::uint32_t t) { return items_[t].faces == faces; });
    if (const auto middle = static_cast<std::uint32_t>(apart - begin); middle < last) return middle;
    geometry::Box2 centres{{1e300, 1e300}, {-1e300, -1e300}};
    for (std::uint32_t k = first; k < last; ++k) {
      const Vec2 c = items_[tree_.order[k]].centre;
      centres.lo = {std::min(centres.lo.x, c.x), std::min(centres.lo.y, c.y)};
      centres.hi = {std::max(centres.hi.x, c.x), std::max(centres.hi.y, c.y)};
    }
    const Cut x = cheapest(first, last, centres, true), y = cheapest(first, last, centres, false);
    const Cut& cut = x.cost <= y.cost ? x : y;
    // From there on halves are equal: 2^32 triangles come to 32 more.
    if (cut.cost < 1e300 && depth + 40 < kDeepestTree) {
      const auto below = [&](std::uint32_t t) { return part_of(t, centres, cut.by_x) < cut.part; };
      return static_cast<std::uint32_t>(std::partition(begin + first, begin + last, below) - begin);
    }
    const bool by_x = centres.hi.x - centres.lo.x >= centres.hi.y - centres.lo.y;
    const std::uint32_t middle = first + (last - first) / 2;
    const auto key = [&](std::uint32_t t) {
      return std::pair{by_x ? items_[t].centre.x : items_[t].centre.y, t};
    };
    std::nth_element(begin + first, begin + middle, begin + last,
                     [&](std::uint32_t p, std::uint32_t q) { return key(p) < key(q); });
    return middle;
  }

  static constexpr std::size_t kParts = 16;
  struct Cut {
    bool by_x = true;
    std::size_t part = 0;  ///< the first of the second half
    double cost = 1e300;   ///< 1e300: no cut leaves an eighth on either side, which bounds the depth
  };

  [[nodiscard]] std::size_t part_of(std::uint32_t t, const geometry::Box2& centres, bool by_x) const {
    const Vec2 c = items_[t].centre;
    const double at = by_x ? (c.x - centres.lo.x) / (centres.hi.x - centres.lo.x)
                           : (c.y - centres.lo.y) / (centres.hi.y - centres.lo.y);
    return std::min(kParts - 1, static_cast<std::size_t>(at * kParts));
  }

  [[nodiscard]] Cut cheapest(std::uint32_t first, std::uint32_t last, const geometry::Box2& centres,
                             bool by_x) const {
    Cut best{.by_x = by_x};
    if (!(by_x ? centres.hi.x > centres.lo.x : centres.hi.y > centres.lo.y)) return best;
    std::array<Box3, kParts> box;
    std::array<std::uint32_t, kParts> number{};
    for (std::uint32_t k = first; k < last; ++k) {
      const std::uint32_t t = tree_.order[k];
      const std::size_t part = part_of(t, centres, by_x);
      box[part].add(items_[t].box.lo);
      box[part].add(items_[t].box.hi);
      ++number[part];
    }
    const auto half_perimeter = [](const Box3& b) { return b.hi.x - b.lo.x + b.hi.y - b.lo.y; };
    std::array<double, kParts> above{};  // cost of the parts from here on
    Box3 all;
    std::uint32_t n = 0;
    for (std::size_t part = kParts; part-- > 1;) {
      if (number[part] > 0) {
        all.add(box[part].lo);
        all.add(box[part].hi);
      }
      n += number[part];
      above[part] = n > 0 ? n * half_perimeter(all) : 0.0;
    }
    all = {};
    n = 0;
    const std::uint32_t least = std::max(1U, (last - first) / 8);
    for (std::size_t part = 1; part < kParts; ++part) {
      if (number[part - 1] > 0) {
        all.add(box[part - 1].lo);
        all.add(box[part - 1].hi);
      }
      n += number[part - 1];
      if (n < least || last - first - n < least) continue;
      const double cost = n * half_perimeter(all) + above[part];
      if (cost < best.cost) best = {by_x, part, cost};
    }
    return best;
  }

  /// As the triangles face on the whole, and as high as the highest corner above that.
  [[nodiscard]] NodePlane plane(std::uint32_t first, std::uint32_t last) const {
    constexpr double kSteepest = 20.0;  // of which a plane says no more than a box; default, unsourced
    constexpr double kRounding = 1e-14;
    Vec3 n;
    for (std::uint32_t k = first; k < last; ++k) n = n + upward_normal(mesh_, tree_.order[k]);
    NodePlane out;
    if (!(n.z > 0.0) || std::hypot(n.x, n.y) > kSteepest * n.z) return out;
    out.made = true;
    out.slope = {-n.x / n.z, -n.y / n.z};
    out.base_mm = -1e300;
    double largest = 1.0;
    for (std::uint32_t k = first; k < last; ++k) {
      for (const std::uint32_t i : mesh_.triangles[tree_.order[k]]) {
        const Vec3& v = mesh_.vertices[i];
        out.base_mm = std::max(out.base_mm, v.z - dot(out.slope, xy(v)));
        largest = std::max({largest, std::abs(v.x), std::abs(v.y), std::abs(v.z)});
      }
    }
    out.base_mm += kRounding * largest * (1.0 + kSteepest);
    return out;
  }

  Tree& tree_;
  const Mesh& mesh_;
  std::vector<Item> items_;
};

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
    if (!(n.z > kUpright * norm(n))) return false;
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

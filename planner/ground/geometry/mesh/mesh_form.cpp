#include "planner/ground/geometry/mesh/mesh_form.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>
#include <vector>

#include "planner/ground/base/number.h"
#include "planner/ground/geometry/mesh/welded.h"

// Corners are welded first (welded.h), then edges are counted. An edge of one triangle whose other side is
// met by several shorter ones (a corner in its middle) is closed, too: edges of the border are split at
// corners that lie on them and counted again. What is left of the border is chained into loops: seen from
// above, a sheet's outer loop runs round it, and a loop that runs the other way is a hole.

namespace capstan::geometry {

namespace {

using Edge = std::pair<std::uint32_t, std::uint32_t>;
using Triangle = std::array<std::uint32_t, 3>;

/// Uses of edges: first the lower number, then the higher one, then whether the use runs from the lower to
/// the higher. Sorted, the uses of an edge follow one another.
class Uses {
 public:
  explicit Uses(std::size_t most) { keys_.reserve(most); }

  void count(std::uint32_t a, std::uint32_t b) {
    if (a == b) return;
    const std::uint64_t lo = std::min(a, b), hi = std::max(a, b);
    keys_.push_back(lo << 33U | hi << 1U | (a < b ? 1U : 0U));
  }

  /// Calls `f(lower, higher, forth, back)` with each edge and how often it is used in each direction.
  template <class F>
  void each(const F& f) {
    std::sort(keys_.begin(), keys_.end());
    for (std::size_t i = 0; i < keys_.size();) {
      const std::uint64_t edge = keys_[i] >> 1U;
      std::size_t forth = 0, back = 0;
      for (; i < keys_.size() && keys_[i] >> 1U == edge; ++i) ++((keys_[i] & 1U) != 0 ? forth : back);
      f(static_cast<std::uint32_t>(edge >> 32U), static_cast<std::uint32_t>(edge & 0xFFFFFFFFU), forth, back);
    }
  }

  /// Edges used an odd number of times, each as it runs along its triangle.
  std::vector<Edge> border() {
    std::vector<Edge> out;
    each([&](std::uint32_t lo, std::uint32_t hi, std::size_t forth, std::size_t back) {
      if ((forth + back) % 2 != 0) out.push_back(forth > back ? Edge{lo, hi} : Edge{hi, lo});
    });
    return out;
  }

 private:
  std::vector<std::uint64_t> keys_;
};

/// The border without what corners in the middle of edges only seem to leave open.
std::vector<Edge> without_seams(const Mesh& mesh, const std::vector<Edge>& border) {
  constexpr std::size_t kMost = 3000;
  if (border.size() > kMost) return border;
  std::vector<std::uint32_t> corners;
  for (const Edge& e : border) corners.push_back(e.first);
  std::sort(corners.begin(), corners.end());
  corners.erase(std::unique(corners.begin(), corners.end()), corners.end());
  Uses edges(2 * border.size());
  for (const auto& [from, to] : border) {
    const Vec3 a = mesh.vertices[from], d = mesh.vertices[to] - a;
    std::vector<std::pair<double, std::uint32_t>> on;
    for (const std::uint32_t c : corners) {
      if (c == from || c == to) continue;
      const double t = dot(mesh.vertices[c] - a, d) / dot(d, d);
      if (t <= 0.0 || t >= 1.0 || norm(mesh.vertices[c] - a - t * d) > kWeldMm) continue;
      on.emplace_back(t, c);
    }
    std::sort(on.begin(), on.end());
    std::uint32_t last = from;
    for (const auto& [t, c] : on) {
      edges.count(last, c);
      last = c;
    }
    edges.count(last, to);
  }
  return edges.border();
}

/// The border's edges, end to end.
std::vector<std::vector<std::uint32_t>> chained(const std::vector<Edge>& border) {
  std::multimap<std::uint32_t, std::size_t> from;
  for (std::size_t i = 0; i < border.size(); ++i) from.emplace(border[i].first, i);
  std::vector<std::vector<std::uint32_t>> out;
  while (!from.empty()) {
    auto it = from.begin();
    std::vector<std::uint32_t> loop;
    while (it != from.end()) {
      loop.push_back(border[it->second].first);
      const std::uint32_t next = border[it->second].second;
      from.erase(it);
      it = from.find(next);
    }
    out.push_back(std::move(loop));
  }
  return out;
}

std::string words(Vec3 p) {
  return "(" + trimmed(p.x, 3) + ", " + trimmed(p.y, 3) + ", " + trimmed(p.z, 3) + ")";
}

}  // namespace

MeshForm form_of(const Mesh& mesh) {
  MeshForm out;
  const std::vector<std::uint32_t> same = welded(mesh);
  Uses edges(3 * mesh.triangles.size());
  double volume = 0.0, above = 0.0, below = 0.0;  // of triangles seen from above, and from below
  constexpr double kSteep =
      0.1736;  // of a unit normal: walls within 10 degrees of upright; default, unsourced
  bool steep = false;
  const Box3 box = bounds(mesh);
  for (const Triangle& t : mesh.triangles) {
    const Triangle w{same[t[0]], same[t[1]], same[t[2]]};
    if (w[0] == w[1] || w[1] == w[2] || w[2] == w[0]) continue;
    for (std::size_t k = 0; k < 3; ++k) edges.count(w[k], w[(k + 1) % 3]);
    const Vec3 a = mesh.vertices[w[0]] - box.lo, b = mesh.vertices[w[1]] - box.lo,
               c = mesh.vertices[w[2]] - box.lo;
    volume += dot(a, cross(b, c)) / 6.0;
    const Vec3 n = cross(b - a, c - a);
    const double shadow = 0.5 * n.z;
    steep = steep || std::abs(n.z) <= kSteep * norm(n);
    (shadow > 0.0 ? above : below) += std::abs(shadow);
  }
  edges.each([&](std::uint32_t, std::uint32_t, std::size_t forth, std::size_t back) {
    if (forth + back > 2) ++out.crowded_edges;
    if (forth + back == 2 && forth != back) ++out.turned_edges;
  });
  const std::vector<Edge> border = without_seams(mesh, edges.border());
  out.open_edges = border.size();
  if (border.empty()) {
    out.kind = MeshForm::Kind::kSolid;
    out.inside_out = volume < 0.0;
    return out;
  }
  const auto loops = chained(border);
  // A sheet: all of it faces the same side, its outer borders bound as much as its triangles cover.
  constexpr double kShare = 1e-6;
  const bool one_side = std::min(above, below) <= kShare * std::max(above, below);
  const double sign = above >= below ? 1.0 : -1.0;
  const std::vector<std::uint32_t>* hole = nullptr;
  std::vector<Loop> outer;
  for (const auto& loop : loops) {
    Loop xy_loop;
    for (const std::uint32_t v : loop) xy_loop.push_back(xy(mesh.vertices[v]));
    const double area = sign * signed_area(xy_loop);
    if (area < 0.0 && hole == nullptr) hole = &loop;
    if (sign < 0.0) std::reverse(xy_loop.begin(), xy_loop.end());
    outer.push_back(std::move(xy_loop));
  }
  // What faces down between walls is a solid without its top, drafted walls included, and no sheet.
  const bool lies = sign > 0.0 || !steep;
  if (one_side && lies && hole == nullptr && out.turned_edges == 0) {
    out.outline = clean(outer);
    const double covered = std::max(above, below);
    if (std::abs(area(out.outline) - covered) <= 1e-4 * covered) {
      out.kind = MeshForm::Kind::kSheet;
      out.faces_down = sign < 0.0;
      return out;
    }
  }
  const auto& first = hole != nullptr ? *hole : loops.front();
  Box3 around;
  for (const std::uint32_t v : first) around.add(mesh.vertices[v]);
  const Vec3 size = around.size();
  out.fault = std::to_string(out.open_edges) + " edges have no triangle on one side, in " +
              std::to_string(loops.size()) + (loops.size() == 1 ? " opening" : " openings") +
              "; the first is " + trimmed(size.x, 3) + " x " + trimmed(size.y, 3) + " x " +
              trimmed(size.z, 3) + " mm, from " + words(around.lo);
  if (!lies) out.fault += "; it faces down and has walls, as a solid without its top does";
  return out;
}

}  // namespace capstan::geometry

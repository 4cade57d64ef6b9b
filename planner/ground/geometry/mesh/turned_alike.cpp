#include "planner/ground/geometry/mesh/turned_alike.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <utility>
#include <vector>

#include "planner/ground/base/stopping.h"
#include "planner/ground/geometry/mesh/welded.h"

// Two triangles face the same way if they run along their edge in opposite directions. From one triangle of a
// piece on, each neighbour is given the side that this asks; then the smaller of the two sides by area is
// turned.

namespace capstan::geometry {

namespace {

/// An edge's use by a triangle; sorted, uses of an edge follow one another.
struct Use {
  std::uint64_t edge;  ///< the lower and the higher number of its corners
  std::uint32_t triangle;
  bool forth;  ///< the triangle runs from the lower to the higher
};

struct Neighbour {
  std::uint32_t triangle;
  bool alike;
};

/// Of each triangle those beyond its edges of two triangles.
std::vector<std::vector<Neighbour>> neighbours_of(const Mesh& mesh) {
  const std::vector<std::uint32_t> same = welded(mesh);
  std::vector<Use> uses;
  uses.reserve(3 * mesh.triangles.size());
  for (std::uint32_t i = 0; i < mesh.triangles.size(); ++i) {
    tick();
    const auto& t = mesh.triangles[i];
    const std::array<std::uint64_t, 3> w{same[t[0]], same[t[1]], same[t[2]]};
    if (w[0] == w[1] || w[1] == w[2] || w[2] == w[0]) continue;  // none, its corners welded
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint64_t a = w[k], b = w[(k + 1) % 3];
      uses.push_back({std::min(a, b) << 32U | std::max(a, b), i, a < b});
    }
  }
  std::sort(uses.begin(), uses.end(), [](const Use& a, const Use& b) {
    return std::pair(a.edge, a.triangle) < std::pair(b.edge, b.triangle);
  });
  std::vector<std::vector<Neighbour>> out(mesh.triangles.size());
  for (std::size_t i = 0; i < uses.size();) {
    std::size_t end = i + 1;
    while (end < uses.size() && uses[end].edge == uses[i].edge) ++end;
    if (end - i == 2) {
      const Use &a = uses[i], &b = uses[i + 1];
      const bool alike = a.forth != b.forth;
      out[a.triangle].push_back({b.triangle, alike});
      out[b.triangle].push_back({a.triangle, alike});
    }
    i = end;
  }
  return out;
}

}  // namespace

TurnedAlike turned_alike(Mesh mesh) {
  const auto neighbours = neighbours_of(mesh);
  enum Side : std::uint8_t { kUnknown, kFirst, kOther };
  std::vector<Side> side(mesh.triangles.size(), kUnknown);
  std::vector<std::uint32_t> piece, turned;
  for (std::uint32_t seed = 0; seed < mesh.triangles.size(); ++seed) {
    if (side[seed] != kUnknown) continue;
    piece.assign(1, seed);
    side[seed] = kFirst;
    bool two_sides = true;
    std::array<double, 2> area{};
    for (std::size_t i = 0; i < piece.size(); ++i) {  // grows
      tick();
      const auto& t = mesh.triangles[piece[i]];
      const Vec3 a = mesh.vertices[t[0]];
      area[side[piece[i]] == kFirst ? 0 : 1] += norm(cross(mesh.vertices[t[1]] - a, mesh.vertices[t[2]] - a));
      for (const Neighbour& n : neighbours[piece[i]]) {
        const Side asked = n.alike == (side[piece[i]] == kFirst) ? kFirst : kOther;
        if (side[n.triangle] == kUnknown) {
          side[n.triangle] = asked;
          piece.push_back(n.triangle);
        } else if (side[n.triangle] != asked) {
          two_sides = false;
        }
      }
    }
    if (!two_sides) continue;
    const Side smaller = area[0] < area[1] ? kFirst : kOther;
    for (const std::uint32_t i : piece)
      if (side[i] == smaller) turned.push_back(i);
  }
  TurnedAlike out;
  out.turned = turned.size();
  if (!turned.empty()) {
    const auto& t = mesh.triangles[*std::min_element(turned.begin(), turned.end())];
    out.first = (1.0 / 3.0) * (mesh.vertices[t[0]] + mesh.vertices[t[1]] + mesh.vertices[t[2]]);
  }
  for (const std::uint32_t i : turned) std::swap(mesh.triangles[i][1], mesh.triangles[i][2]);
  out.mesh = std::move(mesh);
  return out;
}

}  // namespace capstan::geometry

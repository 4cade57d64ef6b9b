#include "planner/ground/geometry/mesh/welded.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "planner/ground/base/stopping.h"

// Vertices that stand for themselves lie in the cells of a grid, which are found by a hash of their place and
// chained. A cell is kCells welds wide, so that many vertices lie farther than a weld from its sides and ask
// one cell alone; the others ask the cells on the near sides, too.

namespace capstan::geometry {

namespace {

constexpr double kCells = 8.0;  ///< welds in the side of a cell; any number from 2 gives the same
constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();

using Cell = std::array<std::int64_t, 3>;

std::uint64_t hash(const Cell& c) {
  std::uint64_t h = 0;
  for (const std::int64_t k : c) {
    h = (h ^ static_cast<std::uint64_t>(k)) * 0x9E3779B97F4A7C15ULL;
    h ^= h >> 29U;
  }
  return h;
}

}  // namespace

std::vector<std::uint32_t> welded(const Mesh& mesh) {
  const std::size_t n = mesh.vertices.size();
  std::size_t slots = 16;
  while (slots < 2 * n) slots *= 2;
  std::vector<std::uint32_t> first(slots, kNone), next(n, kNone), out(n);
  for (std::uint32_t i = 0; i < n; ++i) {
    tick();
    const Vec3 v = mesh.vertices[i];
    std::array<std::array<std::int64_t, 2>, 3> near{};  // of each axis, the cells within a weld
    const std::array<double, 3> at{v.x, v.y, v.z};
    for (std::size_t k = 0; k < 3; ++k) {
      near[k] = {static_cast<std::int64_t>(std::floor((at[k] - kWeldMm) / (kCells * kWeldMm))),
                 static_cast<std::int64_t>(std::floor((at[k] + kWeldMm) / (kCells * kWeldMm)))};
    }
    out[i] = i;
    Cell c;
    for (c[0] = near[0][0]; c[0] <= near[0][1]; ++c[0]) {
      for (c[1] = near[1][0]; c[1] <= near[1][1]; ++c[1]) {
        for (c[2] = near[2][0]; c[2] <= near[2][1]; ++c[2]) {
          // Chains may mix cells of one slot: the distance decides.
          for (std::uint32_t j = first[hash(c) & (slots - 1)]; j != kNone; j = next[j])
            if (j < out[i] && norm(mesh.vertices[j] - v) <= kWeldMm) out[i] = j;
        }
      }
    }
    if (out[i] != i) continue;
    for (std::size_t k = 0; k < 3; ++k)
      c[k] = static_cast<std::int64_t>(std::floor(at[k] / (kCells * kWeldMm)));
    std::uint32_t& head = first[hash(c) & (slots - 1)];
    next[i] = head;
    head = i;
  }
  return out;
}

}  // namespace capstan::geometry

#pragma once

#include <cmath>
#include <cstdint>

#include "planner/ground/geometry/mesh.h"

namespace capstan::testing {

/// A wavy surface of 100 mm by 100 mm, in n by n squares of two triangles.
inline geometry::Mesh wavy(int n) {
  geometry::Mesh m;
  for (int j = 0; j <= n; ++j) {
    for (int i = 0; i <= n; ++i) {
      const double x = 100.0 * i / n;
      const double y = 100.0 * j / n;
      m.vertices.push_back({x, y, 5.0 * std::sin(0.15 * x) * std::cos(0.11 * y)});
    }
  }
  const auto at = [n](int i, int j) { return static_cast<std::uint32_t>(j * (n + 1) + i); };
  for (int j = 0; j < n; ++j) {
    for (int i = 0; i < n; ++i) {
      m.triangles.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
      m.triangles.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
    }
  }
  return m;
}

}  // namespace capstan::testing

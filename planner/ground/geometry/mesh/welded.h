#pragma once

#include <cstdint>
#include <vector>

#include "planner/ground/geometry/mesh.h"

namespace capstan::geometry {

/// Corners of a mesh no farther apart than this are one, mm. Default, unsourced: a hundredth of what paths
/// leave.
inline constexpr double kWeldMm = 1e-3;

/// Of each vertex the number of the vertex that stands for it: the first within kWeldMm that stands for
/// itself. Cost  linear.
[[nodiscard]] std::vector<std::uint32_t> welded(const Mesh& mesh);

}  // namespace capstan::geometry

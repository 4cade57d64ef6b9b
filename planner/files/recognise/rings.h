#pragma once

#include <vector>

#include "planner/files/recognise/prismatic.h"

namespace capstan::recognise {

/// Patches of one surface within a group: a wall that another feature cut in two is one wall.
struct Surface {
  std::uint32_t first = 0;  ///< into Graph::patches
  std::vector<std::uint32_t> patches;
};

/// Walls and bends along one direction that follow each other.
struct Ring {
  std::vector<Surface> sides;
  bool closed = false;  ///< each meets a neighbour at either end
  bool island = false;  ///< closed, and the material is inside
};

/// The chains that walls and bends along `access` form.
[[nodiscard]] std::vector<Ring> rings_of(const Context& context, const std::vector<Surface>& sides,
                                         Direction3 access);

/// Whether a circle about the axis of a patch is whole on its boundary.
[[nodiscard]] bool runs_round(const Context& context, const Patch& p);

}  // namespace capstan::recognise

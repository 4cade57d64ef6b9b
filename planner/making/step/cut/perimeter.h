#pragma once

#include "planner/ground/geometry/region.h"

namespace capstan::step {

/// Length of all outlines of an area, mm.
[[nodiscard]] inline double perimeter(const geometry::Region& area) {
  double out = 0.0;
  for (const auto& loop : area.loops) {
    for (std::size_t i = 0; i < loop.size(); ++i) out += norm(loop[(i + 1) % loop.size()] - loop[i]);
  }
  return out;
}

}  // namespace capstan::step

#pragma once

#include <functional>
#include <vector>

#include "planner/files/exchange/brep/brep.h"

namespace capstan::testing {

/// A body of boxes: the cells of a grid that `filled` says are material. Every square of the surface is a
/// face of its own, so that each plane of the body is split many times.
///
/// Needs   no two filled cells that meet at an edge or a corner alone.
[[nodiscard]] exchange::Brep blocks(const std::vector<double>& x, const std::vector<double>& y,
                                    const std::vector<double>& z,
                                    const std::function<bool(std::size_t, std::size_t, std::size_t)>& filled);

}  // namespace capstan::testing

#pragma once

#include <cstdint>
#include <random>
#include <string>
#include <vector>

#include "planner/files/recognise/recognise.h"

namespace capstan::testing {

/// The same body turned at random, moved, and scaled.
[[nodiscard]] exchange::Brep turned(const exchange::Brep& brep, std::mt19937_64& random, double scale = 1.0);

/// The same body with its faces and edges in another order.
[[nodiscard]] exchange::Brep shuffled(const exchange::Brep& brep, std::mt19937_64& random);

/// The same body with up to `count` of its convex plane faces split in two, each along a line between the
/// middles of two of its edges. Both parts keep name and `#id`.
[[nodiscard]] exchange::Brep split(const exchange::Brep& brep, std::mt19937_64& random, std::size_t count);

/// What must not depend on frame, order, unit or splits: kinds, faces by name and `#id`, sizes in the part's
/// own scale.
[[nodiscard]] std::vector<std::string> summary(const exchange::Brep& brep,
                                               const recognise::Recognition& found, double scale);

}  // namespace capstan::testing

#pragma once

#include <utility>
#include <vector>

#include "planner/ground/geometry/placement.h"
#include "planner/model/nouns/arena/model.h"

namespace capstan::exchange::ap238 {

/// The locations of general patterns are placements of their bases: where a base's placement is brought to
/// the other end of the feature, its pattern's locations go there, too.
class Locations {
 public:
  /// Notes where the bases are.
  explicit Locations(const model::Model& m);
  /// Moves the locations of those that are elsewhere now.
  void follow(model::Model& m) const;

 private:
  std::vector<std::pair<model::AnyRef, geometry::Placement>> before_;
};

}  // namespace capstan::exchange::ap238

#pragma once

#include <vector>

#include "planner/making/sequence/order.h"

namespace capstan::sequence {

/// The side from which each feature is cut: indices into `directions`.
struct Access {
  std::vector<geometry::Vec3> directions;  ///< unit, in the order they were met (wanted ones first)
  std::vector<std::size_t> of_feature;
};
[[nodiscard]] Access access_of(const std::vector<model::FeatureShape>& shapes, const Options& options);

/// One feature before another, by geometry.
struct FeaturePair {
  std::size_t before = 0, after = 0;
  Cause cause = Cause::kLiesIn;
};
/// By (before, after). Only features of the same side are compared: sweep along one axis over their boxes.
[[nodiscard]] std::vector<FeaturePair> geometric_pairs(const std::vector<model::FeatureShape>& shapes,
                                                       const Access& access);

/// All precedences between items; what geometry found but `given` turns round is put into `dropped`.
[[nodiscard]] std::vector<Precedence> all_precedences(const std::vector<model::FeatureShape>& shapes,
                                                      const std::vector<Item>& items, const Options& options,
                                                      const Access& access, std::vector<Precedence>& dropped);

}  // namespace capstan::sequence

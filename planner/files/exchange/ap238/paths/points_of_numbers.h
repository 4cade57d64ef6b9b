#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "planner/model/nouns/arena/attribute.h"
#include "planner/model/nouns/forward.h"

namespace capstan::exchange::ap238 {

/// Numbers by their bits; 0 and -0 are equal.
struct HashOfNumbers {
  template <std::size_t N>
  std::size_t operator()(const std::array<double, N>& v) const {
    std::uint64_t h = 14695981039346656037U;
    for (const double x : v) {
      h = (h ^ std::bit_cast<std::uint64_t>(x + 0.0)) * 0x9e3779b97f4a7c15U;
      h ^= h >> 29U;
    }
    return h;
  }
};

/// Points by their numbers, for `most` places at most: without an allocation for each.
template <class Numbers>
class PointsOfNumbers {
 public:
  explicit PointsOfNumbers(std::size_t most) : slots_(std::bit_ceil(2 * most + 1)) {}
  /// The place of these numbers alone, unset until a point is put there; valid until the next is asked for. 0
  /// and -0 are one number; NaN equals none, so that each look for it gives a new place, which counts.
  model::Ref<model::CartesianPoint>& operator[](const Numbers& v) {
    std::size_t at = HashOfNumbers()(v);
    for (;; ++at) {
      std::uint32_t& slot = slots_[at & (slots_.size() - 1)];
      if (slot == 0) {
        points_.push_back({v, {}});
        slot = static_cast<std::uint32_t>(points_.size());
        return points_.back().second;
      }
      auto& [numbers, point] = points_[slot - 1];
      if (numbers == v) return point;
    }
  }

 private:
  std::vector<std::uint32_t> slots_;  ///< from 1; 0: free
  std::vector<std::pair<Numbers, model::Ref<model::CartesianPoint>>> points_;
};

}  // namespace capstan::exchange::ap238

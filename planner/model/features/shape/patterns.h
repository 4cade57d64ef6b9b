#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "planner/model/features/shape/build.h"

// The places of a pattern's members; only shape/*.cpp include this.

namespace capstan::model::shape {

inline constexpr std::int64_t kMaxCopies = 100'000;
inline constexpr double kSamePlace = 1e-6;  ///< mm, and sine of angles

[[nodiscard]] bool same(const geometry::Placement& a, const geometry::Placement& b);

/// The frames that a pattern is worked out from, workpiece coordinates.
struct PatternFrames {
  geometry::Placement about;      ///< of the pattern
  geometry::Placement locations;  ///< that the locations of a general pattern are stated in
  geometry::Placement stands;     ///< of its base, as it is stated
};

/// The frames of a pattern's members, as `stands` is that of its base, each place once. `basis` are the
/// shapes of the base; what is read otherwise than stated goes into `assumed`.
[[nodiscard]] Result<std::vector<geometry::Placement>> pattern_frames(const Model& m, AnyRef self,
                                                                      const Shapes& basis,
                                                                      const PatternFrames& in,
                                                                      std::string& assumed);

}  // namespace capstan::model::shape

#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "casebase/key/normalisation.h"
#include "casebase/record/case.h"

namespace capstan::casebase {

/// What a coordinate of version 2 counts in a distance. Until one is learned each counts 1. A metric is
/// learned when it is asked for, stored in the base, and never learned again by itself: distances mean the
/// same until then.
struct Metric {
  std::array<double, kDimensions> weight = {1, 1, 1, 1, 1, 1, 1, 1, 1, 1};
  std::uint64_t cases = 0;  ///< that it was learned from; 0: the fixed scales
  bool operator==(const Metric&) const = default;
};

/// Bounds of a learned weight: what the cases say makes no two questions near that are four times farther by
/// the fixed scales, and the other way round. Defaults, unsourced.
inline constexpr double kLeastWeight = 0.5, kMostWeight = 2.0;

/// Learns how much each coordinate moves what went well: least squares of ln vc and ln fz of the good cases
/// (measured or entered) on the coordinates, within equal categories. A weight is the effect of one unit,
/// held against a factor of 1.5 in speed or feed; few cases move it little, and it stays within the bounds.
[[nodiscard]] Metric learned_metric(std::span<const Case> cases);

[[nodiscard]] std::string bytes_of(const Metric& metric);
/// Nothing: not what `bytes_of` gave, or of another version of the normalisation.
[[nodiscard]] std::optional<Metric> metric_of(std::string_view bytes);

/// The names of the dimensions, as texts show them.
[[nodiscard]] std::string_view dimension_name(std::size_t i);

}  // namespace capstan::casebase

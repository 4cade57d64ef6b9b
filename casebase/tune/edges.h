#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "casebase/record/case.h"

/// How much of its life an edge has used, by the cutting time of what it cut: watched without any reading.
namespace capstan::casebase::tune {

/// An edge after one of its cuts.
struct EdgePoint {
  double cut_min = 0.0;           ///< cutting time since its first known cut
  double used = 0.0;              ///< of the life expected; 1: half of such edges are worn out
  std::optional<double> wear_mm;  ///< that was read then
  bool operator==(const EdgePoint&) const = default;
};

/// One edge: its history as a series over cutting time, and what is left.
struct EdgeUse {
  std::string edge;  ///< tool instance and edge
  std::string tool;  ///< its class
  double diameter_mm = 0.0;
  std::string material;  ///< of its last cut
  std::vector<EdgePoint> history;
  double cut_min = 0.0;
  double used = 0.0;        ///< of the life expected, what readings say of this very edge included
  double ln_std_dev = 0.0;  ///< of the logarithm of `used`: the law's, and from edge to edge
  std::size_t unknown = 0;  ///< cuts without a time or an expected life: their wear is not in it
  bool broken = false;
  double life_min = 0.0;  ///< expected, whole, at the conditions of its last cut

  /// The probability that it is worn out, once `more` of the expected life is cut with it, too.
  [[nodiscard]] double worn_out(double more = 0.0) const;
  /// Cutting time that is left at the conditions of its last cut, min, where the edge lives `deviations`
  /// standard deviations longer than expected. At least 0.
  [[nodiscard]] double left_min(double deviations = 0.0) const;
};

/// The probability of being worn out from which on an edge's end is called near: as often as tuning lets a
/// part exceed a limit (TuneOptions::probability).
inline constexpr double kNearItsEnd = 0.05;

/// The edges that measured or entered cases name, in order of their names. A case's time counts as cutting
/// time, its rapids too: more, not less. Repeats of one record count once.
[[nodiscard]] std::vector<EdgeUse> edges_of(std::span<const Case> cases);

}  // namespace capstan::casebase::tune

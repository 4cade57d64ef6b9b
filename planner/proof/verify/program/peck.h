#pragma once

namespace capstan::verify {

/// Sizes of a cycle that differ by no more are one, mm or rad: it is above the rounding of their sums, and
/// below what a program writes.
inline constexpr double kClose = 1e-9;

/// Where a peck of `one` below `bottom` ends, mm: at `z` where that is reached.
[[nodiscard]] constexpr double peck_bottom(double bottom, double one, double z) {
  return bottom - one > z + kClose ? bottom - one : z;
}

}  // namespace capstan::verify

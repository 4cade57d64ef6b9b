#pragma once

#include <algorithm>
#include <cmath>

namespace capstan::testing::removal {

struct Point {
  double x = 0.0, y = 0.0, z = 0.0;
};

struct Box {
  Point lo, hi;
};

/// The length of a vector of some millimetres: std::hypot guards against overflow, and takes most of a
/// comparison.
inline double length(double x, double y, double z = 0.0) { return std::sqrt(x * x + y * y + z * z); }

}  // namespace capstan::testing::removal

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

}  // namespace capstan::testing::removal

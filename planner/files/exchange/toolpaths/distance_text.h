#pragma once

#include <cmath>
#include <string>

#include "planner/ground/base/number.h"

namespace capstan::exchange {

/// "0.52 mm", for a message. Coordinates whose square no number holds are read as they stand; a distance
/// between them is "more mm than a number holds".
[[nodiscard]] inline std::string distance_text(double mm, int decimals) {
  return (std::isfinite(mm) ? trimmed(mm, decimals) + " mm" : std::string("more mm than a number holds"));
}

}  // namespace capstan::exchange

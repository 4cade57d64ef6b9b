#pragma once

#include <cmath>
#include <initializer_list>
#include <string>

#include "planner/ground/base/number.h"
#include "planner/ground/base/result.h"

namespace capstan::mechanics {

/// A value and the name it has in its struct, for the checks at the doors.
struct Named {
  const char* name;
  double value;
};

/// A number as text, one that is not finite too.
[[nodiscard]] inline std::string told(double value) {
  return std::isfinite(value) ? shortest(value) : std::string("not finite");
}

/// Fails with MECH-DOMAIN, naming the first value that is not finite and greater than zero.
[[nodiscard]] inline Status check_positive(std::initializer_list<Named> values) {
  for (const Named& v : values) {
    if (std::isfinite(v.value) && v.value > 0.0) continue;
    return fail(Diagnostic{.code = "MECH-DOMAIN",
                           .message = std::string(v.name) + " is " + told(v.value),
                           .path = v.name,
                           .expected = "a finite value greater than zero"});
  }
  return {};
}

/// Fails with MECH-DOMAIN unless low <= value <= high.
[[nodiscard]] inline Status check_range(const Named& v, double low, double high) {
  if (v.value >= low && v.value <= high) return {};
  return fail(Diagnostic{.code = "MECH-DOMAIN",
                         .message = std::string(v.name) + " is " + told(v.value),
                         .path = v.name,
                         .expected = "a value from " + told(low) + " to " + told(high)});
}

}  // namespace capstan::mechanics

#include "planner/model/plan/range/ranges.h"

#include <cmath>

#include "planner/ground/base/number.h"

namespace capstan::model {
namespace {

/// What is written without an exponent.
constexpr double kSmallest = 1e-6, kLargest = 1e12;

}  // namespace

std::string value_text(double v) {
  if (!std::isfinite(v)) return "not a finite number";
  const double size = std::abs(v);
  constexpr int kDecimals = 12;
  return v == 0.0 || (size >= kSmallest && size < kLargest) ? trimmed(v, kDecimals) : shortest(v);
}

std::string to_text(const Range& range) {
  return (range.or_zero ? "0, or " : "") + value_text(range.least) + " to " + value_text(range.most);
}

}  // namespace capstan::model

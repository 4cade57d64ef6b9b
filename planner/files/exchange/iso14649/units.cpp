#include "planner/files/exchange/iso14649/units.h"

#include <array>
#include <charconv>
#include <cmath>

#include "planner/ground/base/number.h"

namespace capstan::exchange {
namespace {

// To 15 significant digits, which a double always holds.
double to_15_digits(double v) {
  std::array<char, 40> buffer{};
  const auto [end, ec] =
      std::to_chars(buffer.data(), buffer.data() + buffer.size(), v, std::chars_format::scientific, 14);
  double out = v;
  std::from_chars(buffer.data(), end, out);
  return out;
}

}  // namespace

double from_file(double value, model::Unit unit) {
  const double factor = model::iso14649_factor(unit);
  const double exact = value * factor;
  if (factor <= 1.0 || !std::isfinite(exact))
    return exact;  // lengths as they are; angles have no round radians
  const double likely = to_15_digits(exact);
  return likely / factor == value ? likely : exact;
}

double to_file(double value, model::Unit unit) {
  const double factor = model::iso14649_factor(unit);
  return factor == 1.0 ? value : unconverted(value, factor);
}

}  // namespace capstan::exchange

#include "planner/proof/verify/volumes/number_text.h"

#include <cmath>

#include "planner/ground/base/number.h"

namespace capstan::verify {

std::string plain(double v) { return std::isfinite(v) ? trimmed(v, 3) : "not a number"; }
std::string mm(double v) { return plain(v) + " mm"; }
std::string fine_mm(double v) {
  constexpr double kThousandth = 1e-3, kLeast = 1e-12;  // less is rounding
  const double size = std::abs(v);
  if (!std::isfinite(v) || size >= kThousandth || size < kLeast) return mm(v);
  return trimmed(v, 1 - static_cast<int>(std::floor(std::log10(size)))) + " mm";
}
std::string place(geometry::Vec2 p, double z) {
  return "(" + plain(p.x) + ", " + plain(p.y) + ", " + plain(z) + ")";
}

}  // namespace capstan::verify

#include "planner/proof/verify/volumes/number_text.h"

#include <cmath>

#include "planner/ground/base/number.h"

namespace capstan::verify {

std::string plain(double v) { return std::isfinite(v) ? trimmed(v, 3) : "not a number"; }
std::string mm(double v) { return plain(v) + " mm"; }
std::string place(geometry::Vec2 p, double z) {
  return "(" + plain(p.x) + ", " + plain(p.y) + ", " + plain(z) + ")";
}

}  // namespace capstan::verify

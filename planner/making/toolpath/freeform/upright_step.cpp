#include "planner/making/toolpath/freeform/upright_step.h"

#include <cmath>

namespace capstan::toolpath::freeform {
namespace {

using geometry::Vec2;

constexpr double kUprightTangent = 28.636;  ///< of 88 degrees
constexpr int kHalvings = 10;

}  // namespace

bool has_upright_step(const DropCutter& drop, const MillEnd& cutter, double allowance_mm, Vec2 a, Vec2 b) {
  const auto z = [&](Vec2 p) { return drop.drop(cutter, p.x, p.y, allowance_mm); };
  double za = z(a), zb = z(b);
  for (int i = 0; i < kHalvings; ++i) {
    const Vec2 middle = 0.5 * (a + b);
    const double zm = z(middle);
    if (std::abs(zm - za) > std::abs(zb - zm)) {
      b = middle;
      zb = zm;
    } else {
      a = middle;
      za = zm;
    }
  }
  return std::abs(zb - za) > kUprightTangent * norm(b - a);
}

}  // namespace capstan::toolpath::freeform

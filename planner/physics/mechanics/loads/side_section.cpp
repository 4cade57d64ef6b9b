#include "planner/physics/mechanics/loads/side_section.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "planner/physics/mechanics/force/immersion.h"

namespace capstan::mechanics {

Section side_section(double ap_mm, double ae_mm, const Tooth& tooth, CutDirection direction) {
  const double d = tooth.cutting_diameter_mm;
  const double corner = std::min(tooth.corner_radius_mm, 0.5 * d);
  const double widest = effective_diameter_mm(ap_mm, d, corner);
  const double width = std::min(ae_mm, widest);
  Section s{.ap_mm = ap_mm};
  if (corner <= 0.0) {
    s.arc = immersion_arc(width, d, direction);
    return s;
  }
  s.csa_mm2 = ap_mm * width;
  if (width >= widest) {
    s.arc = {0.0, std::numbers::pi};
    return s;
  }
  s.band_mm = width;
  // The pass before is ae away: the two corners meet half way, the flanks at a whole step.
  const double outer = std::min(widest / d, 1.0);
  const double inner =
      std::clamp(std::min(0.5 * d - corner - 0.5 * width, 0.5 * widest - width) / (0.5 * d), -1.0, outer);
  s.arc = direction == CutDirection::kUp ? ImmersionArc{std::acos(outer), std::acos(inner)}
                                         : ImmersionArc{std::acos(-inner), std::acos(-outer)};
  return s;
}

}  // namespace capstan::mechanics

#include "planner/physics/mechanics/bending/deflection.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "planner/physics/mechanics/constants.h"
#include "planner/physics/mechanics/force/domain.h"

namespace capstan::mechanics {
namespace {

constexpr double cube(double x) { return x * x * x; }

double second_moment_mm4(double d) { return std::numbers::pi * d * cube(d) / 64.0; }

Status check(const ToolStiffness& t) {
  return check_positive({{"stickout_mm", t.stickout_mm},
                         {"shank_diameter_mm", t.shank_diameter_mm},
                         {"flute_length_mm", t.flute_length_mm},
                         {"cutting_diameter_mm", t.cutting_diameter_mm},
                         {"youngs_modulus_n_mm2", t.youngs_modulus_n_mm2}});
}

}  // namespace

Result<double> tip_compliance_mm_n(const ToolStiffness& tool) {
  if (auto s = check(tool); !s) return fail(s.error());
  const double flutes = std::min(tool.flute_length_mm, tool.stickout_mm);
  const double flute_d = kFluteEquivalentDiameterRatio * tool.cutting_diameter_mm;
  return (cube(flutes) / second_moment_mm4(flute_d) +
          (cube(tool.stickout_mm) - cube(flutes)) / second_moment_mm4(tool.shank_diameter_mm)) /
         (3.0 * tool.youngs_modulus_n_mm2);
}

}  // namespace capstan::mechanics

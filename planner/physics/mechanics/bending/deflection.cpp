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

Result<double> tip_stiffness_n_mm(const ToolStiffness& tool) {
  return tip_compliance_mm_n(tool).map([](double c) { return 1.0 / c; });
}

Result<double> bending_stress_n_mm2(const ToolStiffness& tool, double force_n) {
  if (auto s = check(tool); !s) return fail(s.error());
  if (!(std::isfinite(force_n) && force_n >= 0.0)) {
    return fail(Diagnostic{
        .code = "MECH-DOMAIN", .message = "the force is negative or not finite", .path = "force_n"});
  }
  const auto stress = [&](double arm, double d) {
    return 32.0 * force_n * arm / (std::numbers::pi * cube(d));
  };
  const double flutes = std::min(tool.flute_length_mm, tool.stickout_mm);
  const double in_flutes = stress(flutes, kFluteEquivalentDiameterRatio * tool.cutting_diameter_mm);
  if (flutes >= tool.stickout_mm) return in_flutes;
  return std::max(in_flutes, stress(tool.stickout_mm, tool.shank_diameter_mm));
}

}  // namespace capstan::mechanics

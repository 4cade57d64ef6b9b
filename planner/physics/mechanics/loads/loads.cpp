#include "planner/physics/mechanics/loads/loads.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "planner/physics/mechanics/constants.h"
#include "planner/physics/mechanics/force/domain.h"
#include "planner/physics/mechanics/force/force.h"
#include "planner/physics/mechanics/force/immersion.h"

namespace capstan::mechanics {
namespace {

Status check(const MillingCut& cut, const WorkMaterial& work) {
  constexpr double kSteepestHelixRad = 1.3962634015954636;  // 80 degrees: tan stays moderate
  if (auto s = check_positive({{"ap_mm", cut.ap_mm},
                               {"ae_mm", cut.ae_mm},
                               {"fz_mm", cut.fz_mm},
                               {"n_rpm", cut.n_rpm},
                               {"cutting_diameter_mm", cut.cutting_diameter_mm},
                               {"teeth", static_cast<double>(cut.teeth)},
                               {"kc11_n_mm2", work.kc11_n_mm2}});
      !s) {
    return s;
  }
  // So that no sum over teeth is endless: no cutter has a thousand, or an edge of 160 turns.
  if (auto s = check_range({"teeth", static_cast<double>(cut.teeth)}, 1.0, 1000.0); !s) return s;
  if (auto s = check_range({"ae_mm", cut.ae_mm}, 0.0, cut.cutting_diameter_mm); !s) return s;
  if (auto s = check_range({"helix_rad", cut.helix_rad}, 0.0, kSteepestHelixRad); !s) return s;
  if (auto s = check_range({"corner_radius_mm", cut.corner_radius_mm}, 0.0, 0.5 * cut.cutting_diameter_mm);
      !s) {
    return s;
  }
  const double lag = helix_lag_rad(cut.ap_mm, cut.cutting_diameter_mm, cut.helix_rad);
  if (auto s = check_range({"lag of the helix, rad", lag}, 0.0, 1000.0); !s) return s;
  return check_range({"mc", work.mc}, 0.0, 0.999);
}

}  // namespace

Result<Loads> milling_loads(const MillingCut& cut, const WorkMaterial& work, const ToolStiffness& tool) {
  if (auto s = check(cut, work); !s) return fail(s.error());
  const auto compliance = tip_compliance_mm_n(tool);
  if (!compliance) return fail(compliance.error());

  const double corner = cut.ball ? 0.5 * cut.cutting_diameter_mm : cut.corner_radius_mm;
  const double diameter = effective_diameter_mm(cut.ap_mm, cut.cutting_diameter_mm, corner);
  const double width = std::min(cut.ae_mm, diameter);
  const EdgeAngle edge = edge_angle(cut.ap_mm, corner);

  Loads loads;
  loads.h_max_mm = max_chip_thickness_mm(cut.fz_mm, width, diameter, edge.max_sin_kappa);
  loads.h_mean_mm = mean_chip_thickness_mm(cut.fz_mm, width, diameter, edge.mean_sin_kappa);
  loads.mrr_mm3_min = removal_rate_mm3_min(cut.ap_mm, cut.ae_mm, cut.fz_mm * cut.teeth * cut.n_rpm);
  loads.power_w = cutting_power_w(loads.mrr_mm3_min, specific_force_n_mm2(work, loads.h_mean_mm));
  loads.torque_nm = spindle_torque_nm(loads.power_w, cut.n_rpm);
  loads.mean_tangential_force_n = 2000.0 * loads.torque_nm / diameter;
  for (const CutDirection direction : {CutDirection::kUp, CutDirection::kDown}) {
    const double peak =
        peak_kienzle_force_n(work, kRadialToTangentialRatio, cut.teeth, cut.ap_mm, cut.fz_mm, diameter,
                             cut.helix_rad, edge.mean_sin_kappa, immersion_arc(width, diameter, direction));
    loads.peak_force_n = std::max(loads.peak_force_n, peak);
  }
  loads.deflection_mm = loads.peak_force_n * *compliance;
  return loads;
}

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
  // The pass before stands ae away: the two corners meet half way, the flanks a whole step.
  const double outer = std::min(widest / d, 1.0);
  const double inner =
      std::clamp(std::min(0.5 * d - corner - 0.5 * width, 0.5 * widest - width) / (0.5 * d), -1.0, outer);
  s.arc = direction == CutDirection::kUp ? ImmersionArc{std::acos(outer), std::acos(inner)}
                                         : ImmersionArc{std::acos(-inner), std::acos(-outer)};
  return s;
}

Result<Loads> milling_loads(const MillingCut& cut, const Tooth& tooth, const ForceLaw& law,
                            const ToolStiffness& tool) {
  if (auto s = check_positive({{"ap_mm", cut.ap_mm}, {"ae_mm", cut.ae_mm}}); !s) return fail(s.error());
  if (auto s = check_range({"ae_mm", cut.ae_mm}, 0.0, tooth.cutting_diameter_mm); !s) return fail(s.error());
  const auto compliance = tip_compliance_mm_n(tool);
  if (!compliance) return fail(compliance.error());
  Loads loads;
  for (const CutDirection direction : {CutDirection::kUp, CutDirection::kDown}) {
    const auto l =
        section_loads(side_section(cut.ap_mm, cut.ae_mm, tooth, direction), tooth, law, cut.fz_mm, cut.n_rpm);
    if (!l) return fail(l.error());
    loads.peak_force_n = std::max(loads.peak_force_n, l->peak_force_n);
    loads.power_w = std::max(loads.power_w, l->power_w);
    loads.torque_nm = std::max(loads.torque_nm, l->torque_nm);
    loads.h_max_mm = std::max(loads.h_max_mm, l->h_max_mm);
    loads.h_mean_mm = l->h_mean_mm;
  }
  loads.mrr_mm3_min = removal_rate_mm3_min(cut.ap_mm, cut.ae_mm, cut.fz_mm * tooth.teeth * cut.n_rpm);
  const double diameter =
      effective_diameter_mm(cut.ap_mm, tooth.cutting_diameter_mm,
                            std::min(tooth.corner_radius_mm, 0.5 * tooth.cutting_diameter_mm));
  loads.mean_tangential_force_n = 2000.0 * loads.torque_nm / diameter;
  loads.deflection_mm = loads.peak_force_n * *compliance;
  return loads;
}

}  // namespace capstan::mechanics

#include "planner/physics/mechanics/force/drilling.h"

#include <cmath>
#include <numbers>

#include "planner/physics/mechanics/constants.h"
#include "planner/physics/mechanics/force/domain.h"

namespace capstan::mechanics {
namespace {

Status check(const WorkMaterial& work) {
  if (auto s = check_positive({{"kc11_n_mm2", work.kc11_n_mm2}}); !s) return s;
  return check_range({"mc", work.mc}, 0.0, 0.999);
}

}  // namespace

Result<DrillingLoads> drilling_loads(const DrillingCut& cut, const WorkMaterial& work) {
  if (auto s = check_positive({{"diameter_mm", cut.diameter_mm},
                               {"feed_mm_per_rev", cut.feed_mm_per_rev},
                               {"n_rpm", cut.n_rpm},
                               {"teeth", static_cast<double>(cut.teeth)},
                               {"point_angle_rad", cut.point_angle_rad}});
      !s) {
    return fail(s.error());
  }
  if (auto s = check_range({"point_angle_rad", cut.point_angle_rad}, 0.1, std::numbers::pi); !s) {
    return fail(s.error());
  }
  if (!(cut.pre_hole_diameter_mm >= 0.0 && cut.pre_hole_diameter_mm < cut.diameter_mm)) {
    return fail(Diagnostic{.code = "MECH-DOMAIN",
                           .message = "the hole before is not smaller than the tool",
                           .path = "pre_hole_diameter_mm"});
  }
  if (auto s = check(work); !s) return fail(s.error());

  const double sin_kappa = std::sin(0.5 * cut.point_angle_rad);
  const double outer = cut.diameter_mm;
  const double inner = cut.pre_hole_diameter_mm;
  const double ring_mm2 = (outer - inner) * (outer + inner);
  DrillingLoads loads;
  loads.chip_thickness_mm = cut.feed_mm_per_rev / cut.teeth * sin_kappa;
  loads.specific_force_n_mm2 = specific_force_n_mm2(work, loads.chip_thickness_mm);
  loads.torque_nm = loads.specific_force_n_mm2 * cut.feed_mm_per_rev * ring_mm2 / 8000.0;
  loads.thrust_n = kDrillThrustFactor * loads.specific_force_n_mm2 * cut.feed_mm_per_rev * 0.5 *
                   (outer - inner) * sin_kappa;
  loads.power_w = loads.torque_nm * 2.0 * std::numbers::pi * cut.n_rpm / 60.0;
  loads.removal_mm3_min = 0.25 * std::numbers::pi * ring_mm2 * cut.feed_mm_per_rev * cut.n_rpm;
  return loads;
}

Result<DrillingLoads> reaming_loads(const DrillingCut& cut, const WorkMaterial& work) {
  auto loads = drilling_loads(cut, work);
  if (!loads) return loads;
  loads->torque_nm *= kReamingFrictionFactor;
  loads->power_w *= kReamingFrictionFactor;
  return loads;
}

TappingCut tapping_cut_of(const model::Cutter& tap, double core_hole_mm, double n_rpm) {
  TappingCut out;
  out.nominal_diameter_mm = tap.cutting_diameter_mm;
  out.pitch_mm = tap.thread_pitch_mm;
  out.core_hole_diameter_mm =
      core_hole_mm > 0.0 ? core_hole_mm : tap.cutting_diameter_mm - tap.thread_pitch_mm;
  out.n_rpm = n_rpm;
  if (tap.teeth > 0) out.flutes = tap.teeth;
  if (tap.lead_threads > 0.0) out.chamfer_threads = tap.lead_threads;
  return out;
}

Result<TappingLoads> tapping_loads(const TappingCut& cut, const WorkMaterial& work) {
  if (auto s = check_positive({{"nominal_diameter_mm", cut.nominal_diameter_mm},
                               {"core_hole_diameter_mm", cut.core_hole_diameter_mm},
                               {"pitch_mm", cut.pitch_mm},
                               {"n_rpm", cut.n_rpm},
                               {"flutes", static_cast<double>(cut.flutes)},
                               {"chamfer_threads", cut.chamfer_threads},
                               {"height_mm", cut.nominal_diameter_mm - cut.core_hole_diameter_mm}});
      !s) {
    return fail(s.error());
  }
  if (auto s = check_range({"half_angle_rad", cut.half_angle_rad}, 0.05, 1.0); !s) return fail(s.error());
  if (auto s = check(work); !s) return fail(s.error());

  const double outer = cut.nominal_diameter_mm;
  const double inner = cut.core_hole_diameter_mm;
  TappingLoads loads;
  loads.chip_thickness_mm = 0.5 * (outer - inner) / (cut.flutes * cut.chamfer_threads);
  const double kc = specific_force_n_mm2(work, loads.chip_thickness_mm);
  loads.torque_nm = std::tan(cut.half_angle_rad) * kc * kTappingTorqueFactor * (outer - inner) *
                    (outer - inner) * (outer + 2.0 * inner) / 24000.0;
  loads.power_w = loads.torque_nm * 2.0 * std::numbers::pi * cut.n_rpm / 60.0;
  return loads;
}

}  // namespace capstan::mechanics

#pragma once

#include "planner/ground/base/result.h"
#include "planner/model/plan/cutter/cutter.h"
#include "planner/physics/mechanics/force/kienzle.h"

/// Torque, thrust and power of drilling, enlarging, reaming and tapping.
namespace capstan::mechanics {

/// A drill, core drill, counterbore or reamer fed along its axis.
struct DrillingCut {
  double diameter_mm = 0.0;
  double feed_mm_per_rev = 0.0;
  double n_rpm = 0.0;
  int teeth = 2;
  double point_angle_rad = 0.0;       ///< SIG, tip to tip; pi for a flat cutter
  double pre_hole_diameter_mm = 0.0;  ///< 0: into the solid
};

struct DrillingLoads {
  double chip_thickness_mm = 0.0;
  double specific_force_n_mm2 = 0.0;
  double torque_nm = 0.0;
  double thrust_n = 0.0;
  double power_w = 0.0;  ///< at the tool
  double removal_mm3_min = 0.0;
};

/// Into the solid (d = 0) or enlarging a hole of diameter d:
///
///     h = f / z sin(SIG / 2)      kc = kc1.1 h^-mc
///     M  = kc f (D^2 - d^2) / 8                    F = 0.63 kc f (D - d) / 2 sin(SIG / 2)
///
/// Fails     MECH-DOMAIN on a value that is not finite or not positive, or d >= D.
/// Source    Iscar, Rotating Tools catalogue 2017, p. 601 (Mc, Ff; its factor sin k in the torque, at
///           most 1, is left out, on the safe side); h and kc by Kienzle's law.
/// Uncertainty  kForceUncertaintyFactor on kc; the maker's own example is met within 0.3 %.
/// Accuracy  the chisel edge is inside the factor of thrust; a dull drill asks for kWearForceFactor more.
[[nodiscard]] Result<DrillingLoads> drilling_loads(const DrillingCut& cut, const WorkMaterial& work);

/// A reamer: as enlarging, times kReamingFrictionFactor (torque and power).
/// Source: reaming by the formulas of core drilling, Youssef & El-Hofy, Fundamentals of Machining
/// Processes, section 5.4.3; the friction factor is a default without a source.
[[nodiscard]] Result<DrillingLoads> reaming_loads(const DrillingCut& cut, const WorkMaterial& work);

/// A cutting tap in its core hole.
struct TappingCut {
  double nominal_diameter_mm = 0.0;
  double core_hole_diameter_mm = 0.0;
  double pitch_mm = 0.0;
  double n_rpm = 0.0;
  int flutes = 3;
  double chamfer_threads = 2.5;                ///< threads on the chamfer
  double half_angle_rad = 0.5235987755982988;  ///< of the thread's flanks; 30 degrees
};

/// What a tap cuts at a speed. `core_hole_mm` 0: the hole is not known, as wide as the nominal diameter less
/// the pitch. Teeth and threads of the chamfer that the cutter does not state are TappingCut's.
[[nodiscard]] TappingCut tapping_cut_of(const model::Cutter& tap, double core_hole_mm, double n_rpm);

struct TappingLoads {
  double chip_thickness_mm = 0.0;
  double torque_nm = 0.0;
  double power_w = 0.0;
};

/// M = tan(half angle) kc K (D - d)^2 (D + 2 d) / 24000, in Nm, K = kTappingTorqueFactor.
///
/// kc is Kienzle's for the chip of one chamfer tooth, h = (D - d) / 2 / (flutes * chamfer threads).
/// Forming taps ask two to three times as much (same source) and are not covered.
/// Fails     MECH-DOMAIN.
/// Source    Yamawa, catalogue 2021, p. 639; h derived from the chamfer's geometry.
[[nodiscard]] Result<TappingLoads> tapping_loads(const TappingCut& cut, const WorkMaterial& work);

}  // namespace capstan::mechanics

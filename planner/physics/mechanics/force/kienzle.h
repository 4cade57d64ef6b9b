#pragma once

#include <cmath>
#include <numbers>

/// Specific cutting force after Kienzle (VDI-Z 94, 1952), and what follows from it: power and torque.
namespace capstan::mechanics {

/// Kienzle's coefficients of a work material. The model's nouns hold them; callers pass them in.
struct WorkMaterial {
  double kc11_n_mm2 = 0.0;  ///< specific force for a chip of 1 mm by 1 mm
  double mc = 0.0;          ///< exponent of the chip thickness, 0 <= mc < 1
};

/// kc = kc1.1 h^-mc, in N/mm2.
///
/// Needs     h > 0. Fitted for kKienzleMinChipThicknessMm .. kKienzleMaxChipThicknessMm; beyond, it is an
///           extrapolation. Tables differ in what is already inside kc1.1 (rake angle, chip compression
///           of milling 1.2): do not correct twice.
/// Uncertainty  the fits of a maker's table are within 5 % of its points (kienzle_test.cpp); the table
/// against
///           the next batch, tool and edge: kForceUncertaintyFactor, see force_law.h.
[[nodiscard]] inline double specific_force_n_mm2(const WorkMaterial& work, double h_mm) {
  return work.kc11_n_mm2 * std::pow(h_mm, -work.mc);
}

/// Cutting power at the tool from the removal rate: P = Q kc / 60000, in W.
[[nodiscard]] inline double cutting_power_w(double removal_mm3_min, double kc_n_mm2) {
  return removal_mm3_min * kc_n_mm2 / 60000.0;
}

/// M = 60 P / (2 pi n), in Nm.
[[nodiscard]] inline double spindle_torque_nm(double power_w, double n_rpm) {
  return 60.0 * power_w / (2.0 * std::numbers::pi * n_rpm);
}

/// The mean over a revolution of the tangential force of all teeth:
///
///     F = kc(h_mean) ap fz ae z / (pi D)        (so that F v is the power of Q kc)
[[nodiscard]] inline double mean_tangential_force_n(double kc_n_mm2, double ap_mm, double ae_mm, double fz_mm,
                                                    int teeth, double diameter_mm) {
  return kc_n_mm2 * ap_mm * fz_mm * ae_mm * static_cast<double>(teeth) / (std::numbers::pi * diameter_mm);
}

}  // namespace capstan::mechanics

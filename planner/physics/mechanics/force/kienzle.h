#pragma once

#include <cmath>
#include <numbers>
#include <vector>

#include "planner/ground/base/result.h"

/// Specific cutting force after Kienzle (VDI-Z 94, 1952), and what follows from it: power and torque.
namespace capstan::mechanics {

/// What a work material asks for. The nouns of the model hold the values; callers hand them in.
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
template <class T>
[[nodiscard]] T specific_force_n_mm2(const WorkMaterial& work, const T& h_mm) {
  using std::pow;
  return work.kc11_n_mm2 * pow(h_mm, -work.mc);
}

/// Q = ap ae vf, in mm3/min.
template <class T>
[[nodiscard]] T removal_rate_mm3_min(const T& ap_mm, const T& ae_mm, const T& feed_mm_min) {
  return ap_mm * ae_mm * feed_mm_min;
}

/// Cutting power at the tool from the removal rate: P = Q kc / 60000, in W.
template <class T>
[[nodiscard]] T cutting_power_w(const T& removal_mm3_min, const T& kc_n_mm2) {
  return removal_mm3_min * kc_n_mm2 / 60000.0;
}

/// The same power from the mean tangential force: P = F v / 60, v in m/min. In W.
template <class T>
[[nodiscard]] T power_from_force_w(const T& tangential_force_n, const T& speed_m_min) {
  return tangential_force_n * speed_m_min / 60.0;
}

/// What the motor must give for a power at the tool.
template <class T>
[[nodiscard]] T motor_power_w(const T& cutting_power_w, double efficiency) {
  return cutting_power_w / efficiency;
}

/// M = 60 P / (2 pi n), in Nm.
template <class T>
[[nodiscard]] T spindle_torque_nm(const T& power_w, const T& n_rpm) {
  return 60.0 * power_w / (2.0 * std::numbers::pi * n_rpm);
}

/// The mean over a revolution of the tangential force of all teeth:
///
///     F = kc(h_mean) ap fz ae z / (pi D)        (so that F v is the power of Q kc)
template <class T>
[[nodiscard]] T mean_tangential_force_n(const T& kc_n_mm2, const T& ap_mm, const T& ae_mm, const T& fz_mm,
                                        int teeth, const T& diameter_mm) {
  return kc_n_mm2 * ap_mm * fz_mm * ae_mm * static_cast<double>(teeth) / (std::numbers::pi * diameter_mm);
}

/// One row of a table of specific cutting force.
struct SpecificForcePoint {
  double h_mm = 0.0;
  double kc_n_mm2 = 0.0;
};

struct KienzleFit {
  WorkMaterial work;
  double max_relative_error = 0.0;  ///< largest |fit / table - 1|
};

/// Least squares of log kc over log h.
///
/// Needs     two points of different h, all positive and finite; the argument is what the table's
///           argument is (some tables state feed per tooth, not chip thickness).
/// Fails     MECH-FIT-POINTS.
[[nodiscard]] Result<KienzleFit> fit_kienzle(const std::vector<SpecificForcePoint>& points);

}  // namespace capstan::mechanics

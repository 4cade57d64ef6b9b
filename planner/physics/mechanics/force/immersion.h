#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>

/// Where a milling tooth is in the material, and how thick its chip is.
///
/// Frame     the plane normal to the tool axis. The rotation angle counts from the direction normal to
///           the feed, in the sense of rotation: a tooth cuts h = fz sin(angle) at `angle` (Altintas,
///           Manufacturing Automation, 2nd ed., section 2.7). Straight pass, straight stock.
/// Range     the tooth's path is taken for a circle; the chip of the true trochoid differs by about
///           z fz / (pi D) of it (1 % for four teeth, 0.1 mm, 12 mm; derived).
/// Needs     positive finite lengths; not checked here but at the door (section.h).
namespace capstan::mechanics {

/// The rotation for which one tooth stays in the material, from the radial width of cut:
///
///     phi = acos(1 - 2 ae / D) = 2 std::atan2(std::sqrt(ae), std::sqrt(D - ae))       slot: pi     half: pi
///     / 2
///
/// Needs     0 <= ae <= D. The slope is infinite at both ends.
/// Accuracy  relative error at most kImmersionError; the second form has no cancellation at either end.
/// Source    chord geometry.
[[nodiscard]] inline double immersion_angle_rad(double ae_mm, double diameter_mm) {
  return 2.0 * std::atan2(std::sqrt(ae_mm), std::sqrt(diameter_mm - ae_mm));
}

/// A few units in the last place.
inline constexpr double kImmersionError = 1e-15;

enum class CutDirection { kUp, kDown };

/// From where to where a tooth cuts.
struct ImmersionArc {
  double entry_rad = 0.0;
  double exit_rad = 0.0;
};

/// Up milling: 0 .. phi. Down (climb) milling: pi - phi .. pi. A slot is 0 .. pi either way.
[[nodiscard]] inline ImmersionArc immersion_arc(double ae_mm, double diameter_mm, CutDirection direction) {
  const double phi = immersion_angle_rad(ae_mm, diameter_mm);
  if (direction == CutDirection::kUp) return {0.0, phi};
  return {std::numbers::pi - phi, std::numbers::pi};
}

/// The thickest chip of a side cut:
///
///     h_max = 2 fz std::sqrt(r (1 - r)) sin(kappa)   for r = ae / D <= 1/2,   else fz sin(kappa)
///
/// Beyond half immersion the tooth passes the place of the full feed: the first form would fall again
/// and let an optimiser run to a full slot at any feed.
[[nodiscard]] inline double max_chip_thickness_mm(double fz_mm, double ae_mm, double diameter_mm,
                                                  double sin_kappa = 1.0) {
  const double r = ae_mm / diameter_mm;
  if (r >= 0.5) return fz_mm * sin_kappa;
  return 2.0 * sin_kappa * fz_mm * std::sqrt(r * (1.0 - r));
}

/// The mean over the arc: h_mean = 2 fz r sin(kappa) / phi, for any r in (0, 1].
[[nodiscard]] inline double mean_chip_thickness_mm(double fz_mm, double ae_mm, double diameter_mm,
                                                   double sin_kappa = 1.0) {
  return 2.0 * sin_kappa * fz_mm * (ae_mm / diameter_mm) / immersion_angle_rad(ae_mm, diameter_mm);
}

/// The largest diameter that cuts, of a cutter with corner radius r at depth ap:
///
///     D_eff = D - 2 r + 2 std::sqrt(ap (2 r - ap))   for ap < r, else D       ball: r = D / 2
///
/// Source    circle geometry; for a ball it is the usual 2 std::sqrt(ap (D - ap)).
[[nodiscard]] inline double effective_diameter_mm(double ap_mm, double diameter_mm, double corner_radius_mm) {
  if (ap_mm >= corner_radius_mm) return diameter_mm;
  return diameter_mm - 2.0 * corner_radius_mm + 2.0 * std::sqrt(ap_mm * (2.0 * corner_radius_mm - ap_mm));
}

/// Mean number of teeth in the material: z phi / (2 pi).
[[nodiscard]] inline double mean_engaged_teeth(int teeth, double immersion_rad) {
  return teeth * immersion_rad / (2.0 * std::numbers::pi);
}

/// How far a helical edge at depth ap lags behind its tip: 2 ap tan(helix) / D.
[[nodiscard]] inline double helix_lag_rad(double ap_mm, double diameter_mm, double helix_rad) {
  return 2.0 * ap_mm * std::tan(helix_rad) / diameter_mm;
}

}  // namespace capstan::mechanics

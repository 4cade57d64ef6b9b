#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>

/// Where a milling tooth is in the material, and how thick its chip is.
///
/// Frame     the plane normal to the tool axis. The rotation angle counts from the direction normal to
///           the feed, in the sense of rotation: a tooth cuts h = fz sin(angle) at `angle` (Altintas,
///           Manufacturing Automation, 2nd ed., section 2.7). Straight pass, straight stock.
/// Numbers   the functions take any number type T that has the arithmetic of double (found by argument
///           lookup), so that an optimiser can differentiate them.
/// Range     the tooth's path is taken for a circle; the chip of the true trochoid differs by about
///           z fz / (pi D) of it (1 % for four teeth, 0.1 mm, 12 mm; derived).
/// Needs     positive finite lengths; not checked here but at the doors (loads.h).
namespace capstan::mechanics {

/// The rotation for which one tooth stays in the material, from the radial width of cut:
///
///     phi = acos(1 - 2 ae / D) = 2 atan2(sqrt(ae), sqrt(D - ae))       slot: pi     half: pi / 2
///
/// Needs     0 <= ae <= D. The slope is infinite at both ends: differentiate inside only.
/// Accuracy  relative error at most kImmersionError; the second form has no cancellation at either end.
/// Source    chord geometry.
template <class T>
[[nodiscard]] T immersion_angle_rad(const T& ae_mm, const T& diameter_mm) {
  using std::atan2;
  using std::sqrt;
  return 2.0 * atan2(sqrt(ae_mm), sqrt(diameter_mm - ae_mm));
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
///     h_max = 2 fz sqrt(r (1 - r)) sin(kappa)   for r = ae / D <= 1/2,   else fz sin(kappa)
///
/// Beyond half immersion the tooth passes the place of the full feed: the first form would fall again
/// and let an optimiser run to a full slot at any feed.
template <class T>
[[nodiscard]] T max_chip_thickness_mm(const T& fz_mm, const T& ae_mm, const T& diameter_mm,
                                      double sin_kappa = 1.0) {
  using std::sqrt;
  const T r = ae_mm / diameter_mm;
  if (r >= 0.5) return fz_mm * sin_kappa;
  return 2.0 * sin_kappa * fz_mm * sqrt(r * (1.0 - r));
}

/// The mean over the arc: h_mean = 2 fz r sin(kappa) / phi, for any r in (0, 1].
template <class T>
[[nodiscard]] T mean_chip_thickness_mm(const T& fz_mm, const T& ae_mm, const T& diameter_mm,
                                       double sin_kappa = 1.0) {
  return 2.0 * sin_kappa * fz_mm * (ae_mm / diameter_mm) / immersion_angle_rad(ae_mm, diameter_mm);
}

/// The feed per tooth that gives a wanted thickest chip: the reverse of max_chip_thickness_mm (radial
/// chip thinning).
[[nodiscard]] inline double feed_for_chip_thickness_mm(double h_max_mm, double ae_mm, double diameter_mm,
                                                       double sin_kappa = 1.0) {
  return h_max_mm / max_chip_thickness_mm(1.0, ae_mm, diameter_mm, sin_kappa);
}

/// The largest diameter that cuts, of a cutter with corner radius r at depth ap:
///
///     D_eff = D - 2 r + 2 sqrt(ap (2 r - ap))   for ap < r, else D       ball: r = D / 2
///
/// Source    circle geometry; for a ball it is the usual 2 sqrt(ap (D - ap)).
template <class T>
[[nodiscard]] T effective_diameter_mm(const T& ap_mm, double diameter_mm, double corner_radius_mm) {
  using std::sqrt;
  if (ap_mm >= corner_radius_mm) return T(diameter_mm);
  return diameter_mm - 2.0 * corner_radius_mm + 2.0 * sqrt(ap_mm * (2.0 * corner_radius_mm - ap_mm));
}

/// The sine of the cutting edge angle along the engaged edge of a cutter with a corner radius.
struct EdgeAngle {
  double mean_sin_kappa = 1.0;  ///< depth divided by the length of edge in the material
  double max_sin_kappa = 1.0;   ///< at the top of the engaged edge
};

/// A cylinder with a corner radius: the arc below r, straight above. Source: arc length, derived.
[[nodiscard]] inline EdgeAngle edge_angle(double ap_mm, double corner_radius_mm) {
  if (corner_radius_mm <= 0.0) return {};
  const double in_corner = std::min(ap_mm, corner_radius_mm);
  const double angle = immersion_angle_rad(in_corner, 2.0 * corner_radius_mm);  // acos(1 - ap / r)
  const double edge = corner_radius_mm * angle + (ap_mm - in_corner);
  return {ap_mm / edge, ap_mm >= corner_radius_mm ? 1.0 : std::sin(angle)};
}

/// Mean number of teeth in the material: z phi / (2 pi).
[[nodiscard]] inline double mean_engaged_teeth(int teeth, double immersion_rad) {
  return teeth * immersion_rad / (2.0 * std::numbers::pi);
}

/// How far a helical edge at depth ap lags behind its tip: 2 ap tan(helix) / D.
[[nodiscard]] inline double helix_lag_rad(double ap_mm, double diameter_mm, double helix_rad) {
  return 2.0 * ap_mm * std::tan(helix_rad) / diameter_mm;
}

/// Most teeth in the material at once: a tooth is somewhere in it over immersion + helix lag.
[[nodiscard]] inline int max_engaged_teeth(int teeth, double immersion_rad, double lag_rad) {
  constexpr double kRounding = 1e-9;  // a tooth that leaves as the next enters counts once
  const double pitches = (immersion_rad + lag_rad) * teeth / (2.0 * std::numbers::pi);
  return static_cast<int>(std::clamp(std::ceil(pitches - kRounding), 1.0, static_cast<double>(teeth)));
}

/// v = pi D n / 1000, in m/min.
[[nodiscard]] inline double cutting_speed_m_min(double n_rpm, double diameter_mm) {
  return std::numbers::pi * diameter_mm * n_rpm / 1000.0;
}

/// n = 1000 v / (pi D), in 1/min.
[[nodiscard]] inline double spindle_speed_rpm(double speed_m_min, double diameter_mm) {
  return 1000.0 * speed_m_min / (std::numbers::pi * diameter_mm);
}

}  // namespace capstan::mechanics

#pragma once

/// The surface that geometry alone produces, in mm: a lower bound. Measured roughness is larger, and in fine
/// feeds hardly follows f^2 (runout, edge, material).
///
/// Needs     positive finite arguments; the limits below are the caller's to keep.
namespace capstan::mechanics {

/// Mean over peak of a row of shallow arcs: Ra = 4 / (9 sqrt 3) Rz = 0.2566 Rz.
/// Source: mean absolute deviation of a parabola from its mean line; derived. Gives the usual
/// Ra = 0.0321 f^2 / R.
inline constexpr double kArcRaOverRz = 0.25660011963983370;

/// Side wall, feed marks of one tooth (runout: pass the feed per revolution): Rz = fz^2 / (8 R).
[[nodiscard]] inline double wall_rz_mm(double fz_mm, double diameter_mm) {
  return fz_mm * fz_mm / (4.0 * diameter_mm);
}

/// Floor left by a corner radius: Rz = fz^2 / (8 re), for fz well below re.
[[nodiscard]] inline double floor_rz_mm(double fz_mm, double corner_radius_mm) {
  return fz_mm * fz_mm / (8.0 * corner_radius_mm);
}

}  // namespace capstan::mechanics

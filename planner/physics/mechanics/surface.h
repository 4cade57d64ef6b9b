#pragma once

#include <algorithm>
#include <cmath>

/// The surface that geometry alone leaves, in mm: a lower bound. Measured roughness is larger, and in
/// fine feeds hardly follows f^2 (runout, edge, material): treat as what cannot be undercut.
///
/// Needs     positive finite arguments; the limits below are the caller's to keep.
/// Numbers   templates, as in immersion.h, where an optimiser may want a slope.
namespace capstan::mechanics {

/// Mean over peak of a row of shallow arcs: Ra = 4 / (9 sqrt 3) Rz = 0.2566 Rz.
/// Source: mean absolute deviation of a parabola from its mean line; derived. Gives the usual
/// Ra = 0.0321 f^2 / R.
inline constexpr double kArcRaOverRz = 0.25660011963983370;

/// Side wall, feed marks of one tooth (runout: pass the feed per revolution): Rz = fz^2 / (8 R).
template <class T>
[[nodiscard]] T wall_rz_mm(const T& fz_mm, double diameter_mm) {
  return fz_mm * fz_mm / (4.0 * diameter_mm);
}

/// Side wall: Ra = 0.0321 fz^2 / R.
template <class T>
[[nodiscard]] T wall_ra_mm(const T& fz_mm, double diameter_mm) {
  return kArcRaOverRz * wall_rz_mm(fz_mm, diameter_mm);
}

/// A row of marks of height Rz(fz) whose teeth stand out by up to `runout`: no deeper than the marks plus the
/// runout, and no deeper than those of a single tooth that alone leaves its mark, (z fz)^2 in place of fz^2.
/// Range     an upper bound; without runout it is the mark itself. Source: geometry, derived.
[[nodiscard]] inline double rz_with_runout_mm(double mark_rz_mm, int teeth, double runout_mm) {
  const double alone = mark_rz_mm * static_cast<double>(teeth) * static_cast<double>(teeth);
  return std::min(mark_rz_mm + std::max(runout_mm, 0.0), std::max(alone, mark_rz_mm));
}

/// Floor left by a corner radius: Rz = fz^2 / (8 re), for fz well below re.
template <class T>
[[nodiscard]] T floor_rz_mm(const T& fz_mm, double corner_radius_mm) {
  return fz_mm * fz_mm / (8.0 * corner_radius_mm);
}

/// Floor left by straight teeth with an end clearance: Rz = f / (tan(lead) + cot(clearance)).
/// Source: triangle of two straight edges, derived; its Ra is Rz / 4. Tolouei-Rad & Bidhendi 1997 take
/// 318 f / (...) um for Ra of face mills, 27 % more.
template <class T>
[[nodiscard]] T faced_rz_mm(const T& feed_mm, double lead_rad, double clearance_rad) {
  return feed_mm / (std::tan(lead_rad) + 1.0 / std::tan(clearance_rad));
}

/// Step between two neighbouring passes on a floor when the tool leans across the feed by a small angle
/// (bending, beam.h, or a spindle out of square): s tan(tilt).
[[nodiscard]] inline double floor_step_mm(double stepover_mm, double tilt_rad) {
  return stepover_mm * std::tan(std::abs(tilt_rad));
}

/// How hollow a pass of width w is that a tool of diameter D leaves when it leans along the feed:
/// D / 2 sin(tilt) (1 - sqrt(1 - (w / D)^2)), w <= D. Source: the tilted circle seen along the feed, derived.
[[nodiscard]] inline double floor_hollow_mm(double width_mm, double diameter_mm, double tilt_rad) {
  const double q = std::min(width_mm / diameter_mm, 1.0);
  return 0.5 * diameter_mm * std::sin(std::abs(tilt_rad)) * q * q / (1.0 + std::sqrt((1.0 - q) * (1.0 + q)));
}

/// Ridge between two passes of a ball of radius R on a flat: R - sqrt(R^2 - (s/2)^2), s <= 2 R.
[[nodiscard]] inline double scallop_height_mm(double stepover_mm, double ball_radius_mm) {
  const double q = 0.5 * stepover_mm / ball_radius_mm;
  return ball_radius_mm * q * q / (1.0 + std::sqrt((1.0 - q) * (1.0 + q)));  // no cancellation
}

/// The same for small steps: s^2 / (8 R); smaller than the exact height, by (s / 4R)^2 of it.
template <class T>
[[nodiscard]] T scallop_height_approx_mm(const T& stepover_mm, double ball_radius_mm) {
  return stepover_mm * stepover_mm / (8.0 * ball_radius_mm);
}

/// The stepover that leaves a ridge of height h: 2 sqrt(h (2 R - h)), h <= R. Exact reverse.
[[nodiscard]] inline double stepover_for_scallop_mm(double height_mm, double ball_radius_mm) {
  return 2.0 * std::sqrt(height_mm * (2.0 * ball_radius_mm - height_mm));
}

/// The same for small heights: sqrt(8 R h); larger than the exact one.
[[nodiscard]] inline double stepover_for_scallop_approx_mm(double height_mm, double ball_radius_mm) {
  return std::sqrt(8.0 * ball_radius_mm * height_mm);
}

/// Height of the cone that a drill's point leaves below the full diameter: D / (2 tan(SIG / 2)).
[[nodiscard]] inline double drilled_cone_mm(double diameter_mm, double point_angle_rad) {
  return 0.5 * diameter_mm / std::tan(0.5 * point_angle_rad);
}

}  // namespace capstan::mechanics

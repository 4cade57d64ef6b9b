#pragma once

#include "planner/physics/mechanics/force/immersion.h"
#include "planner/physics/mechanics/force/kienzle.h"

/// Forces of a cylindrical end mill in the plane normal to its axis, mean and peak.
///
/// Frame     x along the feed, y normal to it, z along the axis; angles as in immersion.h. Signs as
///           Altintas, Manufacturing Automation, 2nd ed., section 2.7: forces on the tool.
namespace capstan::mechanics {

/// Mechanistic coefficients of one pair of work and tool: per area of chip (c) and per length of edge (e).
struct CuttingCoefficients {
  double ktc_n_mm2 = 0.0;  ///< tangential
  double kte_n_mm = 0.0;
  double krc_n_mm2 = 0.0;  ///< radial
  double kre_n_mm = 0.0;
  double kac_n_mm2 = 0.0;  ///< axial
  double kae_n_mm = 0.0;
};

struct ForceVector {
  double fx_n = 0.0;
  double fy_n = 0.0;
  double fz_n = 0.0;
};

/// The mean over a revolution. It does not depend on the helix.
/// Uncertainty  of all three: the coefficients'; one alloy has published sets of 600 to 1319 N/mm2.
/// Source: Altintas, equation 2.83 (closed integrals of the tooth's force over the arc).
[[nodiscard]] ForceVector mean_milling_force(const CuttingCoefficients& k, int teeth, double ap_mm,
                                             double fz_mm, const ImmersionArc& arc);

/// The largest resultant in the plane over a revolution, teeth and helix integrated in closed form.
///
/// Accuracy  sampled over a tooth pitch and at every entry and exit; within 1e-5 of the supremum.
[[nodiscard]] double peak_milling_force_n(const CuttingCoefficients& k, int teeth, double ap_mm, double fz_mm,
                                          double diameter_mm, double helix_rad, const ImmersionArc& arc);

/// The same peak for a material known by Kienzle's law only:
///
///     dFt = kc1.1 (fz sin(kappa) sin(a))^-mc  fz sin(a) dz        dFr = radial_ratio dFt
///
/// Needs     0 <= mc < 1; sin(kappa) the mean along the edge (1 for a square end mill).
/// Accuracy  integration and sampling within 1e-3; the model itself within kForceUncertaintyFactor,
///           which is not applied here.
/// Source    derived from Kienzle's law; radial_ratio: kRadialToTangentialRatio.
[[nodiscard]] double peak_kienzle_force_n(const WorkMaterial& work, double radial_ratio, int teeth,
                                          double ap_mm, double fz_mm, double diameter_mm, double helix_rad,
                                          double sin_kappa, const ImmersionArc& arc);

}  // namespace capstan::mechanics

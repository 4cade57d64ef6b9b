#pragma once

/// Coefficients of cutting forces, and a force in three components.
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

}  // namespace capstan::mechanics

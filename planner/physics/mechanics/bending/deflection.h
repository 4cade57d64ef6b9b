#pragma once

#include "planner/ground/base/result.h"

/// How far a tool bends under a force at its tip.
namespace capstan::mechanics {

/// A tool as a cantilever of two steps: shank (from the holder), then flutes (to the tip).
///
///     holder |========== shank d_s ==========|~~~~ flutes, 0.8 D ~~~~| <- F
///            |<---------------- stickout L ------------------------->|
///                                            |<----- l_f ----------->|
struct ToolStiffness {
  double stickout_mm = 0.0;
  double shank_diameter_mm = 0.0;
  double flute_length_mm = 0.0;  ///< more than the stick-out: fluted to the holder
  double cutting_diameter_mm = 0.0;
  double youngs_modulus_n_mm2 = 0.0;
};

/// Compliance at the tip, mm/N:
///
///     delta / F = l_f^3 / (3 E I_f) + (L^3 - l_f^3) / (3 E I_s)       I = pi d^4 / 64
///
/// with d = kFluteEquivalentDiameterRatio D in the flutes. The holder and spindle are rigid here: real
/// tips move more. The force is taken at the tip, which is the worst place.
/// Needs     at least one of the lengths positive; 0 < flute_length.
/// Uncertainty  20 % by the flutes' equivalent diameter (0.8 D within 5 %, fourth power); the rigid holder
/// makes
///           it a lower bound. beam.h has necks and holders.
/// Fails     MECH-DOMAIN.
/// Source    Euler-Bernoulli beam, integral of x^2 / (E I) from the tip; derived.
[[nodiscard]] Result<double> tip_compliance_mm_n(const ToolStiffness& tool);

}  // namespace capstan::mechanics

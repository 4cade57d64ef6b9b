#pragma once

#include <optional>

#include "planner/base/result.h"
#include "planner/mechanics/deflection.h"
#include "planner/mechanics/force.h"
#include "planner/mechanics/immersion.h"
#include "planner/mechanics/kienzle.h"

/// The door of this room for a cut as it is measured along a path: one section in, forces, torque and power
/// out.
namespace capstan::mechanics {

/// Where and how deep the teeth are in the material.
///
/// Frame   angles as in immersion.h: 0 at the left of the feed, pi at its right, in the sense of rotation.
struct Section {
  double ap_mm = 0.0;        ///< axial depth of contact
  ImmersionArc arc;          ///< at the cutter's full radius; a plunge: 0 .. 2 pi
  double csa_mm2 = 0.0;      ///< removed volume per length of path; 0: depth times the width of the arc
  double from_tip_mm = 0.0;  ///< height of the contact's lower end above the tip
};

/// What cuts, at which feed and speed.
struct Tooth {
  double cutting_diameter_mm = 0.0;
  double corner_radius_mm = 0.0;  ///< a ball: half the diameter
  double helix_rad = 0.0;
  double lead_angle_rad = 0.0;  ///< PSIR, 0: square shoulder
  double taper_angle_rad = 0.0;
  double runout_mm = 0.0;  ///< total indicated; widens the largest chip of a tooth
  int teeth = 0;
};

/// What the material asks for: measured coefficients where they are known, else Kienzle's law.
struct ForceLaw {
  WorkMaterial kienzle;
  std::optional<CuttingCoefficients> mechanistic;
  /// By how much a force may exceed the computed one: spread of the coefficients; wear is not in it.
  double uncertainty_factor = 1.0;
};

struct SectionLoads {
  ForceVector mean;           ///< over a revolution
  ForceVector peak;           ///< largest by amount of each component, its sign kept
  double peak_force_n = 0.0;  ///< largest resultant in the plane normal to the axis
  double torque_nm = 0.0;     ///< mean
  double peak_torque_nm = 0.0;
  double power_w = 0.0;  ///< mean, at the tool
  double h_max_mm = 0.0, h_mean_mm = 0.0;
};

/// The loads of one section at a feed per tooth and a speed, a sharp edge with mean coefficients; no
/// engagement gives zeros.
///
/// Fails     MECH-DOMAIN: a value that is not finite or out of its range (fz or n not positive, no teeth, an
///           arc that is longer than a turn).
/// Accuracy  integration within 1e-3 of the model; of the model: force.h and ForceLaw::uncertainty_factor.
[[nodiscard]] Result<SectionLoads> section_loads(const Section& section, const Tooth& tooth,
                                                 const ForceLaw& law, double fz_mm, double n_rpm);

}  // namespace capstan::mechanics

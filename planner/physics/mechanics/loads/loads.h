#pragma once

#include "planner/ground/base/result.h"
#include "planner/physics/mechanics/bending/deflection.h"
#include "planner/physics/mechanics/force/kienzle.h"
#include "planner/physics/mechanics/loads/section.h"

/// The door of this room for milling: one cut in, everything it does to tool and machine out.
namespace capstan::mechanics {

/// A straight side cut of constant section.
struct MillingCut {
  double ap_mm = 0.0;
  double ae_mm = 0.0;
  double fz_mm = 0.0;
  double n_rpm = 0.0;
  double cutting_diameter_mm = 0.0;
  int teeth = 0;
  double helix_rad = 0.0;
  double corner_radius_mm = 0.0;
  bool ball = false;  ///< corner radius is then half the diameter, whatever corner_radius_mm says
};

struct Loads {
  double h_max_mm = 0.0;
  double h_mean_mm = 0.0;
  double mean_tangential_force_n = 0.0;
  double peak_force_n = 0.0;   ///< in the plane normal to the axis, over a revolution, sharp tool
  double torque_nm = 0.0;      ///< mean, at the spindle
  double power_w = 0.0;        ///< mean, at the tool: divide by the efficiency for the motor
  double deflection_mm = 0.0;  ///< of the tip under peak_force_n; rigid holder
  double mrr_mm3_min = 0.0;
  friend bool operator==(const Loads&, const Loads&) = default;
};

/// Kienzle's law on the mean chip for power, on the running chip for the peak force (the larger of up and
/// down milling). With a corner radius or a ball, the diameter is the one that cuts at depth ap, and the
/// chip is thinner by the mean sin(kappa) of the engaged edge; ae wider than that diameter is a slot.
///
/// Fails     MECH-DOMAIN: a value that is not finite, not positive; ae > D; helix outside 0 .. 80 degrees;
///           mc outside 0 .. 1.
/// Accuracy  of the material data: kForceUncertaintyFactor and kWearForceFactor are not applied here.
/// Source    immersion.h, kienzle.h, force.h, deflection.h.
[[nodiscard]] Result<Loads> milling_loads(const MillingCut& cut, const WorkMaterial& work,
                                          const ToolStiffness& tool);

/// The same by the law of force that holds for the material, measured coefficients included, and by
/// section.h's integration along the edge: the running chip in place of the mean one for power too (1 to 2 %
/// less than above with Kienzle's law), a corner's or ball's own radius at each height.
///
/// `tooth` says what cuts; cut's diameter, corner, ball, helix and teeth are not used.
/// Fails     MECH-DOMAIN as above and as section_loads.
[[nodiscard]] Result<Loads> milling_loads(const MillingCut& cut, const Tooth& tooth, const ForceLaw& law,
                                          const ToolStiffness& tool);

/// The section of a straight side cut beside an equal pass a step ae away, as angles at the full radius: on a
/// flank the strip of width ae; a corner or ball meets a band of width ae at each height, and the scallop
/// half a step inside its flat (the strip is wider than ae there, the area stays ap ae). ae at least the
/// diameter that cuts at depth ap: a slot.
[[nodiscard]] Section side_section(double ap_mm, double ae_mm, const Tooth& tooth, CutDirection direction);

}  // namespace capstan::mechanics

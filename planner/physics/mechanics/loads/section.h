#pragma once

#include <memory>
#include <optional>

#include "planner/ground/base/result.h"
#include "planner/physics/mechanics/force/force.h"
#include "planner/physics/mechanics/force/immersion.h"
#include "planner/physics/mechanics/force/kienzle.h"

/// The door of this room for a cut as it is measured along a path: one section in, forces, torque and power
/// out.
namespace capstan::mechanics {

/// Where and how deep the teeth are in the material.
///
/// Frame   angles as in immersion.h: 0 at the left of the feed, pi at its right, in the sense of rotation.
struct Section {
  double ap_mm = 0.0;        ///< axial depth of contact
  ImmersionArc arc = {};     ///< at the cutter's full radius; a plunge: 0 .. 2 pi
  double csa_mm2 = 0.0;      ///< removed volume per length of path; 0: depth times the width of the arc
  double from_tip_mm = 0.0;  ///< height of the contact's lower end above the tip
  /// > 0: at each height the material is this wide, from the edge's own radius there inwards, on the side to
  /// which the arc leans. It is the material between two equal passes at this distance. 0: the arc's strip.
  double band_mm = 0.0;
};

/// The cutting edge, and its feed and speed.
struct Tooth {
  double cutting_diameter_mm = 0.0;
  double corner_radius_mm = 0.0;  ///< a ball: half the diameter
  double helix_rad = 0.0;
  double lead_angle_rad = 0.0;  ///< PSIR, 0: square shoulder
  double taper_angle_rad = 0.0;
  double runout_mm = 0.0;  ///< total indicated; widens the largest chip of a tooth
  int teeth = 0;
};

/// Forces of a material: by measured coefficients if they are known, else by Kienzle's law.
struct ForceLaw {
  WorkMaterial kienzle = {};
  std::optional<CuttingCoefficients> mechanistic = {};
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

/// Where the measured area exceeds that of depth and arc by more than this part, the thickest chip is that of
/// the whole feed. Default, unsourced.
inline constexpr double kIrregular = 0.05;

/// The loads of one section at feeds per tooth and speeds, for a sharp edge with mean coefficients; no
/// engagement gives zeros.
///
/// Along the edge, kappa is the angle between it and the plane normal to the axis (pi / 2 on an upright
/// flank, less by lead or taper angle, running from 0 to pi / 2 along a corner or a ball). Per height dz and
/// length of edge dS = dz / sin(kappa), at the rotation angle a:
///
///     h   = fz sin(a) sin(kappa)
///     dFt = kc1.1 h^-mc fz sin(a) dz                    or  Ktc fz sin(a) dz + Kte dS
///     dFr = kRadialToTangentialRatio dFt                or  Krc fz sin(a) dz + Kre dS    normal to the edge
///     dFa = kAxialToTangentialRatio tan(helix) dFt      or  Kac fz sin(a) dz + Kae dS
///     Fx = sum -dFt cos(a) - dFq sin(a)     Fy = sum dFt sin(a) - dFq cos(a)     dFq = dFr sin k + dFa cos k
///     Fz = sum dFa sin(kappa) - dFr cos(kappa)          positive: pulls the tool towards the work
///
/// summed over teeth and along the edge, which lags by 2 z tan(helix) / D. Below the full radius (corner,
/// ball) the arc is the part of the given strip that this radius reaches; above it (lead, taper) the given
/// arc. Where corner or ball reach less of the strip than csa says, the strip is widened, towards the axis
/// first, until the edge sweeps that area (a band likewise); so is a strip that they do not reach at all
/// (without csa: to depth times width).
///
/// Power     of a section with an area is never below the law's force at the whole feed times that area:
///           Ktc csa v_f, or kc1.1 fz^-mc csa v_f.
///
/// Runout    shifts the teeth against one another by up to e = runout sin(pi / z). The thickest chip is
///           min(h + e, z h); peaks are those of all teeth at the feed that has this chip (no smaller than
///           the truth: not all teeth are the longest one). Means do not change.
/// Area      csa below depth times width (irregular section): mean torque and power keep the chip's volume,
///           in chips thinner by the same ratio (dearer by ratio^-mc; edge forces stay whole); mean and peak
///           forces and peak torque stay those of the full depth and arc, not smaller than the truth. Above:
///           everything grows in that ratio, and h_max is that of the whole feed. Depth or arc zero with an
///           area: a contact of that area about the front (pi / 2); without depth, as deep as the diameter
///           is wide at most.
/// Plunge    (arc 0 .. 2 pi; fz along the axis; csa the area seen along the axis, 0: the whole disc.) Torque
///           and power of csa in chips of fz; thrust as drilling.h's into the solid; the force in the plane
///           is that of a single tooth over the whole radius: a bound for unevenly met teeth.
/// Monotone  every load rises with fz: with fz^(1 - mc), or linearly (mean) and convexly (peak).
/// Fails     MECH-DOMAIN: a value that is not finite, negative, or out of its range (fz or n not positive, no
///           teeth, an arc longer than a turn or running backwards), or an area where there is no edge.
/// Accuracy  integration within 3e-3 of the model on a straight edge (mean forces of measured coefficients:
///           exact), within 3 % where a corner or ball is cut by a narrow strip; of the model: force.h and
///           ForceLaw::uncertainty_factor, which is not applied here.
/// Source    Altintas, Manufacturing Automation, 2nd ed., sections 2.7 and 2.8 (general end mill); Kienzle's
///           law in it, runout and area: derived.
///
/// What does not depend on feed and speed (pieces of the edge, integrals of the chip over their arcs) is
/// worked out once, by `of`.
class SectionAtFeeds {
 public:
  /// Refuses what is wrong of section, tooth and law; `at` what is wrong of feed and speed.
  [[nodiscard]] static Result<SectionAtFeeds> of(const Section& section, const Tooth& tooth,
                                                 const ForceLaw& law);
  [[nodiscard]] Result<SectionLoads> at(double fz_mm, double n_rpm) const;

 private:
  struct Shape;
  std::shared_ptr<const Shape> shape_;
};

/// The h_max_mm of SectionAtFeeds alone, without the integrals that loads need and that take longest.
class ThickestChip {
 public:
  /// Refuses what SectionAtFeeds::of refuses.
  [[nodiscard]] static Result<ThickestChip> of(const Section& section, const Tooth& tooth,
                                               const ForceLaw& law);
  [[nodiscard]] double at_mm(double fz_mm) const;

 private:
  bool plunge_ = false, nothing_ = true;
  double runout_mm_ = 0.0;
  int teeth_ = 0;
  double front_sin_ = 0.0;  ///< largest sine of the rotation angle
  double over_feed_ = 0.0;  ///< of an even cutter
};

/// What SectionAtFeeds::of refuses, and nothing else: for a caller who integrates along the edge himself.
[[nodiscard]] Status check_shape(const Section& section, const Tooth& tooth, const ForceLaw& law);

}  // namespace capstan::mechanics

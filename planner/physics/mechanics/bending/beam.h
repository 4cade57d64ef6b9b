#pragma once

#include <vector>

#include "planner/ground/base/result.h"
#include "planner/model/plan/cutter/cutter.h"

/// Tool and holder as a stepped beam.
namespace capstan::mechanics {

/// A piece of constant stiffness; from the tip up.
struct BeamSegment {
  double length_mm = 0.0;
  double diameter_mm = 0.0;  ///< of the plain cylinder that bends alike
  double youngs_modulus_n_mm2 = 0.0;
};

/// A cantilever, force and place counted from the tip. Bending alone: shear would add 0.5 (d / L)^2 of it (6
/// % at three diameters, 2 % at five; derived for a plain cylinder), and clamping is not soft here.
struct ToolBeam {
  std::vector<BeamSegment> segments;
};

/// Young's modulus of a holder of steel, N/mm2. Source: as kHssYoungsModulusNMm2, the soft end of tool
/// steels.
inline constexpr double kHolderYoungsModulusNMm2 = 200e3;

/// Flutes (kFluteEquivalentDiameterRatio D, or of the corresponding mean of a tapered one), neck, shank, then
/// the holder's outline as far as it is known, each frustum with its smaller diameter (not too stiff).
///
/// A stick-out that is not known is the usable length, but at least three diameters; a shank that is not
/// known is as thick as the cutter (both defaults, unsourced). Fails     MECH-DOMAIN for a cutter without a
/// diameter. Uncertainty  the diameter of the flutes: 0.8 D within about 5 % (Kops & Vo), 20 % of the
/// compliance. Holder,
///           clamping and spindle of a real machine often add as much again as a short tool: rigid is the
///           lower bound.
[[nodiscard]] Result<ToolBeam> beam_of(const model::Cutter& cutter);

/// Bending at `seen_mm` per force at `force_mm` above the tip, mm/N:
///
///     int_{max(a,b)}^{L} (x - a)(x - b) / (E I) dx
///
/// Symmetric (Maxwell). A place above the beam's end does not move.
/// Source    Euler-Bernoulli, unit load; derived.
[[nodiscard]] double bending_mm_n(const ToolBeam& beam, double force_mm, double seen_mm);

/// Bending of the tip per force at the tip, mm/N: flutes, neck, shank and the holder's outline as in beam_of.
/// Fails     as beam_of.
[[nodiscard]] Result<double> tip_compliance_mm_n(const model::Cutter& cutter);

/// Bending of the tip at which the tool's own material begins to tire, mm, by a force at `force_mm` above the
/// tip: the flutes, a neck and the shank bear kCarbideEnduranceNMm2 or kHssEnduranceNMm2 in their outer
/// fibre,
///
///     max(M d / 2 / I) = endurance,     the fibre of the flutes at half the cutting diameter
///
/// Proportional to the square of a tool's length over its diameter: 0.02 mm at 1 mm, 0.2 mm at 10 mm.
/// Fails     as beam_of.
/// Uncertainty  the equivalent diameter's 5 % of the flutes, 15 % of the stress; torsion is left out (under 6
/// %
///           of the largest stress where the force's lever is at least as long as the diameter).
/// Source    Euler-Bernoulli; derived.
[[nodiscard]] Result<double> enduring_bend_mm(const model::Cutter& cutter, double force_mm = 0.0);

}  // namespace capstan::mechanics

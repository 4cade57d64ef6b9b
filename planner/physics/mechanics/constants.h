#pragma once

#include <string_view>

/// The empirical numbers of this room, each with its source. `verify` may use this header and nothing
/// else of the room: its bounds are then computed apart from ours, from the same constants.
namespace capstan::mechanics {

// --- Tool materials ---------------------------------------------------------------------------------

/// Young's modulus of cemented carbide (WC with about 10 % Co), N/mm2.
/// Source: 580 GPa, calculatorhub.com "End Mill Deflection Calculator". Grades run from about 550 (more
/// cobalt) to 650 (less); the value taken is on the soft side, so that deflection is not understated.
inline constexpr double kCarbideYoungsModulusNMm2 = 580e3;

/// Young's modulus of high-speed steel, N/mm2.
/// Source: 200 GPa, the same page; tool steels lie between 200 and 220.
inline constexpr double kHssYoungsModulusNMm2 = 200e3;

/// Diameter of the plain cylinder that bends like the fluted part, divided by the cutting diameter.
/// Source: Kops & Vo 1990, "Determination of the Equivalent Diameter of an End Mill Based on its
/// Compliance", CIRP Annals 39(1): "approximately 80 % of the cutter diameter for both two- and
/// four-flute end mills".
inline constexpr double kFluteEquivalentDiameterRatio = 0.8;

/// Bending stress that a milling cutter endures for the millions of bites of its life, N/mm2.
/// Source: carbide: the rod grade H10F (10 % Co, 0.8 um) has a transverse rupture strength of 4300 N/mm2
/// (Sandvik's figure, by langsuncarbide.com, carbide rod grades); what hardmetal endures 10^7 times is 70 %
/// of that (Nakajima et al. 2007, Materials Science Forum 534-536, 1201). A third of it is taken, for flutes
/// are notches, a tool is larger than a test bar and grades differ: default, unsourced. High-speed
/// steel: 1.43 (HV + 120) / sqrt(area)^(1/6) of a hard steel with a defect at its surface (Murakami), 800 HV,
/// a carbide of 50 um: 685.
inline constexpr double kCarbideEnduranceNMm2 = 1000.0;
inline constexpr double kHssEnduranceNMm2 = 685.0;

/// Runout, total indicated, of a tool in a usual collet, where none is stated, mm.
/// Source: ISO 15488, table 4 (accufixtools.com), collets of the normal class: 0.015 up to 10 mm, 0.020
/// above.
inline constexpr double kColletRunoutMm = 0.015;

// --- Cutting force ----------------------------------------------------------------------------------

/// Radial force of a milling tooth divided by its tangential force, as used for peak force with Kienzle
/// data, which speak of the tangential force only.
/// Source: largest Krc/Ktc (788.83 / 1319.41 = 0.598) of the six measured sets for aluminium alloys in
/// Chin. J. Mech. Eng. 2021, doi 10.1186/s10033-021-00536-9, table 5; smallest there 0.16. Chips much
/// thinner than 0.03 mm exceed it (edge force), see kForceUncertaintyFactor.
inline constexpr double kRadialToTangentialRatio = 0.6;

/// Axial force of a milling tooth divided by its tangential force and the tangent of its helix angle, for
/// Kienzle data, which speak of the tangential force only.
/// Source: largest Kac/Ktc (273 / 631 = 0.433) in the same table 5, taken to be at 30 degrees of helix (the
/// table does not tell; the growth with the tangent follows from the edge's direction): 0.433 / 0.577.
inline constexpr double kAxialToTangentialRatio = 0.75;

/// By how much a force computed from tabulated coefficients may be too small.
/// Source: sqrt(1319.41 / 600.46) = 1.48: half the spread (in logarithms) of Ktc for one alloy, Al 7075,
/// in the same table 5.
inline constexpr double kForceUncertaintyFactor = 1.5;

/// Growth of the cutting force from a sharp to a worn edge.
/// Source: Dietrich & Tschaetsch, Praxis der Zerspantechnik: K_ver = 1.3.
inline constexpr double kWearForceFactor = 1.3;

/// Smallest and largest chip thickness for which Kienzle coefficients are commonly measured, mm. Below,
/// the law is extrapolated (it then gives more force, not less); the edge rubs rather than cuts.
/// Source: default, unsourced (order of magnitude of Kienzle's turning tests).
inline constexpr double kKienzleMinChipThicknessMm = 0.01;
inline constexpr double kKienzleMaxChipThicknessMm = 2.5;

/// Thinnest chip that an edge still cuts, divided by its edge radius: below, the material is pressed under
/// the edge, which rubs, hardens the surface and wears. Source: S. Wojciechowski, "Estimation of Minimum
/// Uncut Chip Thickness during Precision and Micro-Machining Processes of Various Materials - A Critical
/// Review", Materials 2022, 15(1), 59 (doi 10.3390/ma15010059): tells the quotient by material; 0.3 is taken
/// for all. The radii are defaults, unsourced (ground carbide, HSS).
inline constexpr double kLeastChipOverEdgeRadius = 0.3;
/// The same of ISO group S (nickel, cobalt, titanium alloys), which harden under an edge that presses: the
/// next tooth must cut below what this one hardened. Default, unsourced: no quotient of this was found.
inline constexpr double kLeastChipOverEdgeRadiusS = 1.0;
inline constexpr double kCarbideEdgeRadiusMm = 0.008;
inline constexpr double kHssEdgeRadiusMm = 0.012;
/// A level shallower than this many edge radii is not cut but smeared: most of what its end edges meet meets
/// their rounding. Default, unsourced.
inline constexpr double kLeastDepthOverEdgeRadius = 5.0;
/// Small cutters are ground sharper. Default, unsourced: the least of the generic series (cutters.yaml).
inline constexpr double kLeastChipPerDiameter = 0.001;
/// The thinnest chip that a milling cutter is to take where it is fed, mm; in material of this ISO 513 group.
[[nodiscard]] constexpr double least_chip_mm(double diameter_mm, bool hss, std::string_view iso_group = {}) {
  const double edge = kLeastChipOverEdgeRadius * (hss ? kHssEdgeRadiusMm : kCarbideEdgeRadiusMm);
  const double small = kLeastChipPerDiameter * diameter_mm;
  const double hardens = iso_group == "S" ? kLeastChipOverEdgeRadiusS / kLeastChipOverEdgeRadius : 1.0;
  return hardens * (small < edge ? small : edge);
}

/// The shallowest level that a milling cutter is to take, mm; what is left in all may be less. In what
/// hardens under an edge it is as much deeper as the chip is thicker there.
[[nodiscard]] constexpr double least_depth_mm(double diameter_mm, bool hss, std::string_view iso_group = {}) {
  return kLeastDepthOverEdgeRadius * least_chip_mm(diameter_mm, hss, iso_group) / kLeastChipOverEdgeRadius;
}

// --- Tool life --------------------------------------------------------------------------------------

/// Taylor's exponent n where no law is given. Source: Kalpakjian & Schmid, Manufacturing Engineering and
/// Technology: carbide 0.2 to 0.5, high-speed steel 0.08 to 0.2; curioustab.com gives 0.2 to 0.25 (0.30) and
/// 0.08 to 0.2. Taken: the lower part, where life falls faster with speed.
inline constexpr double kTaylorExponentCarbide = 0.25;
inline constexpr double kTaylorExponentHss = 0.125;

/// Life where neither law nor cutter states one, at the table's speed, min. Default, unsourced.
inline constexpr double kLifeAtTableMin = 15.0;

// --- Machine ----------------------------------------------------------------------------------------

/// Cutting power divided by motor power where the machine does not state it.
/// Source: 0.8 in Mitsubishi Materials' worked example of milling power; Kyocera's catalogue 2021 gives
/// 0.7 to 0.8.
inline constexpr double kDefaultSpindleEfficiency = 0.8;
/// Share of the motor's power that reaches the cut: the machine's own, else the default.
[[nodiscard]] constexpr double spindle_efficiency(double stated) {
  return stated > 0.0 && stated <= 1.0 ? stated : kDefaultSpindleEfficiency;
}

// --- Drilling, reaming, tapping ---------------------------------------------------------------------

/// Thrust of a twist drill divided by D/2 f kc sin(kappa).
/// Source: Iscar, Rotating Tools catalogue 2017, p. 601: Ff = 0.63 D/2 f kc sin k kf, kf = 1 (the general
/// case; 0.85 for that maker's solid carbide drills is not taken).
inline constexpr double kDrillThrustFactor = 0.63;

/// Reaming torque over the torque of the chips alone: rubbing of the margins. Default, unsourced.
inline constexpr double kReamingFrictionFactor = 2.0;

/// Tapping torque over that of the thread's cross-section.
/// Source: Yamawa, catalogue 2021, p. 639, table 2: the largest K there (1.5P straight flutes in brass);
/// 0.75 is the smallest, 1.35 the usual hand tap in steel.
inline constexpr double kTappingTorqueFactor = 1.68;

}  // namespace capstan::mechanics

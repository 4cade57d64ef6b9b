#pragma once

#include "planner/model/plan/cutter/cutter.h"
#include "planner/model/plan/resources/material.h"

namespace capstan::model {

/// Steepest ramp where neither cutter nor material says more, rad.
/// Source  Harvey Performance, In the Loupe, "Ramping to success": 1 to 3 degrees to begin with in hard and
///         ferrous materials; the upper end.
inline constexpr double kUsualRampRad = 3.0 * 3.14159265358979323846 / 180.0;

/// How far from its axis, of the radius, a cutter cuts badly or not at all. Default, unsourced.
inline constexpr double kMiddleOfRadius = 0.3;

/// Deepest slot that a cutter mills in one level in any material, in diameters.
/// Source  slots no deeper than 1.5 D (there at half speed and feed; 0.5 D at full): Dormer Pramet, milling
///         catalogue 2021-22, p. 114, solid carbide mills, correction factors.
inline constexpr double kDeepestSlotRatio = 1.5;

/// What mills with edges of their own rough of steel that is harder than 50 HRC, in diameters: either a
/// level, at most this deep wherever the cut is wide, or a narrow cut of constant engagement, at most this
/// wide and deep.
///
/// Source  narrow: D x 0.1 D up to 55 HRC (Osawa, catalogue 2021, p. 455, HF451; docs.steelcam.org). Levels:
///         0.02 D and 0.05 D in the hard materials of a table that ends with 55 to 60 HRC, whose widest cut on
///         the side is 1.3 D x 0.05 D (Karnasch, in ATA Americas catalogue 2022, p. 1283; read from its text,
///         in which pictures and columns stand apart, so the larger is taken). Slots half a diameter deep at
///         20 to 30 m/min (Tungaloy catalogue 2020-21, p. 1091) name no hardness; up to 50 HRC they hold.
struct HardCut {
  double level = 0.05, narrow_width = 0.1, narrow_depth = 1.0;
};
inline constexpr HardCut kHardCut{};
/// Brinell hardness of the sources' 50 HRC and a little: above it kHardCut holds.
/// Source  481 HB are 50 HRC, 560 HB 55 HRC (materials.yaml, @pulley).
inline constexpr double kHardHb = 500.0;
/// Levels are no thinner than this for the sake of kHardCut, mm: small mills would smear. Default, unsourced.
inline constexpr double kThinnestHardMm = 0.1;

/// Whether kHardCut holds for this cutter. Face mills have inserts: their makers say otherwise.
[[nodiscard]] bool cuts_hard_steel(const Cutter& c, const WorkMaterial& m);
/// Deepest level of a wide cut, mm; infinite where hardness does not bound it.
[[nodiscard]] double hard_level_mm(const Cutter& c, const WorkMaterial& m);

/// How a cutter goes down into solid material on a slope.
struct Ramp {
  double angle_rad = 0.0;  ///< 0: it must not ramp
  /// Of the feed that its flanks would have in a slot of the same depth, at most.
  double feed_share = 1.0;
  /// Deepest slot milled in one level: chips must come out of it. Also of a cutter that must not ramp.
  double slot_depth_mm = 0.0;
  /// Deepest bore along a helix. Also of a cutter that must not ramp.
  double bore_depth_mm = 0.0;
};

/// The angle is that which the cutter's maker or the shop states; else that of the table by substrate and ISO
/// 513 group, and no more than the cutter's own.
///
/// Source  the rows in ramp.cpp.
[[nodiscard]] Ramp ramp_of(const Cutter& c, const WorkMaterial& m);

}  // namespace capstan::model

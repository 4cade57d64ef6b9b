#pragma once

#include "planner/model/plan/cutter/cutter.h"
#include "planner/model/plan/resources/material.h"

/// The specific force that a material card states for milling, as one number. It is what cases are compared
/// by; loads along a path are the business of mechanics.
namespace capstan::model {

/// The measured set of the material: the first for the tool's substrate; null if there is none.
[[nodiscard]] const MechanisticSet* measured_set(const WorkMaterial& material, Substrate substrate);

/// Share of Kienzle's force that is saved by each degree of rake over the 0 degrees of the tables.
/// Source: "Increasing rake angle by 1 deg in the positive direction decreases cutting power by about 1 %",
/// Mitsubishi Materials, function of tool features, rake angle; that kc1 is for a rake of 0: Sandvik
/// Coromant, specific cutting force; the same for milling: Tungaloy catalogue 2020-21 p. 1650.
inline constexpr double kForcePerDegreeOfRake = 0.01;
/// Radial rake of end mills, degrees.
/// Source: Ingersoll catalogue 2011 p. 457 (docs.steelcam.org), data for regrinding solid-carbide mills: 10
/// to 12, 17 and 18 of those for aluminium. The least is taken for all. Those of high-speed steel have no
/// less (jntools.com). Cutters for hardened material are ground to a rake of 0 or less (mmc-carbide.com,
/// radial rake angle): none is counted there; nor for cutters with inserts, of which no rake is known.
inline constexpr double kEndMillRakeDeg = 10.0;
/// Kienzle's kc1.1 holds for a rake of 0. The share of it that holds for milling with this cutter.
[[nodiscard]] double kienzle_share(const WorkMaterial& material, const Cutter& cutter);

/// Tangential force of a sharp edge over the area of its chip, N/mm2, at a thickness of the chip: of the
/// measured set ktc + kte / h, else Kienzle's kc1.1 h^-mc times `kienzle_share`.
///
/// Needs     a positive thickness, mm; else 0.
[[nodiscard]] double specific_force_n_mm2(const WorkMaterial& material, const Cutter& cutter, double chip_mm);

}  // namespace capstan::model

#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "planner/ground/base/result.h"
#include "planner/model/plan/material.h"

namespace capstan::tooling {

/// A hardness as it is stated, and what it is in Brinell.
struct StatedHardness {
  double brinell = 0.0;
  std::string text;    ///< "48 HRC"
  std::string before;  ///< what stands before it in the text that says it
};

/// Brinell hardness of a value in HB, HBW, HBS, BHN, HV (taken as no softer than it is: as many HB) or HRC;
/// infinite above 60 HRC, so that no card is as hard; nothing for other units and values.
///
/// Source    HRC: ASTM A370 as at yidecasting.com, straight between its points; Miki Pulley's table
///           (mikipulley.co.jp, tech20) has the same values.
/// Uncertainty  conversions are approximate by nature; they hold for steel.
[[nodiscard]] std::optional<StatedHardness> stated_hardness(double value, std::string_view unit);
/// The same where a text says it: "42CrMo4 300 HB", "hardened, HRC 48", "58+2 HRC"; of several, and of a
/// range, the hardest. A unit beside which no number can be read is infinite, too: the piece is refused.
[[nodiscard]] std::optional<StatedHardness> stated_hardness(std::string_view text);

/// The card for a piece that is as hard as stated: the material's own while it is as hard, else the softest
/// of the same grade, or of what it becomes by hardening (`harder` of the shipped table), that is as hard.
/// WorkMaterial::sources then says so beside "chosen". Nothing where the card states no hardness, and none is
/// known to be harder: the hardness says nothing about its figures.
/// Fails  MATERIAL-HARDNESS when the piece is harder than every card.
[[nodiscard]] Result<std::optional<model::WorkMaterial>> as_hard_as(
    const model::WorkMaterial& material, const StatedHardness& stated,
    const std::vector<model::WorkMaterial>& materials);

}  // namespace capstan::tooling

#pragma once

#include <string_view>

#include "planner/model/plan/cutter/cutter.h"
#include "planner/model/plan/resources/material.h"

/// What measured cases put into a material's card beside its own numbers: known by its source, so that every
/// form of a plan keeps the mark, and planning anew begins from the card itself.
namespace capstan::model {

/// How the source of a set, or of a law of life, begins that cases made; no table of materials may.
inline constexpr std::string_view kByCases = "measured cases: ";

[[nodiscard]] inline bool by_cases(const MechanisticSet& set) { return set.source.starts_with(kByCases); }
[[nodiscard]] inline bool by_cases(const ToolLifeLaw& law) { return law.source.starts_with(kByCases); }
/// Whether cases put anything into the card.
[[nodiscard]] bool corrected_by_cases(const WorkMaterial& card);
/// The card as it was before.
[[nodiscard]] WorkMaterial without_cases(WorkMaterial card);
/// Whether the set that holds for a substrate is Kienzle's law as cases correct it: the card has no set of
/// its own for it. What such a set calls edge force is a share of the whole (mechanics::corrected_set).
[[nodiscard]] bool kienzle_by_cases(const WorkMaterial& card, Substrate substrate);

}  // namespace capstan::model

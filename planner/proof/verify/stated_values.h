#pragma once

#include "planner/model/plan/cutter/cutter.h"
#include "planner/model/plan/resources/material.h"

// What presets of a tool state for a material, read by the check's own code: planning looks them up apart
// (model/plan/preset_feeds.h, of which only the words in a preset's source and the shares are shared).

namespace capstan::verify {

/// By which a rate or load that is measured on cells, rounded, or held nearly may exceed its limit. Default,
/// unsourced.
inline constexpr double kMeasured = 1.1;
/// Bending of a roughing tool's tip. Default, unsourced.
inline constexpr double kMostBentMm = 0.2;

/// Which number of a preset is wanted.
enum class Wanted { kSpeed, kFeed };

/// The tool's own preset for a material, or (`of_its_like`) one taken from a cutter like it, that states what
/// is asked for: by the material's id, then its names, then its ISO 513 group. A group's counts only where
/// the material's card has a speed for the substrate, or none for any. Null: there is none.
[[nodiscard]] const model::CuttingPreset* stated_for(const model::Cutter& c, const model::WorkMaterial& m,
                                                     bool of_its_like, Wanted what);

/// The thinnest chip that an edge takes in the material: by its radius, or less where its presets say that it
/// cuts there.
[[nodiscard]] double least_chip_of(const model::Cutter& c, const model::WorkMaterial& m);

/// How much faster than the cards' bare edges a coated carbide tool of the kind runs at least.
[[nodiscard]] double coated_over_bare(const model::Cutter& c);

}  // namespace capstan::verify

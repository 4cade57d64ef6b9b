#pragma once

#include <string>
#include <string_view>

#include "planner/model/plan/cutter/cutter.h"
#include "planner/model/plan/resources/material.h"

namespace capstan::model {

/// How a cutter's `sources` begin of a field that was taken from a generic cutter (its id follows).
inline constexpr std::string_view kAsGeneric = "default: as ";

/// Whether a preset is not the cutter's own but taken from the generic cutter nearest to it: it counts only
/// where no own preset is for the material.
[[nodiscard]] bool borrowed(const CuttingPreset& p);

/// Whether neither maker nor shop states a preset: it is borrowed, or its source says that it is a default.
[[nodiscard]] bool nobodys(const CuttingPreset& p);

/// The cutter's own preset for a material: by id, by name, by ISO 513 group; null when it has none. With
/// `of_its_like` also a borrowed one. Where the material's card has no speeds for the substrate, only a
/// preset that names the material counts: a group is wider than the card.
[[nodiscard]] const CuttingPreset* preset_of(const Cutter& c, const WorkMaterial& m, bool of_its_like);

/// Whether the card states speeds, and none for this substrate: not cut with it.
[[nodiscard]] bool card_excludes(const WorkMaterial& m, Substrate s);

/// The largest feed of a cutter by the start value that its maker or the shop states. Default, unsourced.
inline constexpr double kOverPreset = 1.5;

/// The ending that an own preset's source gets when the group of the material that it names is known.
[[nodiscard]] std::string of_group(std::string_view iso_group);

/// The largest feed per tooth that a cutter can take in a material, mm; 0: not known. It is the stated
/// largest. Where that is taken from a generic cutter, or not known, it is at least kOverPreset times the
/// cutter's own start value for this material. Where the cutter has no start value, it is the least of those
/// for materials of the same ISO 513 group (`of_group`), and no more: groups are wide. Values of another
/// group do not count.
[[nodiscard]] double largest_tooth_feed_mm(const Cutter& c, const WorkMaterial& m);

/// The feed per tooth that its presets state for a material, the own before those of its like; 0: none.
[[nodiscard]] double start_feed_mm(const Cutter& c, const WorkMaterial& m);

/// Share of its start value down to which a cutter is taken to cut, whatever its edge's radius says:
/// whoever states a start value has seen it cut, and some limit may lower it. Default, unsourced.
inline constexpr double kCutsDownTo = 0.5;
/// The thinnest chip that the cutter is taken to cut in a material, by its presets, mm; 0: they do not say.
/// kCutsDownTo of a start value that its maker or the shop states; all of one that is nobody's.
[[nodiscard]] double held_to_cut_mm(const Cutter& c, const WorkMaterial& m);

}  // namespace capstan::model

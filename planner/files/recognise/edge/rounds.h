#pragma once

#include <vector>

#include "planner/files/recognise/prismatic.h"

namespace capstan::recognise {

/// Takes the rounds of convex edges: cylinders, tori and spheres with the material inside that are tangent to
/// their neighbours, and no corner of an island. Rounds of one radius that meet are one feature.
///
/// `taken` marks the patches that features have; those of the rounds are added.
[[nodiscard]] std::vector<Feature> take_rounds(const Context& context, std::vector<bool>& taken);

/// A cone that breaks an edge: the rim of a hole or of a boss.
[[nodiscard]] std::optional<Feature> conical_chamfer(const Context& context,
                                                     const std::vector<std::uint32_t>& patches);

}  // namespace capstan::recognise

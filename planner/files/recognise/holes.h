#pragma once

#include <vector>

#include "planner/files/recognise/prismatic.h"

namespace capstan::recognise {

/// Takes the holes: whole cylinders with the material outside, with the coaxial cylinders, cones, shelves and
/// bottom that belong to them. What has anything else tied to it (walls, islands) is left for a pocket.
///
/// `taken` marks the patches that features have; those of the holes are added.
[[nodiscard]] std::vector<Feature> take_holes(const Context& context, std::vector<bool>& taken);

}  // namespace capstan::recognise

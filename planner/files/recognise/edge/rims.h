#pragma once

#include <vector>

#include "planner/files/recognise/prismatic.h"

namespace capstan::recognise {

/// Takes the chamfers and rounds that break the upper edge of a pocket, a boss or the whole outline all
/// along: strips of one height and one slope, or one radius, which one cutter makes from above. Chamfers may
/// be interrupted by other features.
///
/// `taken` marks the patches that features have; those of the rims are added.
[[nodiscard]] std::vector<Feature> take_rims(const Context& context, std::vector<bool>& taken);

}  // namespace capstan::recognise

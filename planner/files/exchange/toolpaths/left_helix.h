#pragma once

#include <optional>
#include <string>
#include <vector>

#include "planner/files/exchange/toolpaths/segments.h"
#include "planner/ground/geometry/vec.h"

// ISO 14649's HELIX is right-handed. A left-handed one is written as a POLYLINE of chords, whose name says
// which helix it is; it is followed as that helix while its points still say the same.

namespace capstan::exchange::curves {

/// "LEFT-HANDED HELIX" with centre, axis and sweep, in the coordinates of the points.
[[nodiscard]] std::string left_helix_name(const Segment& helix);
/// The helix that a polyline of that name is, from its first point to its last; nothing where the name is
/// another, or where a point is not on it, as far along as its place in the list says.
[[nodiscard]] std::optional<Segment> left_helix(const std::string& name,
                                                const std::vector<geometry::Vec3>& points);

}  // namespace capstan::exchange::curves

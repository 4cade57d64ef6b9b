#pragma once

#include <cstddef>
#include <vector>

#include "planner/door/report/picture/drawing.h"

namespace capstan::report::picture {

/// No point of a thinned line is farther than this from where it was, units of the picture: a fifth of a
/// pixel.
inline constexpr double kThinning = 0.1;

/// The lines with fewer points, for the eye the same: points that lie on a line between their neighbours are
/// left out. Where more than `most` points stay, pieces of lines over places that are drawn already are left
/// out too, by squares that grow until no more than `most` stay. Lines without length are left out.
///
/// Frame  as drawing.h; all points must be finite.
/// Cost   linear in the points, and in the length of the lines where squares are counted.
[[nodiscard]] std::vector<Polyline> thinned(const std::vector<Polyline>& lines, std::size_t most);

}  // namespace capstan::report::picture

#pragma once

#include <string>
#include <vector>

#include "planner/door/report/picture/drawing.h"
#include "planner/ground/base/result.h"
#include "planner/model/plan/plan.h"

namespace capstan::report::picture {

/// A plan on one sheet. Of each set-up: how the piece lies, the raw piece, what holds it, what its features
/// remove and the paths of its steps, from above and from the front, with zero, axes and a bar for the scale;
/// and a legend of the steps with tool and time.
///
/// `steps`: the steps whose paths are drawn, each by its number in the plan, from 1, or a pattern of its id,
/// its name or its feature's (* any text, ? any character). None: all of them; else only the set-ups that
/// they are in. A plan without set-ups is a sheet that says so.
/// Shape   of many steps the legend names the first kMostInLegend of a set-up. The lines of all paths have
///         kMostPoints points, or kLeastPoints of each where that is more (thinned.h).
/// Fails   PIC-STEP: a text that names no step, with the steps there are.
[[nodiscard]] Result<Drawing> drawing_of(const model::Plan& plan, const std::vector<std::string>& steps);

inline constexpr std::size_t kMostInLegend = 200, kMostPoints = 120'000, kLeastPoints = 200;
inline constexpr std::size_t kMostPixels = 60'000'000;

/// As svg_text (svg.h) writes it, or png_bytes (png.h) its pixels.
/// Fails  as `drawing_of`; PIC-SIZE: of more set-ups than kMostPixels hold, some twenty.
[[nodiscard]] Result<std::string> svg(const model::Plan& plan, const std::vector<std::string>& steps);
[[nodiscard]] Result<std::string> png(const model::Plan& plan, const std::vector<std::string>& steps);

}  // namespace capstan::report::picture

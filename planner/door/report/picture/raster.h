#pragma once

#include "planner/door/report/picture/drawing.h"
#include "planner/door/report/picture/png.h"

namespace capstan::report::picture {

/// The drawing as pixels, kPixelsPerUnit of them a unit, on white. Edges of lines and areas are smooth:
/// a pixel takes the colour by the part of it that is covered. Text is of letters of 5 by 7 dots; a character
/// that is none of ASCII is an empty box. Same drawing, same pixels.
/// Needs  a width and height above 0.
[[nodiscard]] Pixels pixels_of(const Drawing& drawing);

}  // namespace capstan::report::picture

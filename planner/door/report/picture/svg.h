#pragma once

#include <string>

#include "planner/door/report/picture/drawing.h"

namespace capstan::report::picture {

/// The drawing as SVG 1.1, UTF-8. It names no font but the viewer's monospaced one and loads nothing. Each
/// group is a `g` with its title, and `data-step` where it is one of a step. Texts are escaped, and what XML
/// does not take in them is left out. Same drawing, same bytes.
[[nodiscard]] std::string svg_text(const Drawing& drawing);

}  // namespace capstan::report::picture

#pragma once

#include <string>

#include "planner/door/report/report.h"

namespace capstan::report {

/// What the page's scripts read, as one JSON object in which `<` is written as \u003c, so that it may stand
/// in a script element whatever names it holds. Lengths of paths are whole micrometres; page/path.js says how
/// they are laid out.
[[nodiscard]] std::string data_of(const model::Plan& plan, const About& about);

}  // namespace capstan::report

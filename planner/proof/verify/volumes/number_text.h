#pragma once

#include <string>

#include "planner/ground/geometry/vec.h"

namespace capstan::verify {

/// "12.5 mm" and the like, three decimals at most.
[[nodiscard]] std::string mm(double v);
[[nodiscard]] std::string plain(double v);
/// Of amounts that may be small, as feeds per tooth: below a thousandth two digits that count, "0.00021 mm".
[[nodiscard]] std::string fine_mm(double v);
/// "(12.5, 3, -1)", mm.
[[nodiscard]] std::string place(geometry::Vec2 p, double z);

}  // namespace capstan::verify

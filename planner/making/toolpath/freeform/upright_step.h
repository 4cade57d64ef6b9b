#pragma once

#include "planner/making/toolpath/freeform/drop_cutter.h"

namespace capstan::toolpath::freeform {

/// From this rise over run on a step is looked for; derived: 76 degrees.
inline constexpr double kSteepTangent = 4.0;

/// Whether the tip's way from a to b has an upright step: found by halving.
[[nodiscard]] bool has_upright_step(const DropCutter& drop, const MillEnd& cutter, double allowance_mm,
                                    geometry::Vec2 a, geometry::Vec2 b);

}  // namespace capstan::toolpath::freeform

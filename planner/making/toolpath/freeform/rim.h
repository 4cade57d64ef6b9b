#pragma once

#include "planner/making/toolpath/freeform/drop_cutter.h"
#include "planner/making/toolpath/freeform/hatch.h"

namespace capstan::toolpath::freeform {

/// The lines of a hatch over the rectangle of a mesh, drawn on beyond its rim, and further lines beside them,
/// as far as the cutter still touches the surface within its rim.
///
/// Where a surface rises inwards from its rim, a ball that touches it there has its axis outside; without
/// these ends a strip of R sin(slope) would stay uncut. Where it touches the rim itself it would only roll
/// over it: there the lines end.
///
/// Shape   line numbers keep their order; they may start below 0.
/// Cost    three drops for each thirty-second of the cutter's radius beyond the rim.
[[nodiscard]] Hatch beyond_rim(const Hatch& inside, const DropCutter& drop, const MillEnd& cutter,
                               double allowance_mm);

}  // namespace capstan::toolpath::freeform

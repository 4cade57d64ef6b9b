#pragma once

#include "planner/physics/mechanics/loads/section.h"

namespace capstan::mechanics {

/// The section of a straight side cut beside an equal pass a step ae away, as angles at the full radius: on a
/// flank the strip of width ae; a corner or ball meets a band of width ae at each height, and the scallop
/// half a step inside its flat (the strip is wider than ae there, the area stays ap ae). ae at least the
/// diameter that cuts at depth ap: a slot.
[[nodiscard]] Section side_section(double ap_mm, double ae_mm, const Tooth& tooth, CutDirection direction);

}  // namespace capstan::mechanics

#pragma once

#include "planner/ground/geometry/region.h"

namespace capstan::rules {

/// Which cutters an area admits, by diameter, mm.
struct Passage {
  double widest_mm = 0.0;     ///< largest circle that fits anywhere
  double narrowest_mm = 0.0;  ///< largest cutter that reaches all of it, corners excepted
  double exact_mm = 0.0;      ///< largest cutter that reaches the corners, too; 0 when they are sharp
};

/// Estimated by offsets: a cutter of diameter D reaches offset(offset(area, -D/2), D/2). A corner of the
/// angle a keeps r^2 (cot(a/2) - (pi - a)/2) from it. Pieces that it leaves count as corners up to the size
/// that a corner of 60 degrees leaves, 0.685 r^2, and where a single corner of 30 degrees or more lies in
/// them, up to what that leaves (2.42 r^2 at 30); anything larger is a passage too narrow for the cutter.
/// Radii are tried from 0.2 mm up, for only a cutter little wider than a passage distinguishes it from a
/// corner. `exact_mm` allows 0.005 r^2 per corner. `wanted`: what has to be reached; the rest of the area is
/// only room to move in, as beyond an open side. Empty: all of the area.
///
/// Accuracy   widest and narrowest to 3 %, on the small side; exact to 4 % of itself; fillets below 5 % of
///            the widest, or of what is wanted, count as sharp.
/// Cost       some twenty offsets; five for a convex area without fillets.
///            `corners` false: exact_mm is not looked for and stays 0.
/// Source     derived.
[[nodiscard]] Passage passage_of(const geometry::Region& area, bool corners = true,
                                 const geometry::Region& wanted = {});

}  // namespace capstan::rules

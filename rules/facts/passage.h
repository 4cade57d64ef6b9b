#pragma once

#include "planner/ground/geometry/region.h"

namespace capstan::rules {

/// Which cutters an area admits, by diameter, mm.
struct Passage {
  double widest_mm = 0.0;     ///< largest circle that fits anywhere
  double narrowest_mm = 0.0;  ///< largest cutter that reaches all of it, corners excepted
  double exact_mm = 0.0;      ///< largest cutter that reaches the corners, too; 0 when they are sharp
};

/// Estimated by offsets: a cutter of diameter D reaches offset(offset(area, -D/2), D/2). Pieces that it
/// leaves count as corners up to the size that a corner of 60 degrees leaves, r^2 (cot 30 - (pi - pi/3)/2) =
/// 0.685 r^2; anything larger is a passage too narrow for the cutter. Radii are tried from 0.2 mm up, for
/// only a cutter little wider than a passage distinguishes it from a corner. `exact_mm` allows 0.005 r^2 per
/// corner.
///
/// Accuracy   widest and narrowest to 3 %, on the small side; exact to 4 % of itself; fillets below 5 % of
/// the
///            widest count as sharp.
/// Cost       some twenty offsets; five for a convex area without fillets.
///            `corners` false: exact_mm is not looked for and stays 0.
/// Source     derived.
[[nodiscard]] Passage passage_of(const geometry::Region& area, bool corners = true);

}  // namespace capstan::rules

#pragma once

#include <vector>

#include "planner/making/toolpath/region/adaptive/clearing.h"
#include "planner/making/toolpath/region/area/level.h"

namespace capstan::toolpath {

/// Whether areas like this are cut by passes of constant engagement: roughing from the solid, between upright
/// walls, where the cutter has room to turn.
/// Fails  TPA-UNSUPPORTED, with the reason.
[[nodiscard]] Status may_clear_at_constant_engagement(const PathJob& task, const WorkArea& area);

/// What of the centres such passes go to: inner corners are rounded.
[[nodiscard]] geometry::Region reached_at_constant_engagement(const PathJob& task,
                                                              const geometry::Region& centres);

/// What one level's piece was cut by. Upright walls repeat it on the next level.
struct LevelClearing {
  geometry::Region centres, cleared;
  bool entered = false;  ///< by its own way into the solid
  geometry::Vec2 at, heading;
  std::vector<ClearingPass> passes;
};
using Clearings = std::vector<LevelClearing>;

/// All of a level, from a helix of its own in each piece or from the air beside it.
/// Fails  TPA-ENTRY; TPA-UNSUPPORTED where there is no room to turn.
Status cut_at_constant_engagement(LevelCutter& cutter, const Level& level, Clearings& known);

}  // namespace capstan::toolpath

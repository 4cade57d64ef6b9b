#pragma once

#include "planner/physics/mechanics/bending/wall_error.h"

namespace capstan::mechanics {

/// The error of a wall that is asked about once.
[[nodiscard]] inline Result<WallError> wall_error(const Section& section, const Tooth& tooth,
                                                  const ForceLaw& law, double fz_mm, WallSide side,
                                                  const ToolBeam& beam) {
  const auto ready = WallAtFeeds::of(section, tooth, law, side, beam);
  if (!ready) return fail(ready.error());
  return ready->at(fz_mm);
}

}  // namespace capstan::mechanics

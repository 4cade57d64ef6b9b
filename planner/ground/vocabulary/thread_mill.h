#pragma once

#include "planner/ground/vocabulary/cutter_class.h"

namespace capstan::model {

/// Whether cutters of the class make a thread by a helix of the cutter about the thread's axis. The other
/// classes that make threads are taps: they go down the axis, a pitch each turn.
[[nodiscard]] inline bool mills_threads(CutterClass c) {
  return has(c, CutterTrait::kThreads) && !has(c, CutterTrait::kAlongAxis);
}

}  // namespace capstan::model

#pragma once

#include <vector>

#include "planner/making/optimise/feeds.h"
#include "planner/model/features/shape.h"
#include "planner/model/plan/cutter/cutter.h"
#include "planner/model/plan/cutter_path.h"

namespace capstan::step {

/// A rectangle of depth and width that no section of a milled inner thread exceeds in force: its cut lies
/// under an overhang and is not measured.
struct ThreadBound {
  double ap_mm = 0.0, ae_mm = 0.0;
  /// Feed of the cutter's centre over that of its edge at the thread's major diameter.
  double centre_share = 1.0;
};
[[nodiscard]] ThreadBound thread_bound(const model::Cutter& cutter, const model::FeatureShape& thread);

/// That rectangle on every arc of a thread mill's path that cuts, as feeds ask for it.
[[nodiscard]] std::vector<optimise::CutSample> bound_samples(const ThreadBound& bound,
                                                             const model::CutterPath& path);

}  // namespace capstan::step

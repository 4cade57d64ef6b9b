#pragma once

#include <vector>

#include "planner/making/optimise/feeds.h"
#include "planner/model/features/shape.h"
#include "planner/model/plan/cutter/cutter.h"
#include "planner/model/plan/cutter_path.h"
#include "planner/physics/mechanics/force/thread_cut.h"

namespace capstan::step {

using mechanics::ThreadBound;

/// Of a cutter in a thread's core hole (physics/mechanics/force/thread_cut.h).
[[nodiscard]] ThreadBound thread_bound(const model::Cutter& cutter, const model::FeatureShape& thread);

/// That rectangle on every arc of a thread mill's path that cuts, as feeds ask for it.
[[nodiscard]] std::vector<optimise::CutSample> bound_samples(const ThreadBound& bound,
                                                             const model::CutterPath& path);

}  // namespace capstan::step

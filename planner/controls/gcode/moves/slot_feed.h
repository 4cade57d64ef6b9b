#pragma once

#include <optional>

#include "planner/model/plan/plan.h"

namespace capstan::controls::gcode {

/// Equal levels of a depth, and the feed at which a full slot may be cut in each.
struct SlotLevels {
  int levels = 1;
  double feed_mm_min = 0.0;
};

/// The levels and the feed that clear most in a minute, where the cutter may be in a slot as wide as it is
/// anywhere: at `rpm`, each of the loads, margins included (optimise/cut.h), within what spindle and cutter
/// bear and no larger than the largest of the step's planned path, which keeps all limits. No level is deeper
/// than `deepest_mm`. Feeds are rounded down to `feed_decimals`.
/// Nothing where no feed above the one at which the edge rubs keeps them, or no formula tells them.
[[nodiscard]] std::optional<SlotLevels> slot_levels(const model::Plan& plan, const model::StepResult& step,
                                                    const model::Cutter& cutter, double depth_mm,
                                                    double deepest_mm, double rpm, int feed_decimals);

}  // namespace capstan::controls::gcode

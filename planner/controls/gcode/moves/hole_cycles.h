#pragma once

#include <cstddef>
#include <optional>

#include "planner/controls/gcode/words.h"
#include "planner/model/plan/plan.h"

namespace capstan::controls::gcode {

/// A hole in a path that a canned cycle makes, with the last of its moves.
struct HoleInPath {
  HoleCycle cycle;
  std::size_t last_move = 0;
};

/// The hole that begins with move `move` of the step, the tool at `at` (rounded): rapids and ways through air
/// straight down, one feed straight down, perhaps a dwell, and a rapid, or the same feed and a rapid,
/// straight up to `at`. Nothing for other moves, and where feed or speed change within it.
[[nodiscard]] std::optional<HoleInPath> hole_at(const model::StepResult& step, std::size_t move,
                                                geometry::Vec3 at, const model::Control& control);

}  // namespace capstan::controls::gcode

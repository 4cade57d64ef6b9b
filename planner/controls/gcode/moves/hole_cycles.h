#pragma once

#include <cstddef>
#include <optional>
#include <vector>

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

/// Equal holes one behind the other, each by one rapid across from the one before, at the height from which
/// all of them are begun.
struct HolesInPath {
  HoleCycle cycle;                     ///< of the first
  std::vector<geometry::Vec2> places;  ///< of all, as planned: not rounded
  std::size_t last_move = 0;
};

/// The holes that begin with move `move`, the tool at `at`: one or more. Nothing where `hole_at` says none.
[[nodiscard]] std::optional<HolesInPath> holes_at(const model::StepResult& step, std::size_t move,
                                                  geometry::Vec3 at, const model::Control& control);

/// Whether the path has a cut that is not straight up or down.
[[nodiscard]] bool cuts_across(const model::CutterPath& path);

}  // namespace capstan::controls::gcode

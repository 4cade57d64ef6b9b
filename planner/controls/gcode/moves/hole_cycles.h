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
/// straight up to `at`, perhaps with the spindle stopped at the bottom. Or pecks: such feeds, and between two
/// of them a way up by as much as each time (the chip is broken), or a rapid up to the same height and a way
/// down to as much above the last bottom (the hole is cleared); `r_z` is that height then, above where the
/// path begins to be fed. Nothing for other moves, and where feed or speed change within it.
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

/// Whether pecks of `first_mm` below `r_z`, and then of `step_mm`, the last one less where less is left, are
/// those of this hole, to a unit of its last decimal.
[[nodiscard]] bool are_pecks(const HoleCycle& hole, double first_mm, double step_mm);

/// The sizes that say the pecks of this hole (`are_pecks`), rounded to its decimals. Nothing where no two say
/// them, or it has none.
struct PeckSizes {
  double first_mm = 0.0, step_mm = 0.0;
};
[[nodiscard]] std::optional<PeckSizes> peck_sizes(const HoleCycle& hole);

/// Whether the path has a cut that is not straight up or down.
[[nodiscard]] bool cuts_across(const model::CutterPath& path);

}  // namespace capstan::controls::gcode

#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "planner/ground/geometry/vec.h"
#include "planner/model/plan/cutter/cutter.h"
#include "planner/model/plan/cutter_path.h"
#include "planner/model/plan/plan.h"

namespace capstan::verify {

/// A height that a program leaves unknown (after a move in machine coordinates) is taken as clear of all.
inline constexpr double kUnknownHeightMm = 1e5;

/// By which feeds and speeds of a program may be off through their decimals, of themselves; default,
/// unsourced.
inline constexpr double kWritten = 0.005;

/// One move as the checks see it, whether it comes from a plan's path or from a program's text.
/// Frame  the set-up's. Units  mm, mm/min, 1/min, s.
struct Move {
  model::MoveKind kind = model::MoveKind::kRapid;
  model::MoveRole role = model::MoveRole::kCut;
  bool role_known = false;    ///< a program does not say what its moves are for
  bool synchronised = false;  ///< tapping: feed bound to the spindle
  geometry::Vec3 from, to;
  geometry::Vec2 centre;
  double feed_mm_min = 0.0;
  double spindle_rpm = 0.0;  ///< positive clockwise
  double dwell_s = 0.0;
  /// By which each coordinate of its ends may be off, for a program has so many decimals and no more.
  double rounding_mm = 0.0;
  long where = -1;  ///< index in the path, or line of the program
};

/// The moves of one workingstep.
struct StepMoves {
  std::size_t order = 0;  ///< position among the plan's steps
  std::string id;
  const model::StepResult* planned = nullptr;  ///< null for a program alone
  const model::Cutter* cutter = nullptr;
  std::size_t setup = 0;
  std::vector<Move> moves;
  /// By which feeds and speeds may be off, for a program has so many decimals; 0: a plan's.
  double feed_rounding_mm_min = 0.0, speed_rounding_rpm = 0.0;
};

/// Swept angle, rad, in (0, 2 pi].
[[nodiscard]] double sweep_of(const Move& m);
[[nodiscard]] double length_of(const Move& m);
/// The point at fraction t of the move.
[[nodiscard]] geometry::Vec3 point_of(const Move& m, double t);
/// Box of the move, extrema of arcs included.
[[nodiscard]] geometry::Box3 box_of(const Move& m);
/// Straight pieces whose distance from an arc is at most `chord_mm`; one for a line.
[[nodiscard]] int pieces_of(const Move& m, double chord_mm);

}  // namespace capstan::verify

#pragma once

#include <array>

#include "planner/ground/base/result.h"
#include "planner/ground/geometry/vec.h"
#include "planner/model/plan/cutter_path.h"
#include "planner/model/plan/resources/machine.h"
#include "planner/physics/motion/profile.h"

/// One move of a path as the axes see it. Internal to the room.
namespace capstan::motion {

struct Limits {
  std::array<double, 3> rapid_mm_s{}, feed_mm_s{}, acceleration{}, jerk{};
  bool has_jerk = false;
  double tolerance_mm = 0.0;
  double block_s = 0.0;
  /// largest share of the acceleration for turning, and smallest share along the path
  double turning_share = 0.0, along_share = 0.0;
};

/// Fails  MOT-MACHINE for an axis without acceleration or speed.
[[nodiscard]] Result<Limits> limits_of(const model::Machine& machine);

/// A move with its directions at both ends; a speed of kNoSpeed asks for all the axes give.
struct Shape {
  Segment segment;
  geometry::Vec3 first, last;  ///< unit tangents; zero for a move without length
  double axes_mm_s = 0.0;      ///< what the axes allow, feed aside
  double turning_mm_s = 0.0;   ///< what an arc's centripetal acceleration allows
};
inline constexpr double kNoSpeed = 1e300;

/// Needs a move that is no dwell.
[[nodiscard]] Shape shape_of(const model::CutterPath& path, std::size_t move, double feed_mm_s,
                             const Limits& limits);

/// Speed of passing from one move into the next, and whether the path tolerance is what limits it.
struct Junction {
  double speed_mm_s = 0.0;
  bool by_tolerance = false;
};
[[nodiscard]] Junction junction(const Shape& before, const Shape& after, const Limits& limits);

/// Whether the control stops between two moves: rapid and feed, and at either end of tapping.
[[nodiscard]] bool stops_between(const model::CutterPath& path, std::size_t before, std::size_t after);

}  // namespace capstan::motion

#pragma once

#include <algorithm>

#include "planner/making/toolpath/path_job.h"
#include "planner/model/plan/cutter/ramp.h"

/// Default numbers that several kinds of path share. Used in this room only.
namespace capstan::toolpath {

/// Slope of a way into the solid where the file states none, rad; 0: the cutter must not ramp.
[[nodiscard]] inline double usual_ramp_rad(const PathJob& task) {
  const double asked = task.ramp_angle_rad > 0.0 ? task.ramp_angle_rad : model::kUsualRampRad;
  return std::min(task.cutter.maximum_ramp_angle_rad, asked);
}
/// Between the cutter and the material beside it, where it must be in the air, mm; default, unsourced.
inline constexpr double kAirBeside = 0.2;
/// Between the cutter's end and what is below it, where a ramp or a plunge begins, mm: over a floor that was
/// cut, and over the raw piece, whose height is less well known; default, unsourced.
inline constexpr double kAirAbove = 0.2;
inline constexpr double kAboveRaw = 1.0;
/// Between the cutter and the raw piece before a pass begins and behind its open end, mm; default, unsourced.
inline constexpr double kAirBeyond = 1.0;
/// A cutter that differs from what it cuts (a slot's width or height, a hole) by this at most is as large,
/// mm; default, unsourced.
inline constexpr double kSameSize = 0.02;

}  // namespace capstan::toolpath

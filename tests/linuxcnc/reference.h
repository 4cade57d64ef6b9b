#pragma once

#include <string>
#include <utility>
#include <vector>

#include "tests/linuxcnc/planned.h"
#include "tests/linuxcnc/simulator.h"
#include "tests/linuxcnc/times.h"

namespace capstan::linuxcnc {

/// The reference pocket with one way of choosing feeds: planned, written, run.
struct ReferenceRun {
  Planned planned;
  Record record;
  Comparison time;
  std::string failed;                 ///< why there is no result; empty: there is one
  std::vector<StepSeconds> measured;  ///< by step
};

/// Both runs of the same path: the schedule that the sections bear, and one feed for each step, the largest
/// that its heaviest section bears (`capstan plan --feeds constant`; plunges, ramps and ways through air are
/// the same in both).
struct Reference {
  ReferenceRun scheduled, constant;
  [[nodiscard]] std::string absent() const { return scheduled.record.absent + constant.record.absent; }
  [[nodiscard]] std::string failed() const { return scheduled.failed + constant.failed; }
  /// Simulated machine time of the schedule over that of the constant feed.
  [[nodiscard]] double ratio() const { return scheduled.time.measured_s / constant.time.measured_s; }
};
[[nodiscard]] Reference reference();

/// Simulated machine time of a pocket of this size on the same simulated machine with one feed of 600 mm/min,
/// as another planner made it, s. Source: stated with the aims of this comparison (FreeCAD's pocket).
inline constexpr double kOtherPlannerS = 260.0;

/// Length of all moves of all paths, mm.
[[nodiscard]] double path_length_mm(const model::Plan& plan);

/// Tables as CSV (name, content), with a line of titles:
///
///   reference_pocket.csv          run, time_s, x_mm, y_mm, z_mm (part), feed_mm_min: what the machine did,
///   each 10 ms reference_pocket_path.csv     run, step, at_mm, depth_mm, width_mm, section_mm2, feed_mm_min:
///   what was planned,
///                                 along the path's length within its step
///   reference_pocket_times.csv    run, step, measured_s, predicted_s
[[nodiscard]] std::vector<std::pair<std::string, std::string>> tables(const Reference& r);

}  // namespace capstan::linuxcnc

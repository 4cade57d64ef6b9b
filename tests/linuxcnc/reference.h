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

/// The runs of the same path.
struct Reference {
  ReferenceRun scheduled;  ///< the schedule that the sections bear
  /// One feed for each step, the largest that its heaviest section bears (`capstan plan --feeds constant`);
  /// plunges, ramps and ways through air as in the schedule.
  ReferenceRun constant;
  /// One feed for the whole program: what the heaviest of all its moves bears, plunges included.
  ReferenceRun one_feed;
  double one_feed_mm_min = 0.0;
  [[nodiscard]] std::string absent() const {
    return scheduled.record.absent + constant.record.absent + one_feed.record.absent;
  }
  [[nodiscard]] std::string failed() const { return scheduled.failed + constant.failed + one_feed.failed; }
  /// Simulated machine time of the schedule over that of the constant feed of each step.
  [[nodiscard]] double ratio() const { return scheduled.time.measured_s / constant.time.measured_s; }
  /// The same over that of one feed for all.
  [[nodiscard]] double ratio_to_one_feed() const {
    return scheduled.time.measured_s / one_feed.time.measured_s;
  }
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
///   reference_pocket_times.csv    run, step, measured_s, predicted_s (of one feed for all: 0, it is not
///   planned)
[[nodiscard]] std::vector<std::pair<std::string, std::string>> tables(const Reference& r);

}  // namespace capstan::linuxcnc

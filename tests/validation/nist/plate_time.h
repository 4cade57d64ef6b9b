#pragma once

#include "planner/model/plan/resources/machine.h"
#include "tests/validation/nist/plate_data.h"
#include "tests/validation/report.h"

namespace capstan::validation::nist {

/// What is calibrated of the machine. All positive.
struct MachineFit {
  double acceleration_mm_s2 = 0.0;  ///< of each axis
  double path_tolerance_mm = 0.0;   ///< corners are rounded by it
  double block_time_s = 0.0;
  double handling_s = 0.0;  ///< per tool: motion between the tool changer and the first point, and back
  double tool_exchange_s =
      0.0;  ///< standing still per tool, and with the spindle's start and stop at 12,000 rpm:
  double spindle_12000_s = 0.0;  ///< it grows with the square of the speed (constant power)
  double rms = 0.0;              ///< of ln(predicted / measured) over the calibrating rows
};

/// The machine of the plates with what was calibrated.
[[nodiscard]] model::Machine machine_of(const Plate& plate, const MachineFit& fit);

/// One tool of one part: measured moving time and the prediction.
struct Row {
  const ToolTime* time = nullptr;
  const PlatePart* part = nullptr;
  double feed_ipm = 0.0;
  bool feed_from_trace = false;
  double measured_s = 0.0;   ///< moving: Feed_Rate above zero, the plate's own program
  double predicted_s = 0.0;  ///< cutting, rapids and handling
  double rpm = 0.0;
  double active_s = 0.0;            ///< measured: the tool is in the spindle and the program runs
  double active_predicted_s = 0.0;  ///< the above and standing still
  double nominal_s = 0.0;           ///< length of the moves at feed over the feed
  [[nodiscard]] double error() const { return predicted_s / measured_s - 1.0; }
  [[nodiscard]] double active_error() const { return active_predicted_s / active_s - 1.0; }
};

/// Mean of the later run over the calibrating traces.
struct LaterRun {
  double moving_s = 0.0, active_s = 0.0;
};

struct TimeStudy {
  MachineFit fit;
  LaterRun later;
  std::vector<Row> rows;
};

/// The machine of the plates as nobody calibrated it: the one that is planned with where none is named, with
/// this machine's rapid and largest feed.
[[nodiscard]] Result<model::Machine> uncalibrated_machine(const Plate& plate);
/// All tools of all parts, predicted on a machine: what their programs hold, without `MachineFit::handling_s`
/// and without standing still. The rows point into the plate.
[[nodiscard]] Result<std::vector<Row>> times_on(const Plate& plate, const model::Machine& machine);

/// Calibrates on the parts that the set-up names and predicts all.
[[nodiscard]] Result<TimeStudy> study_times(const Plate& plate);

/// Part 7 predicted with the feeds of part 9: its times are those, whatever the schedule says.
[[nodiscard]] Result<std::vector<Row>> part_7_as_part_9(const Plate& plate, const TimeStudy& study);

[[nodiscard]] Comparison compare_times(const Plate& plate, const TimeStudy& study);

}  // namespace capstan::validation::nist

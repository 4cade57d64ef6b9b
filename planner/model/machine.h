#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "planner/base/result.h"

namespace capstan::model {

/// A linear axis. Units: mm, mm/min, mm/s2, mm/s3. Travel is in machine coordinates.
struct LinearAxis {
  std::string name;  ///< "X", "Y", "Z"
  double travel_min_mm = 0.0, travel_max_mm = 0.0;
  double rapid_mm_min = 0.0, feed_max_mm_min = 0.0;
  double acceleration_mm_s2 = 0.0;
  std::optional<double> jerk_mm_s3;
  friend bool operator==(const LinearAxis&, const LinearAxis&) = default;
};

/// A point of the spindle's curve for continuous running (S1).
struct SpindlePoint {
  double rpm = 0.0, power_w = 0.0, torque_nm = 0.0;
  friend bool operator==(const SpindlePoint&, const SpindlePoint&) = default;
};

struct Spindle {
  double rpm_min = 0.0, rpm_max = 0.0;
  std::vector<SpindlePoint> curve;  ///< by rising rpm
  std::string taper;
  double efficiency = 1.0;  ///< cutting power / motor power
  double spin_up_s = 0.0;
  friend bool operator==(const Spindle&, const Spindle&) = default;
};

/// The control: what programs look like and how it follows them.
struct Control {
  std::string dialect = "linuxcnc";
  int decimals = 4;  ///< of lengths in mm
  int feed_decimals = 1;
  double path_tolerance_mm = 0.01;  ///< G64 P
  double block_time_s = 0.0;        ///< least time per block
  friend bool operator==(const Control&, const Control&) = default;
};

/// machine_parameters of AP238, and what optimisation needs beside it. `sources` says where each comes from.
struct Machine {
  std::string id, description;
  std::array<LinearAxis, 3> axes;  ///< X, Y, Z
  Spindle spindle;
  int magazine_pockets = 0;
  double tool_diameter_max_mm = 0.0, tool_length_max_mm = 0.0;
  double tool_change_s = 0.0;
  bool has_flood = true, has_mist = false, has_through = false;
  double cost_per_hour = 0.0;  ///< any currency; used by objective cost
  Control control;
  std::vector<std::pair<std::string, std::string>> sources;  ///< (value's path, source), in file order
  friend bool operator==(const Machine&, const Machine&) = default;
};

}  // namespace capstan::model

#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "planner/ground/base/result.h"

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

/// A gear (or belt) stage: where it turns, and what it gives there.
struct SpindleGear {
  std::string id;
  double rpm_min = 0.0, rpm_max = 0.0;
  std::vector<SpindlePoint> curve;     ///< S1, by rising rpm
  std::vector<SpindlePoint> curve_s6;  ///< S6 (40 %), by rising rpm; empty: not known
  friend bool operator==(const SpindleGear&, const SpindleGear&) = default;
};

/// `rpm_min`, `rpm_max` and `curve` are of the gear in use, or of the only one.
struct Spindle {
  double rpm_min = 0.0, rpm_max = 0.0;
  std::vector<SpindlePoint> curve;  ///< by rising rpm
  std::string taper;
  double efficiency = 1.0;  ///< cutting power / motor power
  double spin_up_s = 0.0;
  std::vector<SpindleGear> gears;  ///< empty: one, as above
  friend bool operator==(const Spindle&, const Spindle&) = default;
};

/// The control: what programs look like and how it follows them.
struct Control {
  std::string dialect = "linuxcnc";
  int decimals = 4;  ///< of lengths in mm
  int feed_decimals = 1;
  double path_tolerance_mm = 0.01;  ///< G64 P
  double block_time_s = 0.0;        ///< least time per block
  /// The Z of its tool table count from a reference tool or gauge, not from the gage line; nothing: not said.
  std::optional<bool> offsets_against_reference = std::nullopt;
  friend bool operator==(const Control&, const Control&) = default;
};

/// One thing that controls of a kind do differently from machine to machine: a row of
/// ground/vocabulary/control_options.h by its name, and its value as that row takes it.
struct ControlOption {
  std::string name, value;
  friend bool operator==(const ControlOption&, const ControlOption&) = default;
};
struct ControlOptions {
  std::vector<ControlOption> chosen;  ///< in file order; what is not among them is the row's default
  friend bool operator==(const ControlOptions&, const ControlOptions&) = default;
};

/// A mode of vibration of a tool point, as a tap test gives it.
struct ToolPointMode {
  std::string cutter_id;  ///< empty: any
  std::string direction;  ///< "x" or "y" of the machine
  double frequency_hz = 0.0, damping_ratio = 0.0, stiffness_n_mm = 0.0;
  friend bool operator==(const ToolPointMode&, const ToolPointMode&) = default;
};

/// What a machine can do beside moving and turning; machine_parameters of AP238 where they have a word for
/// it.
struct MachineAbilities {
  int control_axes = 3, simultaneous_axes = 3;
  double positioning_accuracy_mm = 0.0;  ///< 0 unknown
  bool table_indexing = false;
  double table_length_mm = 0.0, table_width_mm = 0.0;  ///< 0 unknown
  bool rigid_tapping = true;                           ///< the control synchronises spindle and feed
  bool probe = false;                                  ///< a touch probe is connected
  double through_pressure_bar = 0.0;                   ///< of coolant through the spindle; 0: none or unknown
  double feed_override_max = 1.2;     ///< what the operator may turn the feed up to; limits hold there, too
  double magazine_mass_max_kg = 0.0;  ///< of one tool; 0 unknown
  friend bool operator==(const MachineAbilities&, const MachineAbilities&) = default;
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
  MachineAbilities abilities;
  std::vector<ToolPointMode> modes;  ///< empty: stability is judged by slenderness alone
  std::vector<std::pair<std::string, std::string>> sources;      ///< (value's path, source), in file order
  std::optional<ControlOptions> control_options = std::nullopt;  ///< none: all at their defaults
  friend bool operator==(const Machine&, const Machine&) = default;
};

}  // namespace capstan::model

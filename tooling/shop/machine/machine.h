#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "planner/ground/base/job.h"
#include "planner/ground/base/result.h"
#include "planner/model/plan/resources/machine.h"

namespace capstan::tooling {

inline constexpr std::string_view kDefaultMachine = "generic_vmc";
/// For parts that are too large for the default one.
inline constexpr std::string_view kLargeMachine = "generic_vmc_large";

/// Ids of the machines that come with the planner, sorted.
[[nodiscard]] std::vector<std::string> shipped_machines();

/// A machine by the path of its file, or a shipped one by id. YAML (tooling/data/machines/README.md) or a
/// LinuxCNC .ini, told apart by content. "name:gear" puts it into that gear; otherwise its first is in use.
/// Fails  NAME-UNKNOWN for a text without folder and ending that is neither a file nor an id; FILE-*,
///        MACHINE-GEAR, and as `read_machine`.
[[nodiscard]] Result<model::Machine> load_machine(const std::string& path, Job& job);

/// Fails  DATA-* for the form (unknown keys are errors; every number needs a source), MACHINE-RANGE (min
///        above max, a negative), MACHINE-ACCELERATION (zero), MACHINE-CURVE (backwards, not covering the
///        speeds), MACHINE-RPM (looks like revolutions per second), MACHINE-AXIS (unknown or missing).
[[nodiscard]] Result<model::Machine> read_machine(std::string_view text, const std::string& file, Job& job);

/// The machine with that gear in use: Spindle::rpm_min, rpm_max and curve are the gear's.
/// Fails  MACHINE-GEAR, naming the gears that there are.
[[nodiscard]] Result<model::Machine> in_gear(model::Machine m, std::string_view id);

/// A LinuxCNC configuration: travel, velocities and accelerations of [AXIS_*]; an inch machine in mm. What it
/// does not state (spindle, magazine) is a default, warned as MACHINE-DEFAULT and recorded in `sources`.
/// Fails  MACHINE-INI, and as `read_machine`.
[[nodiscard]] Result<model::Machine> read_linuxcnc_ini(std::string_view text, const std::string& file,
                                                       Job& job);

}  // namespace capstan::tooling

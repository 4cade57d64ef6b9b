#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "planner/base/job.h"
#include "planner/base/result.h"
#include "planner/model/machine.h"

namespace capstan::tooling {

inline constexpr std::string_view kDefaultMachine = "generic_vmc";

/// Ids of the machines that come with the planner, sorted.
[[nodiscard]] std::vector<std::string> shipped_machines();

/// A machine by the path of its file, or a shipped one by id. YAML (tooling/data/machines/README.md) or a
/// LinuxCNC .ini, told apart by content.
/// Fails  FILE-*, and as `read_machine`.
[[nodiscard]] Result<model::Machine> load_machine(const std::string& path, Job& job);

/// Fails  DATA-* for the form (unknown keys are errors; every number needs a source), MACHINE-RANGE (min
///        above max, a negative), MACHINE-ACCELERATION (zero), MACHINE-CURVE (backwards, not covering the
///        speeds), MACHINE-RPM (looks like revolutions per second), MACHINE-AXIS (unknown or missing).
[[nodiscard]] Result<model::Machine> read_machine(std::string_view text, const std::string& file, Job& job);

/// A LinuxCNC configuration: travel, velocities and accelerations of [AXIS_*]; an inch machine in mm. What it
/// does not state (spindle, magazine) is a default, warned as MACHINE-DEFAULT and told in `sources`.
/// Fails  MACHINE-INI, and as `read_machine`.
[[nodiscard]] Result<model::Machine> read_linuxcnc_ini(std::string_view text, const std::string& file,
                                                       Job& job);

}  // namespace capstan::tooling

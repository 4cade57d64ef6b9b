#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "planner/door/late/tools/tool_state.h"
#include "planner/ground/base/job.h"
#include "planner/ground/base/result.h"
#include "planner/ground/geometry/vec.h"
#include "planner/model/plan/plan.h"
#include "planner/model/plan/resources/machine.h"

namespace capstan::service {

/// Where an axis may be now, mm, machine coordinates.
struct AxisLimit {
  std::string axis;
  double least_mm = 0.0, most_mm = 0.0;
};
/// Where a work offset lies, mm, machine coordinates.
struct WorkOffset {
  std::string name;  ///< "G54"; empty: every one that a program names
  geometry::Vec3 at_mm;
};

/// What a control says of its machine as it runs. Nothing: as its machine file has it.
struct MachineState {
  std::optional<double> spindle_power_kw;  ///< at most, at the motor
  std::optional<unsigned> feed_override;   ///< %, 1 to 100
  std::vector<AxisLimit> axis_limits;      ///< a program that leaves them is not given
  std::vector<WorkOffset> work_offsets;
  std::vector<late::ToolState> tools;  ///< beside what the tool table says of them
  std::size_t tools_told_at = 0;       ///< LatePolicy::tools_told_at
};

/// "X=0:350,Z=-200:-5". Fails  OPTION-VALUE where it is not that, a range is empty, or an axis comes twice.
[[nodiscard]] Result<std::vector<AxisLimit>> parse_axis_limits(const std::string& text);
/// "X=120,Y=80,Z=-310", or by name "G54:X=120,Y=80,Z=-310;G55:…". Fails  OPTION-VALUE where it is not that,
/// an axis is missing, a name comes twice, or one of several has none.
[[nodiscard]] Result<std::vector<WorkOffset>> parse_work_offsets(const std::string& text);

/// The machine as its state leaves it, and what that is in rows of provenance, from `sign` and the option's
/// name. States narrow only, so that one that is said again changes nothing: power and torque of the spindle
/// stay below `spindle_power_kw` at each speed. The machine keeps its travels: limits of axes are held
/// against the program that comes of it (`leaves_limits`) and move nothing. Notes   LATE-OVERRIDE, that times
/// are those of the whole feed.
void take_state(const MachineState& state, const std::string& sign, model::Machine& machine,
                std::vector<model::Provenance>& provenance, Job& job);

}  // namespace capstan::service

#pragma once

#include <optional>
#include <string>

#include "planner/model/plan/cutter.h"
#include "planner/model/plan/machine.h"
#include "planner/model/plan/material.h"
#include "planner/model/plan/proposal.h"
#include "tooling/select/select.h"

// What a cutter must hold to, and what it would take; only tooling/select/*.cpp include this.

namespace capstan::tooling {

/// Sizes are compared after the printer's rounding; below this two are one.
inline constexpr double kSizeSlackMm = 1e-6;

[[nodiscard]] double lower_size(const model::ToolRequirement& r);
[[nodiscard]] double upper_size(const model::ToolRequirement& r);
/// Flutes at least: for the depth of cut, and for walls that are cut in one depth.
[[nodiscard]] double flutes_wanted(const model::ToolRequirement& r);
/// Whether the class feeds along its axis: drills, reamers, taps, sinks.
[[nodiscard]] bool feeds_along_axis(model::CutterClass c);

// The limits, in the order they are asked. Each gives the limit that fails, with both numbers.
[[nodiscard]] std::optional<std::string> wrong_size(const model::Cutter& c, const model::ToolRequirement& r);
[[nodiscard]] std::optional<std::string> wrong_shape(const model::Cutter& c, const model::ToolRequirement& r);
[[nodiscard]] std::optional<std::string> too_short(const model::Cutter& c, const model::ToolRequirement& r);
[[nodiscard]] std::optional<std::string> not_for_machine(const model::Cutter& c, const StartValues& start,
                                                         const model::WorkMaterial& w,
                                                         const model::Machine& m, const Preferences& p);

/// What a step would take with a cutter, in seconds; money counts as the machine's time that it buys.
struct Estimate {
  double cutting_s = 0.0;  ///< removal at start values, within power, torque and bending
  double tool_s = 0.0;     ///< price over life, and changes when its life ends
  std::string limited_by;  ///< "", "torque", "power", "bending"
};
[[nodiscard]] Estimate estimate(const model::Cutter& c, const model::ToolRequirement& r,
                                const StartValues& start, const model::WorkMaterial& w,
                                const model::Machine& m, const Preferences& p);
/// Minutes left on the tool and its sisters; nothing when its life is not known.
[[nodiscard]] std::optional<double> life_left_min(const model::Cutter& c);

}  // namespace capstan::tooling

#pragma once

#include <optional>
#include <string>

#include "planner/model/plan/cutter/cutter.h"
#include "planner/model/plan/proposal.h"
#include "planner/model/plan/resources/machine.h"
#include "planner/model/plan/resources/material.h"
#include "planner/physics/mechanics/spindle.h"
#include "tooling/selection/select.h"

// Limits of a cutter for a requirement, and the estimate of its time; only tooling/selection/*.cpp include
// this.

namespace capstan::tooling {

/// A machine with the curve of its spindle, made once for all cutters; nothing where it states none.
struct Turning {
  explicit Turning(const model::Machine& m) : machine(m) {
    if (auto made = mechanics::curve_of(m.spindle)) curve = *std::move(made);
  }
  const model::Machine& machine;
  std::optional<mechanics::SpindleCurve> curve;
};

/// As `start_values`, but for `why`: most cutters are passed over, and nobody reads their reasons.
[[nodiscard]] StartValues start_numbers(const model::Cutter& c, const model::WorkMaterial& material,
                                        const model::Machine& machine);

// The limits in the order of checking. Each returns the limit that fails, with both numbers.
/// Whether its diameter lies outside what is wanted.
[[nodiscard]] bool is_other_size(const model::Cutter& c, const model::ToolRequirement& r);
[[nodiscard]] std::optional<std::string> wrong_shape(const model::Cutter& c, const model::ToolRequirement& r);
/// Flutes that are needed, mm: what is cut; behind a reamer whose shank is as wide as its hole, or not known,
/// as long as it goes down, for the shank would rub in the finished hole and chips leave by flutes that stand
/// out.
[[nodiscard]] double flutes_needed(const model::Cutter& c, const model::ToolRequirement& r);
[[nodiscard]] std::optional<std::string> too_short(const model::Cutter& c, const model::ToolRequirement& r);
[[nodiscard]] std::optional<std::string> not_for_machine(const model::Cutter& c, const StartValues& start,
                                                         const model::WorkMaterial& w, const Turning& t,
                                                         const Preferences& p);

/// Estimated time of a step with a cutter, s; money counts as the machine's time that it buys.
struct Estimate {
  double cutting_s = 0.0;  ///< removal at start values, within power, torque and bending
  double tool_s = 0.0;     ///< price over life, and changes when its life ends
  std::string limited_by;  ///< "", "torque", "power", "bending"
};
[[nodiscard]] Estimate estimate(const model::Cutter& c, const model::ToolRequirement& r,
                                const StartValues& start, const model::WorkMaterial& w, const Turning& t,
                                const Preferences& p);
/// Minutes left on the tool and its sisters; nothing when its life is not known.
[[nodiscard]] std::optional<double> life_left_min(const model::Cutter& c);

}  // namespace capstan::tooling

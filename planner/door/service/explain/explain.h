#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "planner/ground/base/result.h"
#include "planner/model/plan/plan.h"

namespace capstan::service {

/// The plan as a whole: inputs and defaults, set-ups, a line per step and per tool, what is unplanned and
/// why, what is still open. Text for people; same plan, same bytes.
[[nodiscard]] std::string explain(const model::Plan& plan);

/// What the plan leaves open, each in a few words: "feedrate of MILLING_TECHNOLOGY 'x', step 'y'"; of a part
/// without a workingstep: that it has none.
[[nodiscard]] std::vector<std::string> open_texts(const model::Plan& plan);

/// One workingstep: each value of its operation, tool, technology and strategy, who bound it, why and by
/// which source, what limited it, what it depends on, and what was rejected.
///
/// `step` is the persistent id, the its_id, or the number in the order of execution.
/// Fails  EXP-STEP, with the names there are.
[[nodiscard]] Result<std::string> explain(const model::Plan& plan, std::string_view step);

/// One attribute of a workingstep by its ISO 14649 name, or a computed one (axial_depth, radial_depth, vc,
/// fz, spindle_rpm, feed, time, cutter): as above with the whole chain of what it depends on. Fails EXP-STEP,
/// EXP-ATTRIBUTE with the names there are.
[[nodiscard]] Result<std::string> explain(const model::Plan& plan, std::string_view step,
                                          std::string_view attribute);

}  // namespace capstan::service

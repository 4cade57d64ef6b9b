#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "planner/controls/gcode/words.h"
#include "planner/ground/base/result.h"
#include "planner/model/plan/plan.h"

namespace capstan::controls::gcode {

/// What the machine's options say that several controls have (ground/vocabulary/control_options.h).
[[nodiscard]] BlockNumbers block_numbers_of(const model::Machine& machine);
/// The block behind the last step of each tool; empty for none.
[[nodiscard]] std::string tool_end_of(const model::Machine& machine);

/// The codes that switch coolant through the spindle.
struct ThroughCodes {
  std::string on, off;
};
/// Nothing where the machine's file does not state both.
[[nodiscard]] std::optional<ThroughCodes> through_codes_of(const model::Machine& machine);

/// The blocks of an option that has some, with | between.
[[nodiscard]] std::vector<std::string> blocks_of(std::string_view option);

/// Fails  OUT-OPTION for an option of the plan's machine that its control does not have, or not so.
[[nodiscard]] Status options_right(const model::Plan& plan);

/// Fails  OUT-OPTION where the number of the machine's programs (`program_number`) is one of the `count`
/// subprograms from number `first` on.
[[nodiscard]] Status numbers_differ(const model::Machine& machine, int first, std::size_t count);

}  // namespace capstan::controls::gcode

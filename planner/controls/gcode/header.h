#pragma once

#include <string_view>
#include <vector>

#include "planner/controls/gcode/program.h"
#include "planner/ground/base/result.h"
#include "planner/model/plan/decision/condemned.h"
#include "planner/model/plan/plan.h"

namespace capstan::controls::gcode {

/// The plan's cutters by rising tool number.
[[nodiscard]] std::vector<const model::Cutter*> by_tool_number(const model::Plan& plan);

/// The comments that a program begins with: what it is for, its set-ups and tools with their lengths (read
/// back by the check), tools that are not measured, and why it must not be run.
void write_header(const model::Plan& plan, const std::vector<model::Condemnation>& condemned, Program& out);

/// The shop's own lines of comment of that kind (model/plan/resources/shop_texts.h).
/// Fails  OUT-TEXT for one that can be no comment.
[[nodiscard]] Status write_texts(const model::Plan& plan, std::string_view what, Program& out);

/// The tool of the next step behind that one which has another; null: none has.
[[nodiscard]] const model::Cutter* next_tool(const model::Plan& plan, std::size_t step);

}  // namespace capstan::controls::gcode

#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "planner/controls/dialect.h"

namespace capstan::controls {

/// All controls that programs are written for, in the order in which help texts name them.
/// A new control is a folder beside this file and one row in controls.cpp.
[[nodiscard]] std::span<const Dialect* const> dialects();

/// The control of that name; null when there is none.
[[nodiscard]] const Dialect* find_dialect(std::string_view id);

/// The machine with the named control. A machine that has it comes back as it is. Of another control the
/// machine takes the name, has no more decimals than that control writes, and loses its options: the file
/// states them of its own control. The path tolerance stays; where programs of the named control cannot state
/// it, `suitability` says that it is assumed (FIT-TOLERANCE).
[[nodiscard]] model::Machine with_control(model::Machine machine, const std::string& dialect);

/// The plan as a program of its machine's control (Plan::machine.control.dialect).
/// Fails  OUT-DIALECT for a control that has no row, and as the control's writer.
[[nodiscard]] Result<std::string> write_program(const model::Plan& plan, Job& job,
                                                const std::vector<model::Condemnation>& condemned = {});
/// The tool table of that program; empty for a control that has no row or reads no tool table.
[[nodiscard]] std::string tool_table_of(const model::Plan& plan);

}  // namespace capstan::controls

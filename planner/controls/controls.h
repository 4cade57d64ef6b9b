#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "planner/ground/base/job.h"
#include "planner/ground/base/result.h"
#include "planner/model/plan/decision/condemned.h"
#include "planner/model/plan/plan.h"

namespace capstan::controls {

/// One control that programs are written for: what its files hold and who writes them.
/// A new control is a folder beside this file with these two functions, and one row in controls.cpp.
struct Dialect {
  std::string_view id;  ///< model::Control::dialect, e.g. "linuxcnc": what it does is model::control_kind
  std::string_view tool_table_name;                  ///< its tool table as a format, "linuxcnc_tools"
  std::string_view program_media, tool_table_media;  ///< media types (RFC 6838)
  /// The plan as one program; `condemned` as in linuxcnc.h.
  Result<std::string> (*write_program)(const model::Plan& plan, Job& job,
                                       const std::vector<model::Condemnation>& condemned);
  /// The tools of that program as the control reads them.
  std::string (*write_tool_table)(const model::Plan& plan);
};

/// All controls, in the order in which help texts name them.
[[nodiscard]] std::span<const Dialect> dialects();

/// The control of that name; null when there is none.
[[nodiscard]] const Dialect* find_dialect(std::string_view id);

/// The plan as a program of its machine's control (Plan::machine.control.dialect).
/// Fails  OUT-DIALECT for a control that has no row, and as the control's writer.
[[nodiscard]] Result<std::string> write_program(const model::Plan& plan, Job& job,
                                                const std::vector<model::Condemnation>& condemned = {});
/// The tool table of that program; empty for a control that has no row.
[[nodiscard]] std::string tool_table_of(const model::Plan& plan);

}  // namespace capstan::controls

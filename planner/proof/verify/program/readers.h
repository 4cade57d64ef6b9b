#pragma once

#include <span>
#include <string_view>

#include "planner/model/plan/resources/machine.h"
#include "planner/proof/verify/program/program.h"
#include "planner/proof/verify/program/tool_table.h"

namespace capstan::verify {

/// Who reads the programs of a control back for the check: written from the control's manual, without the
/// writer's code. What it says of the control is a copy on purpose; tests/door/service/controls_test.cpp
/// holds it against the writer's.
struct DialectReader {
  std::string_view dialect;                        ///< as model::Control has it
  std::string_view name;                           ///< for people
  std::span<const std::string_view> work_offsets;  ///< in the order of their numbers
  /// By what the machine's file says of its control.
  Program (*program)(std::string_view text, const model::Machine& machine);
  ToolTable (*tool_table)(std::string_view text);  ///< null for a control that reads no tool table
  int speed_decimals = 1;                          ///< of S, 1/min
  bool states_tolerance = true;                    ///< its programs say how far corners are rounded
  /// As it says them, for messages: to the top of Z, which follows, and the length of a tool.
  std::string_view to_top = "G53 G0 Z", to_top_end = "", length = "G43";
};

/// The reader for programs of that control; null when there is none.
[[nodiscard]] const DialectReader* reader_of(std::string_view dialect);

/// The work offsets of that control; those of the first row for a control without one, whose set-ups are
/// named like that.
[[nodiscard]] std::span<const std::string_view> work_offsets_of(std::string_view dialect);

}  // namespace capstan::verify

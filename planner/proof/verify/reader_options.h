#pragma once

#include <string_view>

#include "planner/model/plan/resources/machine.h"

namespace capstan::verify {

// What the readers take where a machine's file states nothing is in their rows (DialectReader::options): a
// copy on purpose of the options of `kControlRows` (ground/vocabulary/control_rows.h) that a reader asks for,
// since a wrong default must not pass both the writer and the check. tests/proof/verify/copies_test.cpp holds
// it against that table.

/// The default of that option for that control; "-": its reader has none.
[[nodiscard]] std::string_view reader_default(std::string_view control, std::string_view name);

/// The machine's value of that option, else the default of its control; empty where nothing is stated.
/// Throws std::logic_error for a name that the control's reader does not have: our own mistake.
[[nodiscard]] std::string_view option(const model::Machine& machine, std::string_view name);
/// The same as a number; 0 where there is none.
[[nodiscard]] double option_number(const model::Machine& machine, std::string_view name);
/// Whether the length of a tool is in the zero of Z of the work offset that was set with it at its change,
/// and in no block of the program; false for a control without the option.
[[nodiscard]] bool touches_off(const model::Machine& machine);

}  // namespace capstan::verify

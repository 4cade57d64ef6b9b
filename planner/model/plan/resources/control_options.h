#pragma once

#include <string_view>

#include "planner/model/plan/resources/machine.h"

namespace capstan::model {

/// The machine's value of an option of its control (ground/vocabulary/control_options.h), else the row's
/// default; empty where the control has no such option.
[[nodiscard]] std::string_view control_option(const Machine& machine, std::string_view name);
/// The same as a number; `other` where it is not stated.
[[nodiscard]] double control_number(const Machine& machine, std::string_view name, double other);

/// The blocks of the machine's macro for one touch (option `probe_macro`), with | between, those of a shipped
/// one (ground/vocabulary/probe_macros.h) in place of its id; empty: none.
[[nodiscard]] std::string_view probe_macro_blocks(const Machine& machine);
/// How far beyond the expected wall a shipped one goes where there is none, mm; 0 of the shop's own.
[[nodiscard]] double probe_macro_beyond_mm(const Machine& machine);
/// The id of a shipped macro that the machine's file names and nobody has confirmed; empty: none.
[[nodiscard]] std::string_view unconfirmed_probe_macro(const Machine& machine);

/// What is wrong with a value for that option: "'g54' is none of g53 g28"; empty: nothing.
[[nodiscard]] std::string control_option_fault(std::string_view dialect, const ControlOption& option);

}  // namespace capstan::model

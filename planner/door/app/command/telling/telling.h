#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <string_view>

#include "planner/ground/base/result.h"

// How the command tells on standard error what it does and found.

namespace capstan::app {

/// How the command shows progress.
enum class ProgressForm : std::uint8_t {
  kAuto,  ///< a bar on a terminal, once the work takes more than a second
  kJson,  ///< a line of JSON every half second, on a terminal or not
  kNone,
};

/// Shows progress in the form `told`; null: it shows none. `bar`: standard error is a terminal and is read by
/// a person.
[[nodiscard]] std::function<void(std::string_view stage, double fraction)> progress_teller(ProgressForm told,
                                                                                           bool bar);
/// Takes the bar off the terminal.
void end_progress();

/// Whether lines are coloured: standard error is a terminal that has them, and NO_COLOR (no-color.org) is not
/// set.
[[nodiscard]] bool in_colour();
/// `to_text` in one line, its severity coloured where `colour`.
[[nodiscard]] std::string line_of(const Diagnostic& d, bool colour);

}  // namespace capstan::app

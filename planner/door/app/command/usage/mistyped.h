#pragma once

#include <optional>
#include <span>
#include <string>

#include "planner/door/app/command/reference.h"
#include "planner/ground/base/result.h"

namespace capstan::app {

/// The first word of a command line that is no command, option or choice of what it stands behind, with those
/// that it may mean (NAME-UNKNOWN); nothing where each is known, whatever else is wrong.
/// `words` begins behind the program's name.
[[nodiscard]] std::optional<Diagnostic> mistyped(const CommandText& all, std::span<const char* const> words);

/// Whether a command line that was not understood asks for its faults as JSON (--diagnostics json).
[[nodiscard]] bool wants_json(std::span<const char* const> words);

}  // namespace capstan::app

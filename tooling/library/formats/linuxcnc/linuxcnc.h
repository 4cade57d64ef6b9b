#pragma once

#include <string_view>

/// @file LinuxCNC's tool table: one line per tool, `T1 P1 X0 Z+80.5 D6 ;6 mm end mill`. Source: LinuxCNC user
/// manual, "Tool table". PathPilot's is of the same form. The table states no unit; it is that of the
/// machine.

namespace capstan::tooling {

/// Whether the first line that says anything begins with a tool number.
[[nodiscard]] bool looks_like_tool_table(std::string_view text);

}  // namespace capstan::tooling

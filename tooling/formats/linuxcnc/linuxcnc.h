#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "planner/model/cutter.h"

/// @file LinuxCNC's tool table: one line per tool, `T1 P1 X0 Z+80.5 D6 ;6 mm end mill`. Source: LinuxCNC user
/// manual, "Tool table". PathPilot's is of the same form. The table states no unit; it is that of the
/// machine.

namespace capstan::tooling {

/// Whether the first line that says anything begins with a tool number.
[[nodiscard]] bool looks_like_tool_table(std::string_view text);

/// What the words of a comment tell beyond the class; see also `class_from_words`.
struct CommentWords {
  int teeth = 0;          ///< "4 flute", "3fl"
  bool carbide = false;   ///< "carbide", "VHM", "Hartmetall"
  double pitch_mm = 0.0;  ///< "M8x1.25", or the coarse pitch of the diameter; taps only
};
[[nodiscard]] CommentWords words_of_comment(std::string_view comment, model::CutterClass c,
                                            double diameter_mm);

}  // namespace capstan::tooling

#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>

namespace capstan::controls::gcode {

/// Decimals of a number in a program at most: a double of six digits before the point has no more to say.
inline constexpr int kMostDecimals = 7;

/// What one control says in its own way; `write` (writer.h) says the rest as all RS-274 controls do. A member
/// with a default says what NIST RS274/NGC 3.5 says; a control that agrees leaves it out.
/// Units  texts are numbers of mm, mm per turn or s, already rounded and written by `number`.
struct Words {
  std::span<const std::string_view> work_offsets;  ///< in the order in which set-ups get them
  std::size_t longest_line = 0;                    ///< characters, without the line's end
  int speed_decimals = 0, dwell_decimals = 0, pitch_decimals = 0;
  std::string_view first, last;  ///< lines that begin and end a program; `first` may be empty
  std::string_view comment_begin = "(", comment_end = ")";
  /// The modal state before the first tool: millimetres, plane XY, absolute, feed per minute, no compensation
  /// of radius or length, no cycle.
  std::string_view first_state = "G21 G17 G90 G94 G40 G49 G80";
  /// The modal state at the head of each step: the same, but the length offset of the tool stays.
  std::string_view step_state = "G21 G17 G90 G94 G40 G80";
  /// Changes the tool; one or more lines.
  std::string (*change_tool)(const std::string& tool) = [](const std::string& tool) {
    return "T" + tool + " M6";
  };
  /// Applies the length offset of the tool in the spindle.
  std::string (*length_offset)(const std::string& tool) = [](const std::string& tool) {
    return "G43 H" + tool;
  };
  std::string (*number)(double value, int decimals) = nullptr;
  /// The path mode for a tolerance in mm; exact stop where the text is empty.
  std::string (*path_mode)(const std::string& tolerance) = nullptr;
  /// To that height in machine coordinates, by rapid.
  std::string (*retract)(const std::string& z) = nullptr;
  /// A line that shows a text to the operator; the program stops with an M0 behind it.
  std::string (*message)(const std::string& text) = nullptr;
  std::string (*dwell)(const std::string& seconds) = nullptr;
  /// Rigid tapping from `top` to `bottom` and back to `top`, where the tool is then; one or more lines.
  std::string (*tap)(const std::string& top, const std::string& bottom, const std::string& pitch) = nullptr;
};

}  // namespace capstan::controls::gcode

#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include "planner/model/plan/resources/machine.h"
#include "planner/proof/verify/program/program.h"
#include "planner/proof/verify/program/tool_table.h"

namespace capstan::verify {

/// What a control says for things that messages of the check name; as RS-274 has them where a reader's row
/// does not say otherwise.
struct ControlWords {
  std::string_view to_top = "G53 G0 Z", to_top_end = "";  ///< to the top of Z, which stands between
  std::string_view in_machine = "G53", length = "G43", change = "M6";
  std::string_view length_of = "G43 H",
                   length_of_end = "";  ///< what takes a tool's length; its number between
  std::string_view unit = "unit (G20/G21)", plane = "plane (G17)", distance = "distance mode (G90/G91)",
                   feed_mode = "feed mode (G93/G94/G95)", no_radius = "G40", no_cycle = "G80", exact = "G61",
                   start = "M3 or M4", speed = "S", feed = "F";
};

/// What makes the length of that tool act, "G43 H5".
[[nodiscard]] inline std::string length_of(const ControlWords& words, int tool) {
  return std::string(words.length_of) + std::to_string(tool) + std::string(words.length_of_end);
}

/// What stands in programs of a control and not in those of every other. Two controls that share one both
/// have it.
///
///     kProgramNumber  O and digits alone in a block
///     kOWord          O with a keyword or a name, as LinuxCNC's subroutines and loops begin
///     kText           `text`, wherever it stands in a block without blanks
///     kWord           `text` with no digit or decimal behind it, in a block with the address `other`
struct Sign {
  enum class Of : std::uint8_t { kProgramNumber, kOWord, kText, kWord };
  Of of = Of::kWord;
  std::string_view text = {};
  std::string_view what = {};  ///< for people: "a path tolerance"
  std::string_view other = {};
  friend constexpr bool operator==(const Sign& a, const Sign& b) {
    return a.of == b.of && a.text == b.text && a.other == b.other;
  }
};

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
  ControlWords words = {};
  /// Options that it asks for, each with its value where a machine's file states none: "prove_out=m1".
  std::string_view options = {};
  /// Work offsets that count on behind this name, as codes from this one: {541000, "G54.1P"}.
  int numbered_code = 0;
  std::string_view numbered_name = {};
  std::span<const Sign> signs = {};  ///< of its programs
  bool shows_text = false;           ///< what is to be done in a stop stands on its screen, not in a comment
};

/// All of them, in the order of the controls.
[[nodiscard]] std::span<const DialectReader> readers();

/// The reader for programs of that control; null when there is none.
[[nodiscard]] const DialectReader* reader_of(std::string_view dialect);

/// The work offsets of that control; those of the first row for a control without one, whose set-ups are
/// named like that.
[[nodiscard]] std::span<const std::string_view> work_offsets_of(std::string_view dialect);

}  // namespace capstan::verify

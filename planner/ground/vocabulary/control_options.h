#pragma once

#include <array>
#include <optional>
#include <string_view>

namespace capstan::model {

/// What controls of one kind do differently from machine to machine: a row per option, with the value that
/// holds where the machine's file states none. Machine files state them under `control`; writers of programs
/// and readers of programs ask `control_option` (planner/model/plan/resources/control_options.h).
struct ControlOptionRow {
  std::string_view name;
  /// Words that it takes, with blanks between; empty: a number from `least` to `most`, or any text where both
  /// are 0.
  std::string_view words;
  double least, most;
  /// The default for each control; "-": this control has no such option. An empty default: not stated.
  std::string_view of_fanuc, of_haas;
  std::string_view meaning, source;
};

/// Sources: FANUC Series 0i-MODEL B operator's manual B-63844EN/02 ("0i"), FANUC Series 30i user's manual
/// (machining centre) B-63944EN-2/02 ("30i"), FANUC connection manual B-63833EN-1/02 ("0i connection"), Haas
/// mill operator's manual 96-8000 ("Haas").
inline constexpr std::array kControlOptions{
    ControlOptionRow{"cycles", "feature explicit", 0, 0, "feature", "feature",
                     "holes as G81, G82, G85 and G89, threads as G74 and G84, where a cycle makes the path's "
                     "moves; or explicit moves",
                     "30i 5.1; Haas, canned cycles"},
    ControlOptionRow{
        "retract", "g53 g28", 0, 0, "g53", "g53",
        "to the top of Z in machine coordinates, or by way of the reference point, which is there",
        "0i 6.1 (G28), 7.1 (G53); Haas G28, G53"},
    ControlOptionRow{"tap", "m29 g84", 0, 0, "m29", "g84",
                     "rigid tapping is called by M29 S before G84, or G84 is always rigid",
                     "30i 5.2; Haas G84"},
    ControlOptionRow{"tap_feed", "per_revolution per_minute", 0, 0, "per_revolution", "per_minute",
                     "F of a tapping cycle: the pitch in G95, or pitch times speed in G94",
                     "0i connection 9 (G95: 0.0001 mm/rev); Haas G84"},
    ControlOptionRow{"tap_retract", "", 0, 9, "-", "0",
                     "J of G84: how many times faster the tap comes out; 0: no J", "Haas G84, J"},
    ControlOptionRow{"dwell", "milliseconds seconds", 0, 0, "milliseconds", "seconds",
                     "P of G4 and of cycles: whole milliseconds, or seconds with a decimal point",
                     "0i 5.1 (G04 P without point); Haas G04"},
    ControlOptionRow{"extended_offsets", "", 0, 300, "0", "99",
                     "work offsets beyond G59: so many of G54.1 P, at Haas of G154 P",
                     "0i 7.2.3 (option, 48 or 300); Haas G154"},
    ControlOptionRow{"ai_contour", "yes no", 0, 0, "no", "-",
                     "G05.1 Q1 before and Q0 after the moves of a milling step", "0i 19 (option)"},
    ControlOptionRow{"smoothness", "yes no", 0, 0, "-", "yes",
                     "G187 P E: the step's path tolerance, and P2 for roughing, P3 for finishing",
                     "Haas G187"},
    ControlOptionRow{"path_tolerance", "assumed set", 0, 0, "assumed", "-",
                     "the file's path_tolerance_mm is assumed, or the control's parameter is set to it",
                     "0i: no word of a program states it; default, unsourced"},
    ControlOptionRow{"next_tool", "staged called", 0, 0, "staged", "staged",
                     "the next tool is made ready (T) right after a change, or only called with M6",
                     "default, unsourced: the machine builder's tool changer says"},
    ControlOptionRow{"arcs", "half quadrant", 0, 0, "half", "half",
                     "arcs are at most half a turn, or end at quadrants",
                     "0i 4.4; default, unsourced: older controls stop at quadrants"},
    ControlOptionRow{"largest_radius_mm", "", 1, 999999, "99999.999", "15404.000",
                     "arcs of a larger radius are not taken",
                     "0i 4.4 (IS-B, metric); Haas, ranges of I and J"},
    ControlOptionRow{"helices", "yes no", 0, 0, "yes", "yes", "arcs may also go up or down",
                     "0i 4.5 (option); Haas"},
    ControlOptionRow{"block_numbers", "steps all none", 0, 0, "steps", "steps",
                     "N at the head of each step, at each block, or nowhere", "0i 12.2"},
    ControlOptionRow{"program_number", "", 1, 9999, "1", "1", "O of the program", "0i 12.1"},
    ControlOptionRow{
        "prove_out", "none m1 m0 skip_m0", 0, 0, "m1", "m1",
        "behind the last step of each tool: an optional stop, a stop, or a stop that block skip passes over",
        "0i 11 (M00, M01), 12.2 (/)"},
    ControlOptionRow{"comments", "upper mixed", 0, 0, "upper", "mixed",
                     "comments in capitals only, for controls without small letters",
                     "0i appendix, tape codes"},
    ControlOptionRow{"line_length", "", 72, 255, "200", "200", "characters of a block at most",
                     "default, unsourced"},
    ControlOptionRow{
        "peck_clearance_mm", "", 0, 10, "", "",
        "where G83 ends its rapid above the last peck, for the check; programs peck by explicit moves",
        "30i 5.1.6 (parameter 5115); Haas setting 22"},
    ControlOptionRow{"codes", "", 0, 0, "", "",
                     "the codes that this machine has, as G0 G1 M3, with blanks between; not stated: all",
                     "the machine builder's list of codes"},
};

[[nodiscard]] constexpr std::string_view default_of(const ControlOptionRow& row, std::string_view dialect) {
  if (dialect == "fanuc") return row.of_fanuc;
  return dialect == "haas" ? row.of_haas : std::string_view("-");
}

/// The row of that name which this control has; null: there is none.
[[nodiscard]] constexpr const ControlOptionRow* find_control_option(std::string_view dialect,
                                                                    std::string_view name) {
  for (const ControlOptionRow& row : kControlOptions) {
    if (row.name == name && default_of(row, dialect) != "-") return &row;
  }
  return nullptr;
}

/// Whether the row's words, blanks between, have this one.
[[nodiscard]] constexpr bool has_word(std::string_view words, std::string_view word) {
  for (std::size_t at = 0; at < words.size();) {
    const std::size_t end =
        words.find(' ', at) == std::string_view::npos ? words.size() : words.find(' ', at);
    if (words.substr(at, end - at) == word) return true;
    at = end + 1;
  }
  return false;
}

}  // namespace capstan::model

#pragma once

#include <array>
#include <cstdint>
#include <string_view>

#include "planner/ground/vocabulary/control_rows.h"

namespace capstan::model {

/// What controls of one kind do differently from machine to machine: a row per option. Which controls have
/// it, and its value where a machine's file states none, is in `kControlRows`. Machine files state
/// options under `control`; writers and readers of programs ask `control_option`
/// (planner/model/plan/resources/control_options.h).
struct ControlOptionRow {
  /// How a text must look: any; M codes with blanks between; two of them with / between.
  enum class Form : std::uint8_t { kAny, kMCodes, kMPair };
  std::string_view name;
  /// Words that it takes, with blanks between; empty: a number from `least` to `most`, or any text where both
  /// are 0.
  std::string_view words;
  double least, most;
  bool whole;  ///< of a number: without decimals
  std::string_view meaning, source;
  Form form = Form::kAny;
};

/// The last O that is the shop's: O8000 to O8999 can be locked against editing, O9000 to O9999 are the
/// machine builder's. Source  FANUC B-63844EN/02, 12.1, and parameter 3202 (NE8, NE9): numbers remembered.
inline constexpr int kLastOwnProgram = 7999;

/// Sources: FANUC Series 0i-MODEL B operator's manual B-63844EN/02 ("0i"), FANUC Series 30i user's manual
/// (machining centre) B-63944EN-2/02 ("30i"), FANUC connection manual B-63833EN-1/02 ("0i connection"), Haas
/// mill operator's manual 96-8000 ("Haas"), and for Siemens, Heidenhain and Grbl those of
/// planner/controls/siemens/siemens.h, planner/controls/heidenhain/heidenhain.h and
/// planner/controls/grbl/grbl.h.
inline constexpr std::array kControlOptions{
    ControlOptionRow{
        "cycles", "feature explicit pocket", 0, 0, false,
        "holes and threads as the control's cycles where one makes the path's moves (FANUC and Haas: G81, "
        "G82, G83, G73, G85, G86, G89, G74, G84; Siemens: MCALL CYCLE81, 82, 83, 85, 84, with HOLES1 and "
        "HOLES2; Heidenhain: CYCL DEF 200, 201, 203, 205, 207 with M99; LinuxCNC: G81, G82, G83, G73, G85, "
        "G86, G89, "
        "and G33.1 for threads; Mach3: G81, G82, G85, G86, G89), equal holes of a step at once; or explicit "
        "moves; pocket: as feature, and pockets, closed slots and faces as cycles of the control (Siemens: "
        "POCKET3, POCKET4, CYCLE71; Heidenhain: CYCL DEF 251, 252, 253), which take a path of its own",
        "30i 5.1; Haas, canned cycles; Siemens, drilling cycles; Heidenhain, cycles for drilling; LinuxCNC "
        "2.9, G-codes, canned cycles"},
    ControlOptionRow{
        "retract", "g53 g28", 0, 0, false,
        "to the top of Z in machine coordinates, or by way of the reference point, which is there",
        "0i 6.1 (G28), 7.1 (G53); Haas G28, G53"},
    ControlOptionRow{"tap", "m29 g84", 0, 0, false,
                     "rigid tapping is called by M29 S before G84, or G84 is always rigid",
                     "30i 5.2; Haas G84"},
    ControlOptionRow{"tap_feed", "per_revolution per_minute", 0, 0, false,
                     "F of a tapping cycle: the pitch in G95, or pitch times speed in G94",
                     "0i connection 9 (G95: 0.0001 mm/rev); Haas G84"},
    ControlOptionRow{"tap_retract", "", 0, 9, true,
                     "J of G84: how many times faster the tap comes out; 0: no J", "Haas G84, J"},
    ControlOptionRow{"dwell", "milliseconds seconds", 0, 0, false,
                     "P of G4 and of cycles: whole milliseconds, or seconds with a decimal point",
                     "0i 5.1 (G04 P without point); Haas G04; Mach3: a setting"},
    ControlOptionRow{"extended_offsets", "", 0, 300, true,
                     "work offsets beyond G59: so many of G54.1 P, at Haas of G154 P",
                     "0i 7.2.3 (option, 48 or 300); Haas G154"},
    ControlOptionRow{"ai_contour", "yes no", 0, 0, false,
                     "G05.1 Q1 before and Q0 after the moves of a milling step", "0i 19 (option)"},
    ControlOptionRow{"smoothness", "yes no", 0, 0, false,
                     "G187 P E: the step's path tolerance, and P2 for roughing, P3 for finishing",
                     "Haas G187"},
    ControlOptionRow{"path_tolerance", "assumed set", 0, 0, false,
                     "the file's path_tolerance_mm is assumed, or the control's parameter is set to it",
                     "0i: no word of a program states it; default, unsourced"},
    ControlOptionRow{"next_tool", "staged called", 0, 0, false,
                     "the next tool is made ready (T) right after a change, or only called with M6",
                     "default, unsourced: the machine builder's tool changer says"},
    ControlOptionRow{"arcs", "half quadrant", 0, 0, false,
                     "arcs are at most half a turn, or end at quadrants",
                     "0i 4.4; default, unsourced: older controls stop at quadrants"},
    ControlOptionRow{"largest_radius_mm", "", 1, 999999, false, "arcs of a larger radius are not taken",
                     "0i 4.4 (IS-B, metric); Haas, ranges of I and J"},
    ControlOptionRow{"helices", "yes no", 0, 0, false, "arcs may also go up or down",
                     "0i 4.5 (option); Haas"},
    ControlOptionRow{
        "block_numbers", "steps all none", 0, 0, false,
        "N at the head of each step that calls its tool, where a restart is safe; at each block; or nowhere",
        "0i 12.2"},
    ControlOptionRow{"program_number", "", 1, 9999, true, "O of the program", "0i 12.1"},
    ControlOptionRow{
        "prove_out", "none m1 m0 skip_m0", 0, 0, false,
        "behind the last step of each tool: an optional stop, a stop, or a stop that block skip passes over",
        "0i 11 (M00, M01), 12.2 (/)"},
    ControlOptionRow{"comments", "upper mixed", 0, 0, false,
                     "comments in capitals only, for controls without small letters",
                     "0i appendix, tape codes"},
    ControlOptionRow{"line_length", "", 72, 255, true, "characters of a block at most", "default, unsourced"},
    ControlOptionRow{
        "peck_clearance_mm", "", 0, 10, false,
        "where G83 ends its rapid above the last peck, at Haas also how far G73 comes up; not stated: pecks "
        "are explicit moves",
        "30i 5.1.6 (parameter 5115); Haas setting 22"},
    ControlOptionRow{"chip_break_mm", "", 0, 10, false,
                     "how far G73 comes up to break the chip; not stated: such pecks are explicit moves",
                     "30i 5.1.1 (parameter 5114)"},
    ControlOptionRow{"codes", "", 0, 0, false,
                     "the codes that this machine has, as G0 G1 M3, with blanks between; not stated: all",
                     "the machine builder's list of codes"},
    ControlOptionRow{"start_blocks", "", 0, 0, false,
                     "blocks of the shop behind the program's first state, with | between; the state is "
                     "stated again behind "
                     "them, and the check reads them as any others",
                     "the shop"},
    ControlOptionRow{"end_blocks", "", 0, 0, false,
                     "blocks of the shop before the program's end, with | between: the tool is away, spindle "
                     "and coolant are off",
                     "the shop"},
    ControlOptionRow{
        "shop_codes", "", 0, 0, false,
        "M codes of the machine's builder that move no axis, turn no spindle and change no state, as M51 "
        "M52, "
        "with blanks between: the check passes over them. A code with a meaning of the control's own is none",
        "the machine builder's list of codes", ControlOptionRow::Form::kMCodes},
    ControlOptionRow{
        "through_coolant", "", 0, 0, false,
        "the M codes that switch coolant through the spindle on and off, as M88/M89; not stated: no "
        "program of a plan that cuts with it",
        "Haas 96-8000, M88, M89; else the machine builder's list of codes", ControlOptionRow::Form::kMPair},
    ControlOptionRow{
        "probe_macro", "", 0, 0, false,
        "the blocks of the machine's macro for one touch, with | between, or the id of one that is shipped "
        "(probe_macros.h); places for what is touched stand between { and } (docs/programs.md). It takes the "
        "probe, goes over the start at the top of Z, straight down, touches, and comes back the same way. "
        "Written where that way is clear of the raw piece and of what holds it; the stop for the operator "
        "stays",
        "the maker of the probe or the shop"},
    ControlOptionRow{
        "probe_macro_confirmed", "no yes", 0, 0, false,
        "the shop has tried the shipped macro on this machine, above the table, and it does what "
        "is said of it; a shipped macro is not written before",
        "the shop"},
    ControlOptionRow{"probe_radius_mm", "", 0, 200, false,
                     "radius of the probe above its stylus; not stated: no touch is written",
                     "the maker of the probe"},
    ControlOptionRow{"probe_stylus_mm", "", 0, 1000, false,
                     "how far its ball's centre is below the probe; not stated: no touch is written",
                     "the maker of the probe"},
    ControlOptionRow{
        "probe_feed_mm_min", "", 1, 1000, false,
        "F of the move that ends where the probe touches (LinuxCNC and Grbl: G38.2, Mach3: G31); "
        "not stated: touches are the operator's",
        "the maker of the probe; LinuxCNC 2.9, G-codes, G38.n: no feed of its own"},
    ControlOptionRow{"probe_way_mm_min", "", 1, 10000, false,
                     "F of the probe's way down to the start of a touch and back", "the maker of the probe"},
    ControlOptionRow{"probe_overtravel_mm", "", 0.1, 20, false,
                     "how far beyond the expected wall the move of a touch may go; less than the stylus may "
                     "be pushed aside",
                     "the maker of the probe"},
    ControlOptionRow{
        "subprograms", "", 1, kLastOwnProgram, true,
        "O of the first subprogram of the file, which M98 P calls at each of three or more equal holes of "
        "explicit moves; not stated: none. Programs of that number and above in the control's memory are "
        "overwritten; those of 8000 and up can be locked, and O9000 and up are the machine builder's, of "
        "which "
        "M codes call O9001 to O9009",
        "0i 13.3 (M98, M99), 12.1"},
    ControlOptionRow{"tool_call", "number name", 0, 0, false,
                     "a tool is called by its number, T5, or by its id, T=\"em10\": as the control's list of "
                     "tools names it",
                     "Siemens, tool change"},
    ControlOptionRow{"smoothing", "cycle832 g642 g641", 0, 0, false,
                     "how corners are rounded by the step's path tolerance: CYCLE832, G642 with CTOL, or "
                     "G641 with ADIS of the same size, within which the corner stays",
                     "Siemens, CYCLE832; G642, G641"},
    ControlOptionRow{
        "turns", "yes no", 0, 0, false,
        "a helix of more than one turn as one block with TURN=, or as arcs of at most half a turn",
        "Siemens, helical interpolation"},
    ControlOptionRow{
        "plane_reset", "no yes", 0, 0, false,
        "PLANE RESET STAY and M129 at the program's head, for machines that tilt the working plane",
        "Heidenhain, PLANE and M128; default, unsourced: an option of the control"},
    ControlOptionRow{
        "pecking_cycle", "explicit tnc430 itnc530 tnc640", 0, 0, false,
        "which parameters the control's cycle 205 has, which clears holes between pecks: those of TNC 426 "
        "and "
        "430; with Q379 and Q253 of iTNC 530; with Q208 and Q395 of TNC 640, too; not stated: explicit moves",
        "Heidenhain, cycle 205 in the manuals of each; tests/controls/heidenhain/golden/README.md"},
    ControlOptionRow{"oriented_stop", "no yes", 0, 0, false,
                     "the spindle can be stopped turned to an angle: CYCLE86 and CYCL DEF 202 bore with a "
                     "bar that comes out "
                     "stopped, straight up as planned; else that is explicit moves with M5",
                     "Siemens, CYCLE86; Heidenhain, cycle 202: both want a machine that is prepared for it"},
    ControlOptionRow{"tool_change", "m6 m0", 0, 0, false,
                     "M6 is carried out by what sends the program (Grbl itself refuses it), or tools are "
                     "changed at a stop, M0, in which Grbl refuses to jog: with tool_length: g43.1 alone",
                     "gnea/grbl, README.md (no M6), doc/markdown/jogging.md; senders"},
    ControlOptionRow{"tool_length", "touch_off g43.1", 0, 0, false,
                     "the zero of Z is set anew with each tool at its change, and in each set-up, or G43.1 Z "
                     "states the tool's "
                     "length, which is measured, as a number",
                     "gnea/grbl, README.md (G43.1, no G43 H)"},
    ControlOptionRow{"mist", "no yes", 0, 0, false, "M7 is compiled in", "gnea/grbl, config.h (ENABLE_M7)"},
};

/// The value of that option in such a list; "-": it is not in it.
[[nodiscard]] constexpr std::string_view value_in(std::string_view options, std::string_view name) {
  for (std::size_t at = 0; at < options.size();) {
    const std::size_t end =
        options.find(' ', at) == std::string_view::npos ? options.size() : options.find(' ', at);
    const std::string_view one = options.substr(at, end - at);
    if (one.size() > name.size() && one[name.size()] == '=' && one.substr(0, name.size()) == name)
      return one.substr(name.size() + 1);
    at = end + 1;
  }
  return "-";
}

/// The option's value for that control where nothing is stated; "-": the control has no such option.
[[nodiscard]] constexpr std::string_view default_of(const ControlOptionRow& row, std::string_view dialect) {
  const ControlRow* control = find_control_row(dialect);
  return control != nullptr ? value_in(control->options, row.name) : "-";
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

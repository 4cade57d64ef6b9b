#pragma once

#include <array>
#include <string_view>

#include "planner/ground/vocabulary/control_options.h"

namespace capstan::model {

/// A macro for one touch that a machine's file may name by id (option `probe_macro`, which says what its
/// places mean and what any macro must do). How a maker's macros and cycles are called on one machine, only
/// that machine tells: none is written before the shop says that it has tried it (`probe_macro_confirmed`).
struct ProbeMacroRow {
  std::string_view id;
  std::string_view dialects;  ///< with blanks between
  std::string_view blocks;    ///< with | between, as `probe_macro` has them
  std::string_view meaning, source;
  double beyond_mm;        ///< how far beyond the expected wall it goes where there is none, at most
  std::string_view first;  ///< what is measured or looked up at the machine before it is confirmed
};

/// Z of each is the height of the ball's centre: where the machine's length of the probe is to the lowest
/// place of its ball, it touches a radius of the ball higher, and never lower than the way that is proven.
inline constexpr std::array kProbeMacros{
    ProbeMacroRow{
        "renishaw_9811", "fanuc haas",
        "T{probe} M6 | G90 G0 X{x} Y{y} | G43 H{probe} Z{security} | G65 P9832 | G65 P9810 Z{z} F3000. | "
        "G65 P9811 {axis}{nominal} | G65 P9810 Z{security} F3000. | G65 P9833",
        "Renishaw Inspection Plus: probe on, protected move down, one surface, up, probe off; without S and "
        "T no offset is set; the result is in the macro variables #135 to #138",
        "Renishaw Inspection Plus, programming manuals H-2500-0071 (Fanuc) and H-2000-6222 (Haas): macros "
        "and their order as programs of others have them, the rest remembered",
        10.0,
        "the probe is calibrated (P9801 to P9804), and H of the probe is its length; P9832 and P9833 "
        "exist; the overtravel of P9811 (Q) stays within what the stylus bears"},
    ProbeMacroRow{
        "siemens_cycle978", "siemens",
        "T{probe} | M6 | G90 G0 X{x} Y{y} | G0 Z{security} D1 | G1 Z{z} F2000 | "
        "CYCLE978(0,,,1,{nominal},5,5,{axis_number},{way},1,\"\",,0,1.01,1.01,-1.01,,,,,1,1) | "
        "G0 Z{security}",
        "CYCLE978: one surface along an axis, measured only (S_KNUM empty), to 5 mm beyond it (S_FA), not "
        "taken where it is more than 5 mm off (S_TSA), with probe 1; the result is in _OVR[ ]",
        "SINUMERIK 840D sl / 828D, Measuring cycles, from 4.4 on (6FC5398-4BP40): list of parameters as a "
        "program of others for SINUMERIK Operate has it, its meaning in part remembered",
        5.0,
        "the version of the measuring cycles: before 4.4 they take global variables in place of this list; "
        "probe 1 is calibrated; which way the control has the probe stand"},
    ProbeMacroRow{
        "tch_probe_0", "heidenhain",
        "TOOL CALL {probe} Z | L X{x} Y{y} R0 FMAX | L Z{security} R0 FMAX | L Z{z} R0 F2000 | TCH PROBE 0.0 "
        "REF. PLANE Q5 {axis}{sign} | TCH PROBE 0.1 X{x} Y{y} Z{z} | L Z{security} R0 FMAX",
        "touch probe cycle 0: from where the probe stands along an axis until it touches, and back; where it "
        "touched is in Q5 and Q115 to Q119",
        "Heidenhain, Touch Probe Cycles (iTNC 530, TNC 640), cycle 0: remembered", 10.0,
        "the probe is calibrated, and its row of the table says whether lengths are to the ball's centre; "
        "the longest way of a touch (MP6130, DIST) stays within what the stylus bears"},
};

/// The row of that id which this control has; null: there is none.
[[nodiscard]] constexpr const ProbeMacroRow* find_probe_macro(std::string_view dialect, std::string_view id) {
  for (const ProbeMacroRow& row : kProbeMacros) {
    if (row.id == id && has_word(row.dialects, dialect)) return &row;
  }
  return nullptr;
}

}  // namespace capstan::model

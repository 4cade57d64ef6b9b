#include <array>
#include <cmath>
#include <string>

#include "planner/controls/fanuc/fanuc.h"
#include "planner/controls/gcode/moves/hole_cycles.h"
#include "planner/controls/gcode/moves/patterns.h"
#include "planner/controls/gcode/options.h"
#include "planner/ground/base/number.h"
#include "planner/ground/vocabulary/control_options.h"
#include "planner/model/plan/resources/control_options.h"

// What the machine's options make of the words of its programs.

namespace capstan::controls::fanuc {
namespace {

using gcode::HoleCycle;
using model::control_number;
using model::control_option;

constexpr int kPitchDecimals = 4;  // FANUC B-63833EN-1/02, 9: F in G95 counts 0.0001 mm/rev
constexpr double kClosureMm =
    0.002;  // of arcs; the least that B-63844EN/02, 4.4, is met with (parameter 3410)

std::string with_point(double value, int decimals) {
  const std::string text = trimmed(value, decimals);
  return text.find('.') == std::string::npos ? text + "." : text;
}

/// P of G4 and of cycles.
std::string dwell_word(double seconds, bool in_seconds) {
  return in_seconds ? "P" + with_point(seconds, 3) : "P" + trimmed(1000.0 * seconds, 0);
}

std::string place_words(const HoleCycle& h) {
  return " X" + with_point(h.at.x, h.decimals) + " Y" + with_point(h.at.y, h.decimals) + " Z" +
         with_point(h.bottom_z, h.decimals) + " R" + with_point(h.r_z, h.decimals);
}

/// How the machine pecks, mm; 0: its file does not say.
struct Pecking {
  double clearance = 0.0;  ///< G83 is fed again so far above the last bottom
  double retract = 0.0;    ///< G73 comes up by it
  bool shrinking = false;  ///< I, J and K: a first peck, by how much each is less, the least
};

/// The code of a cycle and, behind the place's words, those of its pecks; no code where none makes these
/// moves.
struct CycleCode {
  std::string code = {}, words = {};
};
CycleCode cycle_code(const HoleCycle& h, bool waits, const Pecking& p) {
  if (h.stops) return {waits ? "" : "G86"};
  if (!h.pecks) return {h.feeds_out ? (waits ? "G89" : "G85") : (waits ? "G82" : "G81")};
  const double half = 0.5 * std::pow(10.0, -h.decimals);
  const bool clears = h.pecks->clears;
  // Where G83 is fed again is the machine's: it is known and above the bottom. A broken chip is as planned.
  const bool back = clears ? p.clearance > half : std::abs(p.retract - h.pecks->back_mm) < half;
  const auto sizes = gcode::peck_sizes(h);
  if (!back || !sizes || h.feeds_out || h.pecks->dwell_s > 0.0 || (waits && !p.shrinking)) return {};
  const auto n = [&](double v) { return with_point(v, h.decimals); };
  const std::string code = clears ? "G83" : "G73";
  if (gcode::are_pecks(h, sizes->first_mm, sizes->first_mm)) return {code, " Q" + n(sizes->first_mm)};
  if (!p.shrinking || sizes->step_mm > sizes->first_mm) return {};
  return {code,
          " I" + n(sizes->first_mm) + " J" + n(sizes->first_mm - sizes->step_mm) + " K" + n(sizes->step_mm)};
}

/// Modal: at each further place of a block with X or Y again, from the initial level (G98).
std::optional<gcode::CycleText> hole_text(const HoleCycle& h, std::span<const geometry::Vec2> places,
                                          bool in_seconds, const Pecking& pecking) {
  const bool waits = rounded(h.dwell_s, 3) > 0.0;
  const auto [code, pecks] = cycle_code(h, waits, pecking);
  if (code.empty()) return std::nullopt;
  return gcode::CycleText{
      "G98 " + code + place_words(h) + pecks + (waits ? " " + dwell_word(h.dwell_s, in_seconds) : "") + " F" +
      with_point(h.feed_mm_min, h.feed_decimals) + gcode::place_blocks(places, h.decimals, {}, &with_point) +
      "\nG80" + (h.stops ? "\nM5" : "")};
}

struct Tapping {
  bool m29, per_revolution;
  double retract;  ///< J; 0: none
};

std::string tap_text(const HoleCycle& h, const Tapping& t) {
  const double rpm = rounded(std::abs(h.rpm), 0);
  std::string out;
  if (t.per_revolution) out += "G95\n";
  if (t.m29) out += "M29 S" + trimmed(rpm, 0) + "\n";
  out += std::string("G98 ") + (h.rpm < 0.0 ? "G74" : "G84") + place_words(h) + " F" +
         with_point(t.per_revolution ? h.pitch_mm : h.pitch_mm * rpm, kPitchDecimals);
  if (t.retract > 0.0) out += " J" + trimmed(t.retract, 0);
  return out + (t.per_revolution ? "\nG80\nG94" : "\nG80");
}

std::string program_number(double number) {
  const std::string digits = trimmed(number, 0);
  return "O" + std::string(4 - std::min<std::size_t>(4, digits.size()), '0') + digits;
}

}  // namespace

gcode::Words words_of(const model::Machine& machine) {
  const auto is = [&](std::string_view name, std::string_view value) {
    return control_option(machine, name) == value;
  };
  const bool capitals = is("comments", "upper"), in_seconds = is("dwell", "seconds");
  const bool smooth = is("smoothness", "yes"), by_reference = is("retract", "g28");
  const Tapping tapping{is("tap", "m29"), is("tap_feed", "per_revolution"),
                        control_number(machine, "tap_retract", 0.0)};
  const bool haas = machine.control.dialect == "haas";
  const double clearance = control_number(machine, "peck_clearance_mm", 0.0);
  const Pecking pecking{clearance, haas ? clearance : control_number(machine, "chip_break_mm", 0.0), haas};
  gcode::Words w;
  w.longest_line = static_cast<std::size_t>(control_number(machine, "line_length", 200.0));
  w.speed_decimals = 0;
  w.dwell_decimals = 3;
  w.first = "%\n" + program_number(control_number(machine, "program_number", 1.0));
  w.last = "M30";
  w.behind = "%";
  // The unit stands in a block of its own (B-63844EN/02, 8.3). A length offset that is on moves Z where G49
  // stands alone (14.1): the retract takes it away.
  w.first_state = w.step_state = "G21\nG17 G40 G80 G90 G94 G98";
  w.comment = [capitals](std::string_view text) { return comment_text(text, capitals); };
  w.block_numbers = gcode::block_numbers_of(machine);
  if (is("next_tool", "staged"))
    w.stage_tool = [](const std::string& next, const std::string& /*id*/) { return "T" + next; };
  w.tool_end = gcode::tool_end_of(machine);
  w.offset_moves_z = true;
  w.number = &with_point;
  w.speed = [](double rpm) { return trimmed(rpm, 0); };
  w.path_mode = [smooth](const std::string& tolerance, bool finishes) {
    if (tolerance.empty()) return std::string("G61");
    return smooth ? std::string("G64\nG187 P") + (finishes ? "3" : "2") + " E" + tolerance
                  : std::string("G64");
  };
  w.retract = [by_reference](const std::string& z) {
    return by_reference ? std::string("G91 G28 Z0.\nG90 G49") : "G0 G49 G53 Z" + z;
  };
  w.message = [capitals](const std::string& text) { return "(" + comment_text(text, capitals) + ")"; };
  w.dwell = [in_seconds](const std::string& seconds) {
    return "G4 " + dwell_word(parse_double(seconds).value_or(0.0), in_seconds);
  };
  w.tap = [tapping](const HoleCycle& h) { return tap_text(h, tapping); };
  w.tap_stops_spindle = true;
  w.by_cycles = !is("cycles", "explicit");
  w.cycle = [in_seconds, pecking](const HoleCycle& h, std::span<const geometry::Vec2> places) {
    return hole_text(h, places, in_seconds, pecking);
  };
  if (is("ai_contour", "yes")) {
    w.smooth_on = "G5.1 Q1";
    w.smooth_off = "G5.1 Q0";
  }
  w.more_centre_decimals = 0;
  w.closure_mm = kClosureMm;
  w.quadrants = is("arcs", "quadrant");
  w.largest_radius_mm = control_number(machine, "largest_radius_mm", 0.0);
  w.helices = is("helices", "yes");
  w.codes = std::string(control_option(machine, "codes"));
  w.first_subprogram = static_cast<int>(control_number(machine, "subprograms", 0.0));
  // The numbers of their blocks would be those of the program again.
  if (w.first_subprogram > 0 && w.block_numbers != gcode::BlockNumbers::kAll) {
    w.last_subprogram = model::kLastOwnProgram;
    w.call = [](int number) { return "M98 P" + std::to_string(number); };
    w.subprogram = [](int number, const std::string& lines) {
      return program_number(number) + "\n" + lines + "M99";
    };
  }
  return w;
}

}  // namespace capstan::controls::fanuc

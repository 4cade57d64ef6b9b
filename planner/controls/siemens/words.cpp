#include <algorithm>
#include <cmath>
#include <string>

#include "planner/controls/gcode/moves/hole_cycles.h"
#include "planner/controls/gcode/moves/patterns.h"
#include "planner/controls/gcode/options.h"
#include "planner/controls/siemens/siemens.h"
#include "planner/ground/base/number.h"
#include "planner/model/plan/resources/control_options.h"

// What the machine's options make of the words of its programs.

namespace capstan::controls::siemens {
namespace {

using gcode::HoleCycle;

/// RFP lies so far below where the tool is fed from, for cycles refuse a return plane at the reference plane.
constexpr double kClearanceMm = 1.0;
constexpr int kPitchDecimals = 4;
/// Of MSG(): default, unsourced here.
constexpr std::size_t kLongestMessage = 124;
/// Of I and J: the control computes with all digits, and takes radii that differ by 0.01 mm (its circle end
/// point tolerance, default of the machine data).
constexpr int kMoreCentreDecimals = 2;

/// RTP, RFP, SDIS, DP and an empty DPR.
std::string planes(const HoleCycle& h) {
  const double clearance = rounded(std::min(kClearanceMm, 0.5 * (h.r_z - h.bottom_z)), h.decimals);
  const auto n = [&](double v) { return trimmed(v, h.decimals); };
  return n(h.initial_z) + "," + n(h.r_z - clearance) + "," + n(clearance) + "," + n(h.bottom_z) + ",";
}

using Places = std::span<const geometry::Vec2>;

/// The call, the places, and the end of the call. Three holes and more on a line or a circle are HOLES1 or
/// HOLES2: the tool is over the first, so that HOLES1, which begins at the nearer end, begins there.
gcode::CycleText called(const HoleCycle& h, const std::string& call, Places places) {
  const auto n = [](double v) { return trimmed(v, gcode::kPatternDecimals); };
  const std::string begin = "MCALL " + call + "\n", number = std::to_string(places.size()) + ")\nMCALL";
  if (const auto row = gcode::row_of(places, h.decimals))
    return {begin + "HOLES1(" + n(row->first.x) + "," + n(row->first.y) + "," + n(row->angle_deg) + ",0," +
                n(row->step_mm) + "," + number,
            true};
  if (const auto ring = gcode::ring_of(places, h.decimals))
    return {begin + "HOLES2(" + n(ring->centre.x) + "," + n(ring->centre.y) + "," + n(ring->radius_mm) + "," +
                n(ring->first_deg) + "," + n(ring->step_deg) + "," + number,
            true};
  return {begin + "G0 X" + trimmed(h.at.x, h.decimals) + " Y" + trimmed(h.at.y, h.decimals) +
              gcode::place_blocks(places, h.decimals, "G0", &trimmed) + "\nMCALL",
          false};
}

gcode::CycleText hole_text(const HoleCycle& h, Places places) {
  const std::string feed = trimmed(h.feed_mm_min, h.feed_decimals), dwell = trimmed(h.dwell_s, 3);
  if (h.feeds_out)
    return called(h, "CYCLE85(" + planes(h) + "," + dwell + "," + feed + "," + feed + ")", places);
  gcode::CycleText out = rounded(h.dwell_s, 3) > 0.0
                             ? called(h, "CYCLE82(" + planes(h) + "," + dwell + ")", places)
                             : called(h, "CYCLE81(" + planes(h) + ")", places);
  out.text.insert(0, "F" + feed + "\n");
  return out;
}

/// CYCLE83: equal pecks (DAM 0), each as the first, which ends at FDEP and counts from RFP. Nothing where the
/// last one is less than they, for how the control divides the last two is not looked up; nor where the pecks
/// wait and the bottom does not. VARI 1 clears the hole, _DIS1 says where it is fed again; VARI 0 comes up by
/// _VRT.
std::optional<gcode::CycleText> pecked_text(const HoleCycle& h, Places places) {
  const auto sizes = gcode::peck_sizes(h);
  if (!sizes || h.feeds_out) return std::nullopt;
  const auto n = [&](double v) { return trimmed(v, h.decimals); };
  const double first_z = h.pecks->bottoms_z.front(), reference = first_z + sizes->step_mm;
  const double clearance = rounded(h.r_z - reference, h.decimals);
  const double last = h.pecks->bottoms_z.back() - h.bottom_z;
  const double half = 0.5 * std::pow(10.0, -h.decimals);
  const double waits = rounded(h.pecks->dwell_s, 3), waits_below = rounded(h.dwell_s, 3);
  if (clearance < 0.0 || reference > h.initial_z - half || std::abs(last - sizes->step_mm) > half ||
      (waits > 0.0 && waits_below == 0.0))
    return std::nullopt;
  const std::string back = n(h.pecks->back_mm), dwell = trimmed(waits, 3);
  const std::string call = "CYCLE83(" + n(h.initial_z) + "," + n(reference) + "," + n(clearance) + "," +
                           n(h.bottom_z) + ",," + n(first_z) + ",,0," + dwell + ",0,1," +
                           (h.pecks->clears ? "1" : "0") + ",,," + (h.pecks->clears ? "" : back) + "," +
                           trimmed(waits_below, 3) + (h.pecks->clears ? "," + back : "") + ")";
  gcode::CycleText out = called(h, call, places);
  out.text.insert(0, "F" + trimmed(h.feed_mm_min, h.feed_decimals) + "\n");
  return out;
}

/// CYCLE86: the spindle stands turned to POSS 0 while the bar comes out, which RPA, RPO and RPAP 0 do not
/// move off the wall.
gcode::CycleText bored_text(const HoleCycle& h, Places places) {
  gcode::CycleText out = called(
      h, "CYCLE86(" + planes(h) + "," + trimmed(h.dwell_s, 3) + "," + (h.rpm < 0.0 ? "4" : "3") + ",0,0,0,0)",
      places);
  out.text.insert(0, "F" + trimmed(h.feed_mm_min, h.feed_decimals) + "\n");
  return out;
}

/// SDAC 5: the spindle stands behind it; PIT below 0 for left-hand threads; POSS 0; SST and SST1 alike.
std::string tap_text(const HoleCycle& h) {
  const std::string rpm = trimmed(rounded(std::abs(h.rpm), 0), 0);
  const double pitch = h.rpm < 0.0 ? -h.pitch_mm : h.pitch_mm;
  return called(h,
                "CYCLE84(" + planes(h) + ",0,5,," + trimmed(pitch, kPitchDecimals) + ",0," + rpm + "," + rpm +
                    ")",
                {&h.at, 1})
      .text;
}

/// CYCLE840, for a tap in a compensating chuck: SDR the other way back, SDAC as before, ENC 0 by the encoder,
/// PIT without sign, for the spindle turns as the thread does. The feed says the same, for a spindle without
/// one.
std::string chuck_text(const HoleCycle& h) {
  const bool left = h.rpm < 0.0;
  const std::string feed = trimmed(h.pitch_mm * rounded(std::abs(h.rpm), 0), h.feed_decimals);
  return "F" + feed + "\n" +
         called(h,
                "CYCLE840(" + planes(h) + ",0," + (left ? "3,4" : "4,3") + ",0,," +
                    trimmed(h.pitch_mm, kPitchDecimals) + ")",
                {&h.at, 1})
             .text;
}

std::string path_mode(std::string_view smoothing, const std::string& tolerance, bool finishes) {
  if (smoothing == "g642") return tolerance.empty() ? "G60" : "G642 CTOL=" + tolerance;
  if (smoothing == "g641")
    return tolerance.empty() ? "G60" : "G641 ADIS=" + tolerance + " ADISPOS=" + tolerance;
  if (tolerance.empty()) return "CYCLE832(0,0,1)\nG60";
  return "CYCLE832(" + tolerance + "," + (finishes ? "1" : "3") + ",1)";
}

std::string without_quotes(std::string text) {
  std::replace(text.begin(), text.end(), '"', '\'');
  return text;
}

}  // namespace

bool is_tool_name(std::string_view name) {
  return !name.empty() && name.size() <= kLongestToolName &&
         std::all_of(name.begin(), name.end(),
                     [](char c) { return c > ' ' && c <= '~' && c != '"' && c != ';'; });
}

gcode::Words words_of(const model::Machine& machine) {
  const auto is = [&](std::string_view name, std::string_view value) {
    return model::control_option(machine, name) == value;
  };
  const bool by_name = is("tool_call", "name");
  const std::string smoothing(model::control_option(machine, "smoothing"));
  const auto tool = [by_name](const std::string& number, const std::string& id) {
    return by_name ? "T=\"" + id + "\"" : "T" + number;
  };
  gcode::Words w;
  w.longest_line = static_cast<std::size_t>(model::control_number(machine, "line_length", 200.0));
  w.longest_message = kLongestMessage;
  w.speed_decimals = 0;
  w.dwell_decimals = 3;
  w.last = smoothing == "cycle832" ? "CYCLE832(0,0,1)\nM30" : "M30";
  w.comment_begin = ";";
  w.comment_end = "";
  w.first_state = w.step_state = "G17 G40 G90 G94 G710\nMCALL";
  w.block_numbers = gcode::block_numbers_of(machine);
  w.change_tool = [tool](const std::string& number, const std::string& id, const std::string& /*speed*/) {
    return tool(number, id) + " M6";
  };
  if (is("next_tool", "staged")) w.stage_tool = tool;
  w.tool_end = gcode::tool_end_of(machine);
  w.length_offset = [](const std::string& /*tool*/) { return std::string("D1"); };
  w.offset_moves_z = true;
  w.number = &trimmed;
  w.path_mode = [smoothing](const std::string& tolerance, bool finishes) {
    return path_mode(smoothing, tolerance, finishes);
  };
  w.retract = [](const std::string& z) { return "G0 SUPA Z" + z + " D0"; };
  w.message = [](const std::string& text) { return "MSG(\"" + without_quotes(text) + "\")"; };
  w.message_end = "MSG()";
  w.speed_in_move = true;
  w.dwell = [](const std::string& seconds) { return "G4 F" + seconds; };
  w.tap = [](const HoleCycle& h) { return h.in_chuck ? chuck_text(h) : tap_text(h); };
  w.tap_stops_spindle = true;
  w.by_cycles = !is("cycles", "explicit");
  w.cycle = [oriented = is("oriented_stop", "yes")](const HoleCycle& h, Places places) {
    if (h.stops) return oriented ? std::optional(bored_text(h, places)) : std::nullopt;
    return h.pecks ? pecked_text(h, places) : std::optional(hole_text(h, places));
  };
  w.more_centre_decimals = kMoreCentreDecimals;
  w.turns = is("turns", "yes");
  return w;
}

}  // namespace capstan::controls::siemens

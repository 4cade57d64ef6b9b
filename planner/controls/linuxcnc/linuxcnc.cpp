#include "planner/controls/linuxcnc/linuxcnc.h"

#include <array>
#include <cmath>
#include <optional>
#include <string>
#include <string_view>

#include "planner/controls/gcode/moves/hole_cycles.h"
#include "planner/controls/gcode/moves/patterns.h"
#include "planner/controls/gcode/writer.h"
#include "planner/ground/base/number.h"
#include "planner/model/plan/resources/control_options.h"

namespace capstan::controls::linuxcnc {
namespace {

// RS274/NGC 3.5.13.
constexpr std::array<std::string_view, 9> kWorkOffsets = {"G54", "G55",   "G56",   "G57",  "G58",
                                                          "G59", "G59.1", "G59.2", "G59.3"};

constexpr int kPitchDecimals = 6, kDwellDecimals = 3;

/// G73 backs off and G83 stops short of the last bottom by it: G83_RAPID_DELTA, 0.010 inch, in mm.
/// Source: LinuxCNC 2.9, interp_cycles.cc, convert_cycle_g73 and convert_cycle_g83.
constexpr double kPeckDeltaMm = 0.254;

/// The code, with the word of its pecks; empty where no cycle makes these moves. G83 is fed again a little
/// above the last bottom, wherever the path is; G73 comes up as far as the path, and both peck from R.
std::string cycle_code(const gcode::HoleCycle& h, bool waits) {
  if (h.stops) return "G86";
  if (!h.pecks) return h.feeds_out ? (waits ? "G89" : "G85") : (waits ? "G82" : "G81");
  const auto sizes = gcode::peck_sizes(h);
  const bool back =
      h.pecks->clears || std::abs(h.pecks->back_mm - kPeckDeltaMm) < 0.5 * std::pow(10.0, -h.decimals);
  if (!sizes || !back || waits || h.feeds_out || h.pecks->dwell_s > 0.0 ||
      !gcode::are_pecks(h, sizes->first_mm, sizes->first_mm))
    return "";
  return std::string(h.pecks->clears ? "G83" : "G73") + " Q" + trimmed(sizes->first_mm, h.decimals);
}

/// A hole as G81 (out by rapid) or G85 (out at feed to R, from there by rapid), with a dwell as G82 or G89;
/// with the spindle stopped at the bottom as G86, which has its P always. The tool is over the first, so that
/// G98 brings it back to where it is; a block with X or Y again is a further hole.
/// Source: LinuxCNC 2.9, G-codes.
std::optional<gcode::CycleText> hole_text(const gcode::HoleCycle& h, std::span<const geometry::Vec2> places) {
  const bool waits = rounded(h.dwell_s, kDwellDecimals) > 0.0;
  const std::string code = cycle_code(h, waits);
  if (code.empty()) return std::nullopt;
  return gcode::CycleText{
      "G98 " + code + " X" + trimmed(h.at.x, h.decimals) + " Y" + trimmed(h.at.y, h.decimals) + " Z" +
      trimmed(h.bottom_z, h.decimals) + " R" + trimmed(h.r_z, h.decimals) +
      (waits || h.stops ? " P" + trimmed(h.dwell_s, kDwellDecimals) : "") + " F" +
      trimmed(h.feed_mm_min, h.feed_decimals) + gcode::place_blocks(places, h.decimals, {}, &trimmed) +
      "\nG80" + (h.stops ? "\nM5" : "")};
}

gcode::Words words(const model::Machine& machine) {
  gcode::Words out = {
      .work_offsets = kWorkOffsets,
      .longest_line = 252,  // LINELEN is 255; longer ones are refused ("Command too long")
      .speed_decimals = 1,
      .dwell_decimals = kDwellDecimals,
      .first = "",
      .last = "M2",
      .number = &trimmed,
      .path_mode = [](const std::string& p,
                      bool /*finishes*/) { return p.empty() ? std::string("G61") : "G64 P" + p; },
      .retract = [](const std::string& z) { return "G53 G0 Z" + z; },
      .message = [](const std::string& text) { return "(MSG, " + text + ")"; },
      .dwell = [](const std::string& seconds) { return "G4 P" + seconds; },
      .tap =
          [](const gcode::HoleCycle& h) {
            return "G33.1 Z" + trimmed(h.bottom_z, h.decimals) + " K" + trimmed(h.pitch_mm, kPitchDecimals);
          },
  };
  out.by_cycles = model::control_option(machine, "cycles") != "explicit";
  out.cycle = &hole_text;
  // Stops at the touch, and with an error where there is none; #5061 to #5063 are where, in the work offset.
  // A DEBUG comment shows them. Source: LinuxCNC 2.9, G-codes, G38.n; O-codes and comments, DEBUG.
  out.probe = "G38.2";
  out.probe_state = "G61";
  out.probed = [](const std::string& name, const std::string& expected) {
    return "(DEBUG, " + name + ": touched at X#5061 Y#5062 Z#5063, expected at " + expected + ")";
  };
  return out;
}

Result<std::string> write_program(const model::Plan& plan, Job& job,
                                  const std::vector<model::Condemnation>& condemned) {
  return gcode::write(plan, words(plan.machine), condemned, job);
}

}  // namespace

constinit const Dialect kDialect{
    .id = "linuxcnc",
    .name = "LinuxCNC",
    .program = {"linuxcnc", ".ngc", "text/x-gcode"},
    .tool_table = {"linuxcnc_tools", ".tbl", "text/plain"},
    .work_offsets = kWorkOffsets,
    // Source: LinuxCNC 2.9, its manual: G2, G3, G33.1, G64 P; tool table, T 0 to 99999; [TRAJ]
    // ARC_BLEND_OPTIMIZATION_DEPTH, 50 by default.
    .conformance = {.largest_tool_number = 99999, .look_ahead_moves = 50},
    .write_program = &write_program,
    .write_tool_table = &write_tool_table,
};

}  // namespace capstan::controls::linuxcnc

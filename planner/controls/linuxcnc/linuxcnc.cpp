#include "planner/controls/linuxcnc/linuxcnc.h"

#include <array>
#include <optional>
#include <string>
#include <string_view>

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

/// A hole as G81 (out by rapid) or G85 (out at feed to R, from there by rapid), with a dwell as G82 or G89.
/// The tool is over the first, so that G98 brings it back to where it is; a block with X or Y again is a
/// further hole. Source: LinuxCNC 2.9, G-codes.
std::string hole_text(const gcode::HoleCycle& h, std::span<const geometry::Vec2> places) {
  const bool waits = rounded(h.dwell_s, kDwellDecimals) > 0.0;
  const char* code = h.feeds_out ? (waits ? "G89" : "G85") : (waits ? "G82" : "G81");
  return "G98 " + std::string(code) + " X" + trimmed(h.at.x, h.decimals) + " Y" +
         trimmed(h.at.y, h.decimals) + " Z" + trimmed(h.bottom_z, h.decimals) + " R" +
         trimmed(h.r_z, h.decimals) + (waits ? " P" + trimmed(h.dwell_s, kDwellDecimals) : "") + " F" +
         trimmed(h.feed_mm_min, h.feed_decimals) + gcode::place_blocks(places, h.decimals, {}, &trimmed) +
         "\nG80";
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
  out.by_cycles = model::control_option(machine, "cycles") == "feature";
  out.cycle = [](const gcode::HoleCycle& h, std::span<const geometry::Vec2> places) {
    return std::optional(gcode::CycleText{hole_text(h, places)});
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

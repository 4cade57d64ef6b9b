#include "planner/controls/mach3/mach3.h"

#include <array>
#include <optional>
#include <string>
#include <string_view>

#include "planner/controls/gcode/moves/patterns.h"
#include "planner/controls/gcode/options.h"
#include "planner/controls/gcode/writer.h"
#include "planner/ground/base/number.h"
#include "planner/model/plan/resources/control_options.h"

namespace capstan::controls::mach3 {
namespace {

/// Those that have a code of their own; G59 P names more.
constexpr std::array<std::string_view, 6> kWorkOffsets = {"G54", "G55", "G56", "G57", "G58", "G59"};
constexpr int kDwellDecimals = 3;

std::string p_word(double seconds, bool milliseconds) {
  return "P" + (milliseconds ? trimmed(1000.0 * seconds, 0) : trimmed(seconds, kDwellDecimals));
}

/// G86 has its P always, as NIST's interpreter wants it.
std::optional<gcode::CycleText> hole_text(const gcode::HoleCycle& h, std::span<const geometry::Vec2> places,
                                          bool milliseconds) {
  if (h.pecks) return std::nullopt;
  const bool waits = rounded(h.dwell_s, kDwellDecimals) > 0.0;
  const char* code = h.stops ? "G86" : h.feeds_out ? (waits ? "G89" : "G85") : (waits ? "G82" : "G81");
  const auto n = [&](double v) { return trimmed(v, h.decimals); };
  return gcode::CycleText{
      "G98 " + std::string(code) + " X" + n(h.at.x) + " Y" + n(h.at.y) + " Z" + n(h.bottom_z) + " R" +
      n(h.r_z) + (waits || h.stops ? " " + p_word(h.dwell_s, milliseconds) : "") + " F" +
      trimmed(h.feed_mm_min, h.feed_decimals) + gcode::place_blocks(places, h.decimals, {}, &trimmed) +
      "\nG80" + (h.stops ? "\nM5" : "")};
}

Result<std::string> write_program(const model::Plan& plan, Job& job,
                                  const std::vector<model::Condemnation>& condemned) {
  if (auto ok = gcode::options_right(plan); !ok) return tl::unexpected(ok.error());
  return gcode::write(plan, words_of(plan.machine), condemned, job);
}

}  // namespace

gcode::Words words_of(const model::Machine& machine) {
  const auto is = [&](std::string_view name, std::string_view value) {
    return model::control_option(machine, name) == value;
  };
  const bool milliseconds = is("dwell", "milliseconds");
  gcode::Words w;
  w.work_offsets = kWorkOffsets;
  w.longest_line = static_cast<std::size_t>(model::control_number(machine, "line_length", 200.0));
  w.speed_decimals = 0;
  w.dwell_decimals = kDwellDecimals;
  w.last = "M30";
  w.first_state = "G21 G17 G90 G91.1 G94 G40 G49 G80";
  w.step_state = "G21 G17 G90 G91.1 G94 G40 G80";
  w.block_numbers = gcode::block_numbers_of(machine);
  w.number = &trimmed;
  w.path_mode = [](const std::string& tolerance, bool /*finishes*/) {
    return std::string(tolerance.empty() ? "G61" : "G64");
  };
  w.retract = [](const std::string& z) { return "G53 G0 Z" + z; };
  w.message = [](const std::string& text) { return "(MSG, " + text + ")"; };
  w.dwell = [milliseconds](const std::string& seconds) {
    return "G4 " + p_word(parse_double(seconds).value_or(0.0), milliseconds);
  };
  // Goes on without a word where there is no touch: #2000 to #2002 are where it ended, in the work offset.
  // Source: Using Mach3Mill, revision 1.84, G31, as others quote it.
  w.probe = "G31";
  w.probe_state = "G61";
  w.probed = [](const std::string& name, const std::string& expected) {
    return "(" + name + ": expected at " + expected + ", compare #2000 #2001 #2002; no touch is no error)";
  };
  w.by_cycles = !is("cycles", "explicit");
  w.cycle = [milliseconds](const gcode::HoleCycle& h, std::span<const geometry::Vec2> places) {
    return hole_text(h, places, milliseconds);
  };
  return w;
}

constinit const Dialect kDialect{
    .id = "mach3",
    .name = "Mach3",
    .program = {"mach3", ".tap", "text/x-gcode"},
    .tool_table = {},
    .work_offsets = kWorkOffsets,
    // G64 has no word for a tolerance; spindle and feed are not held in step. Tool numbers, the rows of its
    // tool table, and look-ahead, where nothing is set: defaults, unsourced.
    .conformance = {.rigid_tapping = false,
                    .path_tolerance = false,
                    .largest_tool_number = 254,
                    .look_ahead_moves = 20,
                    .work_offsets = kWorkOffsets.size()},
    .write_program = &write_program,
};

}  // namespace capstan::controls::mach3

#include <map>
#include <set>
#include <string>

#include "planner/controls/gcode/options.h"
#include "planner/controls/gcode/text.h"
#include "planner/controls/grbl/grbl.h"
#include "planner/ground/base/number.h"
#include "planner/model/plan/cutter/table_offsets.h"
#include "planner/model/plan/resources/control_options.h"

// What the plan and the machine's options make of the words of its programs.

namespace capstan::controls::grbl {
namespace {

/// Characters that Grbl takes out of its input as commands wherever they stand (serial.c): in markers as %21,
/// which reads back as the character, elsewhere by another one.
std::string comment_text(std::string_view text) {
  const bool marks = text.starts_with("CAPSTAN ");
  std::string out;
  for (const char c : text) {
    if (c == '!') {
      out += marks ? "%21" : ".";
    } else if (c == '?') {
      out += marks ? "%3F" : ".";
    } else if (c == '~') {
      out += marks ? "%7E" : "-";
    } else {
      out += c;
    }
  }
  return out;
}

std::size_t set_ups_of(const model::Plan& plan) {
  std::set<std::size_t> out;
  for (const model::StepResult& step : plan.steps) out.insert(step.setup);
  return out.size();
}

}  // namespace

gcode::Words words_of(const model::Plan& plan) {
  const model::Machine& machine = plan.machine;
  const auto is = [&](std::string_view name, std::string_view value) {
    return model::control_option(machine, name) == value;
  };
  const bool by_m6 = is("tool_change", "m6"), touches_off = is("tool_length", "touch_off");
  const int decimals = machine.control.decimals;
  const std::string to_top = "G53 G0 Z" + trimmed(machine.axes[2].travel_max_mm, decimals);
  std::map<std::string, std::string> lengths;  // by tool number
  for (const model::Cutter& c : plan.cutters)
    lengths[std::to_string(c.pocket)] = trimmed(model::length_offset_mm(c), decimals);
  gcode::Words w;
  w.longest_line = static_cast<std::size_t>(model::control_number(machine, "line_length", 0.0));
  w.speed_decimals = 0;
  w.dwell_decimals = 3;
  w.last = "M30";
  w.comment = &comment_text;
  w.block_numbers = gcode::block_numbers_of(machine);
  w.change_tool = [=](const std::string& tool, const std::string& id, const std::string& /*speed*/) {
    const std::string told = "(" +
                             comment_text("T" + tool + " " + gcode::plain_text(id) + ": change the tool" +
                                          (touches_off ? ", and set the zero of Z with it" : "")) +
                             ")\n";
    // The length of the tool before ends with it.
    return told + (touches_off ? "" : "G49\n") + (by_m6 ? "T" + tool + " M6\n" : "T" + tool + "\nM0\n") +
           to_top;
  };
  if (touches_off) {
    w.call_again = [=](const std::string& tool, const std::string& id, const std::string& offset) {
      return "(" +
             comment_text("T" + tool + " " + gcode::plain_text(id) + " stays: set the zero of Z of " +
                          offset + " with it") +
             ")\nT" + tool + " M6\n" + to_top;
    };
  }
  if (set_ups_of(plan) > 1) {
    w.first_state =
        "(between set-ups M0 is a hold in which Grbl refuses to jog: have what sends it keep M0 to "
        "itself)\n" +
        w.first_state;
  }
  w.length_offset = [=](const std::string& tool) {
    const auto at = lengths.find(tool);
    return touches_off || at == lengths.end() ? std::string() : "G43.1 Z" + at->second;
  };
  w.number = &trimmed;
  w.path_mode = [](const std::string& /*tolerance*/, bool /*finishes*/) { return std::string("G61"); };
  w.retract = [](const std::string& z) { return "G53 G0 Z" + z; };
  w.message = [](const std::string& text) { return "(" + comment_text(text) + ")"; };
  w.dwell = [](const std::string& seconds) { return "G4 P" + seconds; };
  // An alarm where there is no touch; where there is, [PRB:] goes to what sends the program, in coordinates
  // of the machine. A zero of Z that is set with each tool leaves the probe without a length. Source:
  // gnea/grbl, gcode.c (G38.2), report.c (report_probe_parameters).
  if (!touches_off) {
    w.probe = "G38.2";
    w.probed = [](const std::string& name, const std::string& expected) {
      return "(" + name + ": expected at " + expected +
             ", compare [PRB:] less the work offset and the length, in $#)";
    };
  }
  return w;
}

}  // namespace capstan::controls::grbl

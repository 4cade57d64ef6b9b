#include "planner/door/service/state/state_options.h"

#include <cmath>
#include <string>

#include "planner/door/service/state/machine_state.h"
#include "planner/ground/base/file.h"
#include "planner/ground/base/number.h"

namespace capstan::service {
namespace {

/// As much as a request of `capstan serve` may hold; a magazine's states are some thousand bytes.
constexpr std::size_t kMostStateBytes = std::size_t{1} << 20;

std::string set_power(Request& r, const std::string& text) {
  const auto kw = parse_double(text);
  if (!kw || !std::isfinite(*kw) || !(*kw > 0.0)) return "'" + text + "' is no power above 0 in kW, e.g. 5.5";
  r.state.spindle_power_kw = *kw;
  return {};
}

/// What is wrong with a text, in one sentence.
std::string fault_of(const Diagnostic& d) { return d.message + "; expected " + d.expected; }

std::string set_limits(Request& r, const std::string& text) {
  auto limits = parse_axis_limits(text);
  if (!limits) return fault_of(limits.error());
  r.state.axis_limits = *std::move(limits);
  return {};
}

std::string set_offsets(Request& r, const std::string& text) {
  auto offsets = parse_work_offsets(text);
  if (!offsets) return fault_of(offsets.error());
  r.state.work_offsets = *std::move(offsets);
  return {};
}

std::string set_tools(Request& r, const std::string& file) {
  const auto text = read_file(file, kMostStateBytes);
  if (!text) return "'" + file + "' cannot be read: " + text.error().message;
  auto states = late::parse_tool_states(*text, file);
  if (!states) return file + ":" + std::to_string(states.error().line) + ": " + fault_of(states.error());
  r.state.tools = *std::move(states);
  r.state.tools_told_at = 0;
  return {};
}

}  // namespace

std::vector<Option> state_options() {
  return {
      {.name = "tool-state",
       .value = Value::kText,
       .help = of_bind(
           "a file of what became of the loaded tools, a tool a line: T3 broken, or T5 wear 0.02 length-wear "
           "0.01 life-left 12.5 (mm, mm, minutes; in-table behind wear that the tool table has); needs "
           "--tools"),
       .set = &set_tools},
      {.name = "spindle-power",
       .value = Value::kText,
       .help = of_bind(
           "the most that the control lets the spindle give now, kW; less than the machine's own: the "
           "steps are cut with that"),
       .set = &set_power},
      {.name = "axis-limits",
       .value = Value::kText,
       .help = of_bind(
           "where the axes may be now, mm in machine coordinates: X=0:350,Z=-200:-5 (Z of the spindle's "
           "gage line), the machine's own travels holding too; a program that leaves them is not given; "
           "needs --work-offset"),
       .set = &set_limits},
      {.name = "work-offset",
       .value = Value::kText,
       .help = of_bind("where the work offset lies, mm in machine coordinates: X=120,Y=80,Z=-310; of several "
                       "G54:X=120,Y=80,Z=-310;G55:X=300,Y=80,Z=-310; for --axis-limits, it moves nothing"),
       .set = &set_offsets},
      {.name = "feed-override",
       .value = Value::kWhole,
       .help = of_bind(
           "the feed override of the control, %, at most 100: at more a given feed makes thicker chips "
           "than were checked; turn it back"),
       .set =
           [](Request& r, const std::string& t) {
             r.state.feed_override = static_cast<unsigned>(std::stoul(t));
             return std::string();
           },
       .least = 1,
       .most = 100},
  };
}

}  // namespace capstan::service

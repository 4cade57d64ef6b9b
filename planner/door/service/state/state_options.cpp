#include "planner/door/service/state/state_options.h"

#include <cmath>
#include <string>

#include "planner/door/service/state/machine_state.h"
#include "planner/ground/base/number.h"

namespace capstan::service {
namespace {

std::string set_power(Request& r, const std::string& text) {
  const auto kw = parse_double(text);
  if (!kw || !std::isfinite(*kw) || !(*kw > 0.0)) return "'" + text + "' is no power above 0 in kW, e.g. 5.5";
  r.state.spindle_power_kw = *kw;
  return {};
}

}  // namespace

std::vector<Option> state_options() {
  return {
      {.name = "spindle-power",
       .value = Value::kText,
       .help = {nullptr,
                "the most that the control lets the spindle give now, kW; less than the machine's own: the "
                "steps are cut with that",
                nullptr},
       .set = &set_power},
      {.name = "feed-override",
       .value = Value::kWhole,
       .help = {nullptr,
                "the feed override of the control, %, at most 100: at more a given feed makes thicker chips "
                "than were checked; turn it back",
                nullptr},
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

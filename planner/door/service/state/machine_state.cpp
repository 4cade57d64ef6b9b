#include "planner/door/service/state/machine_state.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "planner/ground/base/number.h"

// A limit of the moment is a limit of the machine while it is bound for: planning, the program's travels and
// the check go by the one that is narrower.

namespace capstan::service {
namespace {

/// "X=0:350"; nothing where it is not that.
std::optional<AxisLimit> one_limit(const std::string& text) {
  const auto is = text.find('='), to = text.find(':');
  if (is == std::string::npos || to == std::string::npos || is == 0 || to < is) return std::nullopt;
  const auto least = parse_double(text.substr(is + 1, to - is - 1));
  const auto most = parse_double(text.substr(to + 1));
  if (!least || !most || !std::isfinite(*least) || !std::isfinite(*most) || !(*least < *most))
    return std::nullopt;
  return AxisLimit{text.substr(0, is), *least, *most};
}

void take_power(double most_w, std::vector<model::SpindlePoint>& curve) {
  for (model::SpindlePoint& p : curve) {
    const double power_w = p.power_w > 0.0 ? p.power_w : p.torque_nm * 2.0 * std::numbers::pi * p.rpm / 60.0;
    if (!(power_w > most_w)) continue;
    // At one speed power goes with torque; one that is not stated follows from the other.
    const double share = most_w / power_w;
    p.torque_nm *= share;
    p.power_w *= share;
  }
}

}  // namespace

Result<std::vector<AxisLimit>> parse_axis_limits(const std::string& text) {
  std::vector<AxisLimit> out;
  for (std::size_t begin = 0; begin <= text.size();) {
    const auto end = std::min(text.find(',', begin), text.size());
    const std::string one = text.substr(begin, end - begin);
    auto limit = one_limit(one);
    const bool twice = limit && std::any_of(out.begin(), out.end(),
                                            [&](const AxisLimit& l) { return l.axis == limit->axis; });
    if (!limit || twice)
      return fail({.code = "OPTION-VALUE",
                   .message = twice ? "axis " + limit->axis + " has two ranges"
                                    : "'" + one + "' is no range of an axis",
                   .expected = "AXIS=FROM:TO in mm with FROM below TO, with commas between axes: "
                               "X=0:350,Z=-200:-5"});
    out.push_back(*std::move(limit));
    begin = end + 1;
  }
  return out;
}

Status take_state(const MachineState& state, const std::string& sign, model::Machine& machine,
                  std::vector<model::Provenance>& provenance, Job& job) {
  const auto record = [&](const std::string& name, const std::string& value) {
    provenance.push_back({name, value, sign + name});
  };
  if (state.spindle_power_kw) {
    const double most_w = 1e3 * *state.spindle_power_kw;
    take_power(most_w, machine.spindle.curve);
    for (model::SpindleGear& gear : machine.spindle.gears) {
      take_power(most_w, gear.curve);
      take_power(most_w, gear.curve_s6);
    }
    record("spindle-power", trimmed(*state.spindle_power_kw, 3) + " kW");
  }
  std::string limits;
  for (const AxisLimit& l : state.axis_limits) {
    const auto axis = std::find_if(machine.axes.begin(), machine.axes.end(),
                                   [&](const model::LinearAxis& a) { return a.name == l.axis; });
    if (axis == machine.axes.end())
      return fail(
          {.code = "LATE-STATE",
           .message = "machine '" + machine.id + "' has no axis '" + l.axis + "'",
           .expected = machine.axes[0].name + ", " + machine.axes[1].name + " or " + machine.axes[2].name});
    const bool stated = axis->travel_max_mm > axis->travel_min_mm;
    const double least = stated ? std::max(axis->travel_min_mm, l.least_mm) : l.least_mm;
    const double most = stated ? std::min(axis->travel_max_mm, l.most_mm) : l.most_mm;
    if (!(least < most))
      return fail({.code = "LATE-STATE",
                   .message = "axis " + l.axis + " may go from " + trimmed(l.least_mm, 3) + " to " +
                              trimmed(l.most_mm, 3) + " mm, and its travel on machine '" + machine.id +
                              "' is " + trimmed(axis->travel_min_mm, 3) + " to " +
                              trimmed(axis->travel_max_mm, 3) + " mm: nothing is left of it",
                   .hint = "give the limits in machine coordinates"});
    axis->travel_min_mm = least;
    axis->travel_max_mm = most;
    limits += (limits.empty() ? "" : ",") + l.axis + "=" + trimmed(least, 3) + ":" + trimmed(most, 3);
  }
  if (!limits.empty()) record("axis-limits", limits + " mm");
  if (state.feed_override && *state.feed_override < 100U) {
    record("feed-override", std::to_string(*state.feed_override) + " %");
    job.note("LATE-OVERRIDE", "the control runs " + std::to_string(*state.feed_override) +
                                  " % of the programmed feeds; times are those of the whole feed");
  }
  return {};
}

}  // namespace capstan::service

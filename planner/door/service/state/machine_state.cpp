#include "planner/door/service/state/machine_state.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

#include "planner/ground/base/number.h"

// A limit of the moment is a limit of the machine while it is bound for: planning and the
// check go by the one that is narrower.

namespace capstan::service {
namespace {

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

std::vector<std::string> split(const std::string& text, char at) {
  std::vector<std::string> out;
  for (std::size_t begin = 0; begin <= text.size();) {
    const auto end = std::min(text.find(at, begin), text.size());
    out.push_back(text.substr(begin, end - begin));
    begin = end + 1;
  }
  return out;
}

std::optional<double> finite(const std::string& text) {
  const auto v = parse_double(text);
  return v && std::isfinite(*v) ? v : std::nullopt;
}

/// "X=0:350"; nothing where it is not that.
std::optional<AxisLimit> one_limit(const std::string& text) {
  const auto is = text.find('='), to = text.find(':');
  if (is == std::string::npos || to == std::string::npos || is == 0 || to < is) return std::nullopt;
  const auto least = finite(text.substr(is + 1, to - is - 1)), most = finite(text.substr(to + 1));
  if (!least || !most || !(*least < *most)) return std::nullopt;
  return AxisLimit{text.substr(0, is), *least, *most};
}

/// "G54:X=120,Y=80,Z=-310", or without the name; nothing where it is not that.
std::optional<WorkOffset> one_offset(const std::string& text) {
  const auto named = text.find(':');
  WorkOffset out;
  if (named == 0) return std::nullopt;
  if (named != std::string::npos) out.name = text.substr(0, named);
  std::array<std::optional<double>, 3> at;
  for (const std::string& one : split(named == std::string::npos ? text : text.substr(named + 1), ',')) {
    const auto axis = std::string("XYZ").find(one.empty() ? '?' : one[0]);
    if (axis == std::string::npos || one.size() < 3 || one[1] != '=' || at[axis]) return std::nullopt;
    at[axis] = finite(one.substr(2));
    if (!at[axis]) return std::nullopt;
  }
  if (!at[0] || !at[1] || !at[2]) return std::nullopt;
  out.at_mm = {*at[0], *at[1], *at[2]};
  return out;
}

/// Each of the parts by `one`; `name` of two may not be the same.
template <class T, class One, class Name>
Result<std::vector<T>> parse_each(const std::vector<std::string>& parts, const One& one, const Name& name,
                                  const std::string& what, const std::string& expected) {
  std::vector<T> out;
  for (const std::string& part : parts) {
    auto got = one(part);
    const bool twice =
        got && std::any_of(out.begin(), out.end(), [&](const T& t) { return name(t) == name(*got); });
    if (!got || twice)
      return fail({.code = "OPTION-VALUE",
                   .message = "'" + part + "' is " + (twice ? "there twice" : "no " + what),
                   .expected = expected});
    out.push_back(*std::move(got));
  }
  return out;
}

}  // namespace

Result<std::vector<AxisLimit>> parse_axis_limits(const std::string& text) {
  return parse_each<AxisLimit>(
      split(text, ','), &one_limit, [](const AxisLimit& l) { return l.axis; }, "range of an axis",
      "AXIS=FROM:TO in mm with FROM below TO, with commas between axes: X=0:350,Z=-200:-5");
}

Result<std::vector<WorkOffset>> parse_work_offsets(const std::string& text) {
  const std::string expected =
      "X=120,Y=80,Z=-310, or by name with semicolons between: G54:X=120,Y=80,Z=-310;G55:X=300,Y=80,Z=-310";
  auto out = parse_each<WorkOffset>(
      split(text, ';'), &one_offset, [](const WorkOffset& o) { return o.name; }, "place of a work offset",
      expected);
  if (out && out->size() > 1 &&
      std::any_of(out->begin(), out->end(), [](const WorkOffset& o) { return o.name.empty(); }))
    return fail({.code = "OPTION-VALUE",
                 .message = "one place of '" + text + "' has no name, beside others",
                 .expected = expected});
  return out;
}

void take_state(const MachineState& state, const std::string& sign, model::Machine& machine,
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
  std::string limits, offsets;
  for (const AxisLimit& l : state.axis_limits)
    limits +=
        (limits.empty() ? "" : ",") + l.axis + "=" + trimmed(l.least_mm, 3) + ":" + trimmed(l.most_mm, 3);
  if (!limits.empty()) record("axis-limits", limits);
  for (const WorkOffset& o : state.work_offsets)
    offsets += (offsets.empty() ? "" : ";") + o.name + (o.name.empty() ? "" : ":") +
               "X=" + trimmed(o.at_mm.x, 3) + ",Y=" + trimmed(o.at_mm.y, 3) + ",Z=" + trimmed(o.at_mm.z, 3);
  if (!offsets.empty()) record("work-offset", offsets);
  if (state.feed_override && *state.feed_override < 100U) {
    record("feed-override", std::to_string(*state.feed_override) + " %");
    job.note("LATE-OVERRIDE", "the control runs " + std::to_string(*state.feed_override) +
                                  " % of the programmed feeds; times are those of the whole feed");
  }
}

}  // namespace capstan::service

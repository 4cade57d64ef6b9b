#include "planner/door/service/state/machine_state.h"

#include <numbers>

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

}  // namespace

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
  if (state.feed_override && *state.feed_override < 100U) {
    record("feed-override", std::to_string(*state.feed_override) + " %");
    job.note("LATE-OVERRIDE", "the control runs " + std::to_string(*state.feed_override) +
                                  " % of the programmed feeds; times are those of the whole feed");
  }
}

}  // namespace capstan::service

#include "planner/door/service/state/axis_limits.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "planner/controls/controls.h"
#include "planner/ground/base/number.h"
#include "planner/model/plan/resources/control_options.h"
#include "planner/proof/verify/axis_places.h"

namespace capstan::service {
namespace {

Diagnostic fault(const model::Plan& plan, std::string message) {
  return {.code = "LATE-PLACE",
          .message = std::move(message),
          .file = plan.file_name,
          .hint = "retract and stop; nothing may be cut from this plan as the machine stands"};
}

/// Whether the program's places on an axis are not known, for the zero of Z is set with each tool: it is held
/// only where somebody limits it.
bool is_touched_off(const model::Machine& machine, std::size_t axis) {
  return axis == 2 && model::control_option(machine, "tool_length") == "touch_off";
}

/// Where an axis may be: within its travel, where its machine states one, and within `limit`, where it is
/// told; nothing where neither is. Least not below most where the two do not meet.
std::optional<AxisLimit> range_of(const model::LinearAxis& axis, const AxisLimit* limit) {
  const bool travels = axis.travel_max_mm > axis.travel_min_mm;
  if (!travels) return limit == nullptr ? std::nullopt : std::optional(*limit);
  AxisLimit out{axis.name, axis.travel_min_mm, axis.travel_max_mm};
  if (limit == nullptr) return out;
  out.least_mm = std::max(out.least_mm, limit->least_mm);
  out.most_mm = std::min(out.most_mm, limit->most_mm);
  return out;
}

}  // namespace

bool is_of_other_control(const Format& format, const model::Plan& plan) {
  return format.control != controls::find_dialect(plan.machine.control.dialect);
}

Diagnostic not_held(const Format& format, const model::Plan& plan) {
  return fault(plan, "a program as '" + std::string(format.name) +
                         "' is not that of the machine's own control, which alone is held against the limits "
                         "of the axes");
}

std::optional<Diagnostic> leaves_limits(const MachineState& state, const model::Plan& plan,
                                        const std::string& program, const std::string& table) {
  if (state.axis_limits.empty()) return std::nullopt;
  verify::AxisPlaces places;
  for (const AxisLimit& l : state.axis_limits) {
    const auto& axes = plan.machine.axes;
    if (std::none_of(axes.begin(), axes.end(), [&](const auto& a) { return a.name == l.axis; }))
      return fault(plan, "machine '" + plan.machine.id + "' has no axis '" + l.axis + "'; it has " +
                             axes[0].name + ", " + axes[1].name + " and " + axes[2].name);
  }
  for (std::size_t i = 0; i < plan.machine.axes.size(); ++i) {
    const model::LinearAxis& axis = plan.machine.axes[i];
    const auto limit = std::find_if(state.axis_limits.begin(), state.axis_limits.end(),
                                    [&](const AxisLimit& l) { return l.axis == axis.name; });
    if (limit == state.axis_limits.end() && is_touched_off(plan.machine, i)) continue;
    const auto range = range_of(axis, limit == state.axis_limits.end() ? nullptr : &*limit);
    if (!range) continue;
    if (!(range->least_mm < range->most_mm))
      return fault(plan, "axis " + axis.name + " may be from " + trimmed(limit->least_mm, 3) + " to " +
                             trimmed(limit->most_mm, 3) + " mm by the limits of the axes, and travels from " +
                             trimmed(axis.travel_min_mm, 3) + " to " + trimmed(axis.travel_max_mm, 3) +
                             " mm by the file of machine '" + plan.machine.id + "': nowhere is within both");
    places.ranges.push_back({i, range->least_mm, range->most_mm});
  }
  for (const WorkOffset& o : state.work_offsets) places.offsets.push_back({o.name, o.at_mm});
  if (program.empty() && !plan.steps.empty())
    return fault(plan, "there is no program whose places could be held against the limits of the axes");
  const auto found =
      verify::check_axis_places({"program", program, table}, &plan, plan.machine, plan.cutters, places);
  if (found.empty()) return std::nullopt;
  const model::Finding& first = found.front();
  Diagnostic out = fault(plan, (first.step.empty() ? "" : "step '" + first.step + "': ") + first.message);
  out.path = first.step;
  return out;
}

}  // namespace capstan::service

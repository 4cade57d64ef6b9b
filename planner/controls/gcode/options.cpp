#include "planner/controls/gcode/options.h"

#include "planner/model/plan/resources/control_options.h"

namespace capstan::controls::gcode {

BlockNumbers block_numbers_of(const model::Machine& machine) {
  const std::string_view option = model::control_option(machine, "block_numbers");
  if (option == "all") return BlockNumbers::kAll;
  return option == "steps" ? BlockNumbers::kSteps : BlockNumbers::kNone;
}

std::string tool_end_of(const model::Machine& machine) {
  const std::string_view option = model::control_option(machine, "prove_out");
  if (option == "m1") return "M1";
  if (option == "m0") return "M0";
  return option == "skip_m0" ? "/M0" : "";
}

std::optional<ThroughCodes> through_codes_of(const model::Machine& machine) {
  const model::ControlOption stated{"through_coolant",
                                    std::string(model::control_option(machine, "through_coolant"))};
  if (stated.value.empty() || !model::control_option_fault(machine.control.dialect, stated).empty())
    return std::nullopt;
  const std::size_t slash = stated.value.find('/');
  return ThroughCodes{stated.value.substr(0, slash), stated.value.substr(slash + 1)};
}

Status options_right(const model::Plan& plan) {
  if (!plan.machine.control_options) return {};
  for (const model::ControlOption& o : plan.machine.control_options->chosen) {
    const std::string wrong = model::control_option_fault(plan.machine.control.dialect, o);
    if (!wrong.empty())
      return fail({.code = "OUT-OPTION",
                   .message = "machine '" + plan.machine.id + "': " + o.name + ": " + wrong,
                   .hint = "correct it under the machine's control"});
  }
  return {};
}

}  // namespace capstan::controls::gcode

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
  const std::string_view option = model::control_option(machine, "through_coolant");
  const std::size_t slash = option.find('/');
  if (slash == std::string_view::npos) return std::nullopt;
  const auto is_code = [](std::string_view s) {
    return s.size() > 1 && s.front() == 'M' && s.find_first_not_of("0123456789", 1) == std::string_view::npos;
  };
  ThroughCodes out{std::string(option.substr(0, slash)), std::string(option.substr(slash + 1))};
  if (!is_code(out.on) || !is_code(out.off)) return std::nullopt;
  return out;
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

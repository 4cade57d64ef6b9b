#include "planner/controls/gcode/options.h"

#include <algorithm>

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

std::vector<std::string> blocks_of(std::string_view option) {
  std::vector<std::string> out;
  while (!option.empty()) {
    const std::size_t bar = std::min(option.find('|'), option.size());
    std::string_view block = option.substr(0, bar);
    option.remove_prefix(std::min(bar + 1, option.size()));
    while (!block.empty() && block.front() == ' ') block.remove_prefix(1);
    while (!block.empty() && block.back() == ' ') block.remove_suffix(1);
    if (!block.empty()) out.emplace_back(block);
  }
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

Status numbers_differ(const model::Machine& machine, int first, std::size_t count) {
  const auto own = static_cast<int>(model::control_number(machine, "program_number", 0.0));
  const int last = first + static_cast<int>(count) - 1;
  if (own < first || own > last) return {};
  const auto o = [](int number) { return "O" + std::to_string(number); };
  return fail({.code = "OUT-OPTION",
               .message = "machine '" + machine.id + "': program_number: " + o(own) +
                          " is also a subprogram of this program, which has " + o(first) +
                          (last > first ? " to " + o(last) : "") + " by 'subprograms'",
               .hint = "state another program_number or other subprograms under the machine's control"});
}

}  // namespace capstan::controls::gcode

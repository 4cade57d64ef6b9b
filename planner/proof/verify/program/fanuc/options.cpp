#include "planner/proof/verify/program/fanuc/options.h"

#include <stdexcept>
#include <string>

#include "planner/ground/base/number.h"

namespace capstan::verify::fanuc {

std::string_view option(const model::Machine& machine, std::string_view name) {
  for (const OptionDefault& d : kOptionDefaults) {
    if (d.name != name) continue;
    if (machine.control_options) {
      for (const model::ControlOption& o : machine.control_options->chosen) {
        if (o.name == name) return o.value;
      }
    }
    return machine.control.dialect == "haas" ? d.of_haas : d.of_fanuc;
  }
  throw std::logic_error("the reader has no default of the option " + std::string(name));
}

double option_number(const model::Machine& machine, std::string_view name) {
  return parse_double(option(machine, name)).value_or(0.0);
}

}  // namespace capstan::verify::fanuc

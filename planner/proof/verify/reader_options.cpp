#include "planner/proof/verify/reader_options.h"

#include <stdexcept>
#include <string>

#include "planner/ground/base/number.h"
#include "planner/proof/verify/program/readers.h"

namespace capstan::verify {

std::string_view reader_default(std::string_view control, std::string_view name) {
  const DialectReader* reader = reader_of(control);
  for (std::string_view rest = reader != nullptr ? reader->options : ""; !rest.empty();) {
    const std::string_view one = rest.substr(0, rest.find(' '));
    const std::size_t equals = one.find('=');
    if (one.substr(0, equals) == name) return one.substr(equals + 1);
    rest.remove_prefix(one.size() == rest.size() ? rest.size() : one.size() + 1);
  }
  return "-";
}

std::string_view option(const model::Machine& machine, std::string_view name) {
  const std::string_view value = reader_default(machine.control.dialect, name);
  if (value == "-") throw std::logic_error("the reader has no default of the option " + std::string(name));
  if (machine.control_options) {
    for (const model::ControlOption& o : machine.control_options->chosen) {
      if (o.name == name) return o.value;
    }
  }
  return value;
}

double option_number(const model::Machine& machine, std::string_view name) {
  return parse_double(option(machine, name)).value_or(0.0);
}

bool touches_off(const model::Machine& machine) {
  constexpr std::string_view kName = "tool_length";
  return reader_default(machine.control.dialect, kName) != "-" && option(machine, kName) == "touch_off";
}

}  // namespace capstan::verify

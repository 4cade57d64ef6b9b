#include "planner/model/plan/resources/control_options.h"

#include <algorithm>
#include <cmath>

#include "planner/ground/base/number.h"
#include "planner/ground/vocabulary/control_options.h"
#include "planner/ground/vocabulary/probe_macros.h"

namespace capstan::model {

std::string_view control_option(const Machine& machine, std::string_view name) {
  const ControlOptionRow* row = find_control_option(machine.control.dialect, name);
  if (row == nullptr) return {};
  if (machine.control_options) {
    for (const ControlOption& o : machine.control_options->chosen) {
      if (o.name == name) return o.value;
    }
  }
  return default_of(*row, machine.control.dialect);
}

double control_number(const Machine& machine, std::string_view name, double other) {
  return parse_double(control_option(machine, name)).value_or(other);
}

namespace {

const ProbeMacroRow* shipped_macro(const Machine& machine) {
  return find_probe_macro(machine.control.dialect, control_option(machine, "probe_macro"));
}

}  // namespace

std::string_view probe_macro_blocks(const Machine& machine) {
  const ProbeMacroRow* row = shipped_macro(machine);
  return row == nullptr ? control_option(machine, "probe_macro") : row->blocks;
}

double probe_macro_beyond_mm(const Machine& machine) {
  const ProbeMacroRow* row = shipped_macro(machine);
  return row == nullptr ? 0.0 : row->beyond_mm;
}

std::string_view unconfirmed_probe_macro(const Machine& machine) {
  const ProbeMacroRow* row = shipped_macro(machine);
  const bool confirmed = control_option(machine, "probe_macro_confirmed") == "yes";
  return row == nullptr || confirmed ? std::string_view() : row->id;
}

namespace {

/// An id has small letters, digits and _ alone, which no block of a macro has.
std::string unknown_macro(std::string_view dialect, std::string_view value) {
  constexpr std::string_view kOfIds = "abcdefghijklmnopqrstuvwxyz0123456789_";
  if (value.empty() || value.find_first_not_of(kOfIds) != std::string_view::npos ||
      find_probe_macro(dialect, value) != nullptr)
    return {};
  std::string out = "'" + std::string(value) + "' is no shipped macro of this control:";
  for (const ProbeMacroRow& row : kProbeMacros) {
    if (find_probe_macro(dialect, row.id) == &row) out += " " + std::string(row.id);
  }
  return out;
}

bool is_m_code(std::string_view s) {
  return s.size() > 1 && s.size() < 6 && s.front() == 'M' &&
         s.find_first_not_of("0123456789", 1) == std::string_view::npos;
}

bool has_form(std::string_view value, ControlOptionRow::Form form) {
  if (form == ControlOptionRow::Form::kAny) return true;
  const char between = form == ControlOptionRow::Form::kMPair ? '/' : ' ';
  std::size_t codes = 0;
  while (!value.empty()) {
    const std::size_t end = std::min(value.find(between), value.size());
    if (!is_m_code(value.substr(0, end))) return false;
    ++codes;
    if (end + 1 == value.size()) return false;  // nothing behind the last separator
    value.remove_prefix(std::min(end + 1, value.size()));
  }
  return form == ControlOptionRow::Form::kMPair ? codes == 2 : codes > 0;
}

}  // namespace

std::string control_option_fault(std::string_view dialect, const ControlOption& option) {
  const ControlOptionRow* row = find_control_option(dialect, option.name);
  if (row == nullptr) return "the control '" + std::string(dialect) + "' has no option '" + option.name + "'";
  if (row->name == "probe_macro") return unknown_macro(dialect, option.value);
  if (!row->words.empty())
    return has_word(row->words, option.value)
               ? std::string()
               : "'" + option.value + "' is none of: " + std::string(row->words);
  if (!has_form(option.value, row->form))
    return "'" + option.value + "' is not " +
           (row->form == ControlOptionRow::Form::kMPair ? "two M codes as M88/M89"
                                                        : "M codes with a blank between, as M51 M52");
  if (row->least == 0.0 && row->most == 0.0) return {};
  const auto v = parse_double(option.value);
  if (v && *v >= row->least && *v <= row->most && (!row->whole || *v == std::floor(*v))) return {};
  return "'" + option.value + "' is no " + (row->whole ? "whole number from " : "number from ") +
         shortest(row->least) + " to " + shortest(row->most);
}

}  // namespace capstan::model

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

#include "planner/ground/base/no_number.h"
#include "planner/ground/base/number.h"
#include "planner/ground/vocabulary/unit_factors.h"
#include "planner/model/plan/range/ranges.h"
#include "tooling/shop/machine/machine.h"

namespace capstan::tooling {
namespace {

using model::Machine;

constexpr const char* kDefault = "default, unsourced: the ini does not state it";

struct Value {
  std::string text;
  std::uint64_t line = 0;
};
using Ini = std::map<std::pair<std::string, std::string>, Value>;  // first of equal keys

std::string stripped(std::string_view s) {
  const auto a = s.find_first_not_of(" \t\r");
  if (a == std::string_view::npos) return {};
  return std::string(s.substr(a, s.find_last_not_of(" \t\r") - a + 1));
}

Ini read_ini(std::string_view text) {
  Ini out;
  std::string section;
  std::uint64_t number = 0;
  while (!text.empty()) {
    const auto end = text.find('\n');
    const std::string line = stripped(text.substr(0, end));
    text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
    ++number;
    if (line.empty() || line[0] == '#' || line[0] == ';') continue;
    if (line[0] == '[') {
      section = line.substr(1, line.find(']') - 1);
      continue;
    }
    const auto equals = line.find('=');
    if (equals == std::string::npos) continue;
    std::string value = line.substr(equals + 1);
    if (const auto comment = value.find_first_of("#;"); comment != std::string::npos) value.resize(comment);
    out.emplace(std::pair(section, stripped(line.substr(0, equals))), Value{stripped(value), number});
  }
  return out;
}

struct Reader {
  Ini ini;
  std::string file;
  std::optional<Diagnostic> fault;

  std::optional<double> number(const std::string& section, const std::string& key) {
    const auto it = ini.find({section, key});
    if (it == ini.end()) return std::nullopt;
    const auto v = parse_double(it->second.text);
    if (!v) refuse("MACHINE-INI", no_number(it->second.text), section, key, it->second.line);
    return v;
  }
  double needed(const std::string& section, const std::string& key) {
    const auto v = number(section, key);
    if (!v && !fault) refuse("MACHINE-INI", "it is missing", section, key, 0);
    return v.value_or(0.0);
  }
  std::string text(const std::string& section, const std::string& key) const {
    const auto it = ini.find({section, key});
    return it == ini.end() ? std::string() : it->second.text;
  }
  void refuse(std::string code, std::string message, const std::string& section, const std::string& key,
              std::uint64_t line) {
    if (fault) return;
    fault = Diagnostic{.code = std::move(code),
                       .message = std::move(message),
                       .file = file,
                       .line = line,
                       .path = "[" + section + "]" + key};
  }
};

void read_axis(Reader& r, std::size_t i, double mm_per_unit, Machine& m) {
  const std::string name(1, static_cast<char>('X' + i));
  std::string section = "AXIS_" + name;
  // Configurations older than LinuxCNC 2.8 number their axes.
  if (r.ini.count({section, "MAX_LIMIT"}) == 0 &&
      r.ini.count({"AXIS_" + std::to_string(i), "MAX_LIMIT"}) != 0)
    section = "AXIS_" + std::to_string(i);
  model::LinearAxis& a = m.axes.at(i);
  a.name = name;
  a.travel_min_mm = r.needed(section, "MIN_LIMIT") * mm_per_unit;
  a.travel_max_mm = r.needed(section, "MAX_LIMIT") * mm_per_unit;
  a.rapid_mm_min = r.needed(section, "MAX_VELOCITY") * mm_per_unit * 60.0;
  a.feed_max_mm_min = a.rapid_mm_min;
  a.acceleration_mm_s2 = r.needed(section, "MAX_ACCELERATION") * mm_per_unit;
  // The straight-line limit of the planner bounds feeds on every axis.
  if (const auto limit = r.number("TRAJ", "MAX_LINEAR_VELOCITY"))
    a.feed_max_mm_min = std::min(a.feed_max_mm_min, *limit * mm_per_unit * 60.0);
  if (a.travel_min_mm >= a.travel_max_mm)
    r.refuse("MACHINE-RANGE", "MIN_LIMIT is not below MAX_LIMIT", section, "MIN_LIMIT", 0);
  const auto within = [&](double v, const model::Range& range, const char* code, const char* key,
                          const char* unit) {
    if (!range.holds(v))
      r.refuse(code, "it is " + model::value_text(v) + unit + "; it can be " + to_text(range), section, key,
               0);
  };
  within(a.travel_min_mm, model::range::kAxisPositionMm, "MACHINE-RANGE", "MIN_LIMIT", " mm");
  within(a.travel_max_mm, model::range::kAxisPositionMm, "MACHINE-RANGE", "MAX_LIMIT", " mm");
  within(a.rapid_mm_min, model::range::kAxisSpeedMmMin, "MACHINE-RANGE", "MAX_VELOCITY", " mm/min");
  within(a.feed_max_mm_min, model::range::kAxisSpeedMmMin, "MACHINE-RANGE", "MAX_VELOCITY", " mm/min");
  within(a.acceleration_mm_s2, model::range::kAccelerationMmS2, "MACHINE-ACCELERATION", "MAX_ACCELERATION",
         " mm/s2");
  for (const char* field :
       {"travel_min_mm", "travel_max_mm", "rapid_mm_min", "feed_max_mm_min", "acceleration_mm_s2"})
    m.sources.emplace_back("axes." + name + "." + field, "stated: " + r.file + " [" + section + "]");
}

/// What an ini does not say, taken from the shipped machine for the simulator.
void fill_defaults(Reader& r, Machine& m, Job& job) {
  Job quiet;
  auto base = load_machine("linuxcnc_axis_mm", quiet);
  if (!base) throw std::logic_error("the shipped machine linuxcnc_axis_mm cannot be read");
  m.spindle = base->spindle;
  m.magazine_pockets = base->magazine_pockets;
  m.tool_diameter_max_mm = base->tool_diameter_max_mm;
  m.tool_length_max_mm = base->tool_length_max_mm;
  m.tool_change_s = base->tool_change_s;
  m.has_flood = base->has_flood;
  m.has_mist = base->has_mist;
  m.has_through = base->has_through;
  m.cost_per_hour = base->cost_per_hour;
  m.control = base->control;
  for (const char* part : {"spindle", "magazine", "coolant", "cost_per_hour", "control"})
    m.sources.emplace_back(part, kDefault);
  if (const auto top = r.number("SPINDLE_0", "MAX_FORWARD_VELOCITY");
      top && *top > m.spindle.rpm_min && *top < m.spindle.rpm_max) {
    m.spindle.rpm_max = *top;
    m.sources.emplace_back("spindle.rpm_max", "stated: " + r.file + " [SPINDLE_0]");
  }
  job.warn("MACHINE-DEFAULT", r.file + " states no spindle power, magazine or coolant: " +
                                  trimmed(m.spindle.curve.back().power_w, 1) + " W and " +
                                  trimmed(m.spindle.rpm_max, 1) +
                                  " 1/min are assumed; describe the machine in a machine file");
}

}  // namespace

Result<Machine> read_linuxcnc_ini(std::string_view text, const std::string& file, Job& job) {
  Reader r{read_ini(text), file, std::nullopt};
  std::string unit = r.text("TRAJ", "LINEAR_UNITS");
  std::transform(unit.begin(), unit.end(), unit.begin(),
                 [](char c) { return c >= 'A' && c <= 'Z' ? c + 32 : c; });
  const bool inch = unit == "inch" || unit == "in" || unit == "imperial";
  if (!inch && unit != "mm" && unit != "metric") {
    return fail(
        {.code = "MACHINE-INI",
         .message = unit.empty() ? "[TRAJ]LINEAR_UNITS is missing" : "the unit '" + unit + "' is not known",
         .file = file,
         .path = "[TRAJ]LINEAR_UNITS",
         .expected = "mm or inch"});
  }
  Machine m;
  m.id = r.text("EMC", "MACHINE");
  if (m.id.empty()) m.id = file.substr(file.rfind('/') + 1);
  m.description = "LinuxCNC configuration " + m.id;
  for (std::size_t i = 0; i < 3; ++i) read_axis(r, i, inch ? kMmPerInch : 1.0, m);
  if (r.fault) return fail(std::move(*r.fault));
  fill_defaults(r, m, job);
  return m;
}

}  // namespace capstan::tooling

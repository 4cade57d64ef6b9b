#include "tooling/shop/machine/machine.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <numbers>

#include "planner/ground/base/file.h"
#include "planner/ground/base/nearest_names.h"
#include "planner/ground/base/number.h"
#include "planner/ground/vocabulary/control_options.h"
#include "planner/model/plan/range/ranges.h"
#include "planner/model/plan/resources/control_options.h"
#include "tooling/shop/data/data.h"
#include "tooling/shop/data/tree.h"

namespace capstan::tooling {
namespace {

using model::LinearAxis;
using model::Machine;
using model::SpindlePoint;
namespace range = model::range;

constexpr std::array<const char*, 3> kAxes = {"X", "Y", "Z"};
/// A milling spindle that never turns faster than this is a slip of unit: 600 rev/s is 36,000 1/min.
constexpr double kSlowestTopSpeedRpm = 600.0;
constexpr double kRevPerSecond = 60.0;

double watts(double torque_nm, double rpm) { return torque_nm * 2.0 * std::numbers::pi * rpm / 60.0; }

void put_in_gear(Machine& m, const model::SpindleGear& g) {
  m.spindle.rpm_min = g.rpm_min;
  m.spindle.rpm_max = g.rpm_max;
  m.spindle.curve = g.curve;
}

/// Collects where each value of the machine is from; a value without a source is a fault.
void keep_sources(Fields& f, Machine& m) {
  for (const auto& [path, source] : f.sources()) {
    if (source.empty()) f.fault("DATA-SOURCE", "no source is stated", path, f.line());
    m.sources.emplace_back(path, source);
  }
  f.finish();
}

void within(Fields& f, std::string_view key, double value, const model::Range& range, const char* unit = "") {
  if (range.holds(value)) return;
  f.fault(key.starts_with("acceleration") ? "MACHINE-ACCELERATION" : "MACHINE-RANGE",
          std::string(key) + (value < 0.0 && range.least >= 0.0 ? " is negative: " : " is ") +
              model::value_text(value),
          key, f.line_of(key), to_text(range) + unit);
}

void check_axis(Fields& f, const LinearAxis& a) {
  within(f, "travel_min_mm", a.travel_min_mm, range::kAxisPositionMm);
  within(f, "travel_max_mm", a.travel_max_mm, range::kAxisPositionMm);
  if (a.travel_min_mm >= a.travel_max_mm)
    f.fault("MACHINE-RANGE",
            "travel_min_mm (" + model::value_text(a.travel_min_mm) + ") is not below travel_max_mm (" +
                model::value_text(a.travel_max_mm) + ")",
            "travel_min_mm", f.line_of("travel_min_mm"));
  else if (!range::kTravelMm.holds(a.travel_max_mm - a.travel_min_mm))
    f.fault("MACHINE-RANGE",
            "the axis travels " + model::value_text(a.travel_max_mm - a.travel_min_mm) + " mm",
            "travel_max_mm", f.line_of("travel_max_mm"), to_text(range::kTravelMm));
  within(f, "rapid_mm_min", a.rapid_mm_min, range::kAxisSpeedMmMin);
  within(f, "feed_max_mm_min", a.feed_max_mm_min, range::kAxisSpeedMmMin);
  within(f, "acceleration_mm_s2", a.acceleration_mm_s2, range::kAccelerationMmS2);
  if (a.jerk_mm_s3) within(f, "jerk_mm_s3", *a.jerk_mm_s3, range::kJerkMmS3);
}

LinearAxis read_axis(Fields f, const std::string& name, Machine& m) {
  const std::size_t before = f.fault_count();
  LinearAxis a;
  a.name = name;
  a.travel_min_mm = f.number("travel_min_mm");
  a.travel_max_mm = f.number("travel_max_mm");
  a.rapid_mm_min = f.number("rapid_mm_min");
  a.feed_max_mm_min = f.number("feed_max_mm_min");
  a.acceleration_mm_s2 = f.number("acceleration_mm_s2");
  a.jerk_mm_s3 = f.optional_number("jerk_mm_s3");
  if (f.fault_count() == before) check_axis(f, a);
  keep_sources(f, m);
  return a;
}

void read_axes(Fields& top, Machine& m) {
  const Node* node = top.child("axes", true);
  if (node == nullptr) return;
  Fields f = top.below("axes", *node);
  for (const auto& [name, child] : node->entries) {
    if (name == "source") continue;
    (void)f.child(name, true);
    const auto it = std::find(kAxes.begin(), kAxes.end(), name);
    if (it == kAxes.end()) {
      f.fault("MACHINE-AXIS", "the axis '" + name + "' is not known", name, child.line, "X, Y and Z");
      continue;
    }
    m.axes.at(static_cast<std::size_t>(it - kAxes.begin())) = read_axis(f.below(name, child), name, m);
  }
  for (const char* name : kAxes)
    if (node->find(name) == nullptr)
      f.fault("MACHINE-AXIS", "the axis " + std::string(name) + " is missing", name, node->line);
  f.finish();
}

SpindlePoint read_point(Fields f, Machine& m) {
  const std::size_t before = f.fault_count();
  SpindlePoint p;
  p.rpm = f.number("rpm");
  const auto power = f.optional_number("power_w"), torque = f.optional_number("torque_nm");
  if (!power && !torque)
    f.fault("DATA-MISSING", "a point of the curve needs power_w or torque_nm", "power_w", f.line());
  if (f.fault_count() == before) within(f, "rpm", p.rpm, range::kCurveRpm);
  if (power) within(f, "power_w", *power, range::kPowerW);
  if (torque) within(f, "torque_nm", *torque, range::kTorqueNm);
  if (f.fault_count() == before) {
    p.power_w = power ? *power : watts(*torque, p.rpm);
    p.torque_nm = torque ? *torque : *power / watts(1.0, p.rpm);
    const double ratio = p.torque_nm > 0.0 ? p.power_w / watts(p.torque_nm, p.rpm) : 1.0;
    if (std::abs(ratio - kRevPerSecond) < 0.1 * kRevPerSecond)
      f.fault("MACHINE-RPM",
              "power and torque agree only if " + trimmed(p.rpm, 4) +
                  " is in revolutions per second; write it in 1/min",
              "rpm", f.line_of("rpm"));
  }
  keep_sources(f, m);
  return p;
}

/// Speeds rising; false, and a fault, when they do not.
bool rising(Fields& f, const std::vector<SpindlePoint>& curve, const char* key) {
  for (std::size_t i = 1; i < curve.size(); ++i) {
    if (curve[i].rpm > curve[i - 1].rpm) continue;
    f.fault("MACHINE-CURVE",
            "the power curve runs backwards: " + trimmed(curve[i].rpm, 4) + " after " +
                trimmed(curve[i - 1].rpm, 4) + " 1/min",
            key, f.line_of(key), "speeds rising");
    return false;
  }
  return true;
}

void check_curve(Fields& f, const model::SpindleGear& s) {
  if (!rising(f, s.curve, "curve")) return;
  if (s.curve.empty()) {
    f.fault("MACHINE-CURVE", "the power curve has no point", "curve", f.line_of("curve"));
  } else if (s.curve.front().rpm > s.rpm_min || s.curve.back().rpm < s.rpm_max) {
    f.fault("MACHINE-CURVE",
            "the power curve covers " + trimmed(s.curve.front().rpm, 4) + " to " +
                trimmed(s.curve.back().rpm, 4) + " 1/min, the spindle turns " + trimmed(s.rpm_min, 4) +
                " to " + trimmed(s.rpm_max, 4),
            "curve", f.line_of("curve"), "a point at rpm_min and one at rpm_max; nothing is extrapolated");
  }
}

/// `slow`: a gear may end where no whole spindle would.
void check_speeds(Fields& f, const model::SpindleGear& s, bool slow) {
  within(f, "rpm_min", s.rpm_min, range::kSpindleRpm);
  if (s.rpm_min > s.rpm_max)
    f.fault("MACHINE-RANGE",
            "rpm_min (" + model::value_text(s.rpm_min) + ") is above rpm_max (" +
                model::value_text(s.rpm_max) + ")",
            "rpm_min", f.line_of("rpm_min"));
  else if (!slow && s.rpm_max < kSlowestTopSpeedRpm)
    f.fault("MACHINE-RPM",
            "rpm_max is " + trimmed(s.rpm_max, 4) + ", which looks like revolutions per second; write " +
                trimmed(s.rpm_max * kRevPerSecond, 4) + " if it is",
            "rpm_max", f.line_of("rpm_max"), "1/min, at least " + trimmed(kSlowestTopSpeedRpm, 0));
  else
    within(f, "rpm_max", s.rpm_max, range::kSpindleRpm);
}

std::vector<SpindlePoint> read_curve(Fields& f, const char* key, bool required, Machine& m) {
  std::vector<SpindlePoint> out;
  const Node* curve = f.child(key, required);
  if (curve == nullptr) return out;
  for (std::size_t i = 0; i < curve->items.size(); ++i)
    out.push_back(read_point(f.below(std::string(key) + "[" + std::to_string(i) + "]", curve->items[i]), m));
  return out;
}

/// Speeds and curves of a gear, or of a spindle that has one.
model::SpindleGear read_gear(Fields& f, bool slow, Machine& m) {
  const std::size_t before = f.fault_count();
  model::SpindleGear g;
  g.rpm_min = f.number("rpm_min");
  g.rpm_max = f.number("rpm_max");
  if (f.fault_count() == before) check_speeds(f, g, slow);
  g.curve = read_curve(f, "curve", true, m);
  if (f.has("curve_s6")) g.curve_s6 = read_curve(f, "curve_s6", false, m);
  if (f.fault_count() == before) check_curve(f, g);
  if (f.fault_count() == before) (void)rising(f, g.curve_s6, "curve_s6");
  return g;
}

void read_gears(Fields& f, const Node& list, Machine& m) {
  const std::size_t before = f.fault_count();
  double top = 0.0;
  for (std::size_t i = 0; i < list.items.size(); ++i) {
    Fields row = f.below("gears[" + std::to_string(i) + "]", list.items[i]);
    const std::string id = row.text("id");
    for (const auto& other : m.spindle.gears)
      if (other.id == id)
        row.fault("DATA-DUPLICATE", "the gear '" + id + "' is given twice", "id", row.line_of("id"));
    model::SpindleGear g = read_gear(row, true, m);
    g.id = id;
    top = std::max(top, g.rpm_max);
    keep_sources(row, m);
    m.spindle.gears.push_back(std::move(g));
  }
  if (f.fault_count() != before) return;
  if (list.items.empty())
    f.fault("DATA-MISSING", "there is no gear in 'gears'", "gears", f.line_of("gears"));
  else if (top < kSlowestTopSpeedRpm)
    f.fault("MACHINE-RPM",
            "no gear turns faster than " + trimmed(top, 4) + ", which looks like revolutions per second",
            "gears", f.line_of("gears"), "1/min, at least " + trimmed(kSlowestTopSpeedRpm, 0));
}

void read_spindle(Fields& top, Machine& m) {
  const Node* node = top.child("spindle", true);
  if (node == nullptr) return;
  Fields f = top.below("spindle", *node);
  model::Spindle& s = m.spindle;
  const std::size_t before = f.fault_count();
  s.taper = f.text_or("taper", "");
  s.efficiency = f.number("efficiency");
  s.spin_up_s = f.number("spin_up_s");
  if (f.fault_count() == before) {
    within(f, "spin_up_s", s.spin_up_s, range::kSpinUpS);
    within(f, "efficiency", s.efficiency, range::kEfficiency);
  }
  if (f.has("gears")) {
    if (const Node* list = f.child("gears", true)) read_gears(f, *list, m);
  } else {
    model::SpindleGear only = read_gear(f, false, m);
    if (only.curve_s6.empty()) {
      s.rpm_min = only.rpm_min;
      s.rpm_max = only.rpm_max;
      s.curve = std::move(only.curve);
    } else {
      only.id = "only";  // S6 has its place in a gear
      s.gears.push_back(std::move(only));
    }
  }
  keep_sources(f, m);
  if (!s.gears.empty() && f.fault_count() == before) put_in_gear(m, s.gears.front());
}

void read_abilities(Fields& top, Machine& m) {
  const Node* node = top.child("abilities", false);
  if (node == nullptr) {
    m.sources.emplace_back("abilities", "default, unsourced: the machine file does not state them");
    return;
  }
  Fields f = top.below("abilities", *node);
  model::MachineAbilities& a = m.abilities;
  const std::size_t before = f.fault_count();
  a.control_axes = static_cast<int>(f.optional_integer("control_axes").value_or(a.control_axes));
  a.simultaneous_axes =
      static_cast<int>(f.optional_integer("simultaneous_axes").value_or(a.simultaneous_axes));
  a.positioning_accuracy_mm = f.number_or("positioning_accuracy_mm", a.positioning_accuracy_mm);
  a.table_indexing = f.flag_or("table_indexing", a.table_indexing);
  a.table_length_mm = f.number_or("table_length_mm", a.table_length_mm);
  a.table_width_mm = f.number_or("table_width_mm", a.table_width_mm);
  a.rigid_tapping = f.flag_or("rigid_tapping", a.rigid_tapping);
  a.probe = f.flag_or("probe", a.probe);
  a.through_pressure_bar = f.number_or("through_pressure_bar", a.through_pressure_bar);
  a.feed_override_max = f.number_or("feed_override_max", a.feed_override_max);
  a.magazine_mass_max_kg = f.number_or("magazine_mass_max_kg", a.magazine_mass_max_kg);
  if (f.fault_count() == before) {
    within(f, "positioning_accuracy_mm", a.positioning_accuracy_mm, range::kAccuracyMm);
    within(f, "table_length_mm", a.table_length_mm, range::kTableMm);
    within(f, "table_width_mm", a.table_width_mm, range::kTableMm);
    within(f, "through_pressure_bar", a.through_pressure_bar, range::kPressureBar);
    within(f, "magazine_mass_max_kg", a.magazine_mass_max_kg, range::kMassKg);
    within(f, "feed_override_max", a.feed_override_max, range::kFeedOverride, ", as a factor: 1.2 is 120 %");
    if (!range::kAxes.holds(a.control_axes) || a.simultaneous_axes < 1 ||
        a.simultaneous_axes > a.control_axes)
      f.fault("MACHINE-RANGE",
              std::to_string(a.simultaneous_axes) + " axes at once of " + std::to_string(a.control_axes),
              "control_axes", f.line_of("control_axes"),
              to_text(range::kAxes) + " axes, no more at once than there are");
  }
  keep_sources(f, m);
}

/// Modes of the tool point, as a tap test gives them: far apart from what can be, a slip of unit.
void read_modes(Fields& top, Machine& m) {
  const Node* list = top.child("modes", false);
  if (list == nullptr) return;
  for (std::size_t i = 0; i < list->items.size(); ++i) {
    Fields f = top.below("modes[" + std::to_string(i) + "]", list->items[i]);
    const std::size_t before = f.fault_count();
    model::ToolPointMode mode;
    mode.cutter_id = f.text_or("cutter", "");
    mode.direction = f.text("direction");
    mode.frequency_hz = f.number("frequency_hz");
    mode.damping_ratio = f.number("damping_ratio");
    mode.stiffness_n_mm = f.number("stiffness_n_mm");
    if (f.fault_count() == before) {
      if (mode.direction != "x" && mode.direction != "y")
        f.fault("MACHINE-RANGE", "the direction is '" + mode.direction + "'", "direction",
                f.line_of("direction"), "x or y, of the machine");
      within(f, "frequency_hz", mode.frequency_hz, range::kModeHz, " Hz");
      within(f, "damping_ratio", mode.damping_ratio, range::kDamping, ", as a fraction of the critical");
      within(f, "stiffness_n_mm", mode.stiffness_n_mm, range::kStiffnessNMm, " N/mm (1 N/um is 1000 N/mm)");
    }
    keep_sources(f, m);
    m.modes.push_back(std::move(mode));
  }
}

void read_magazine(Fields& top, Machine& m) {
  const Node* node = top.child("magazine", true);
  if (node == nullptr) return;
  Fields f = top.below("magazine", *node);
  const std::size_t before = f.fault_count();
  m.magazine_pockets = static_cast<int>(f.optional_integer("pockets").value_or(0));
  if (!f.has("pockets")) f.fault("DATA-MISSING", "'pockets' is missing", "pockets", f.line());
  m.tool_diameter_max_mm = f.number("tool_diameter_max_mm");
  m.tool_length_max_mm = f.number("tool_length_max_mm");
  m.tool_change_s = f.number("tool_change_s");
  if (f.fault_count() == before) {
    within(f, "pockets", m.magazine_pockets, range::kPockets);
    within(f, "tool_diameter_max_mm", m.tool_diameter_max_mm, range::kMagazineMm);
    within(f, "tool_length_max_mm", m.tool_length_max_mm, range::kMagazineMm);
    within(f, "tool_change_s", m.tool_change_s, range::kToolChangeS);
  }
  keep_sources(f, m);
}

void read_coolant(Fields& top, Machine& m) {
  const Node* node = top.child("coolant", true);
  if (node == nullptr) return;
  Fields f = top.below("coolant", *node);
  m.has_flood = f.flag_or("flood", false);
  m.has_mist = f.flag_or("mist", false);
  m.has_through = f.flag_or("through", false);
  keep_sources(f, m);
}

/// What this machine's control does in its own way: the options that controls of its kind have.
void read_control_options(Fields& f, Machine& m) {
  for (const model::ControlOptionRow& row : model::kControlOptions) {
    if (model::default_of(row, m.control.dialect) == "-" || !f.has(row.name)) continue;
    model::ControlOption option{std::string(row.name), f.text(row.name)};
    if (std::string wrong = model::control_option_fault(m.control.dialect, option); !wrong.empty())
      f.fault("MACHINE-CONTROL", std::string(row.name) + ": " + wrong, row.name, f.line_of(row.name),
              std::string(row.meaning));
    if (!m.control_options) m.control_options.emplace();
    m.control_options->chosen.push_back(std::move(option));
  }
}

void read_control(Fields& top, Machine& m) {
  const Node* node = top.child("control", true);
  if (node == nullptr) return;
  Fields f = top.below("control", *node);
  m.control.dialect = f.text("dialect");
  m.control.decimals = static_cast<int>(f.optional_integer("decimals").value_or(m.control.decimals));
  m.control.feed_decimals =
      static_cast<int>(f.optional_integer("feed_decimals").value_or(m.control.feed_decimals));
  m.control.path_tolerance_mm = f.number("path_tolerance_mm");
  m.control.block_time_s = f.number("block_time_s");
  within(f, "decimals", m.control.decimals, range::kDecimals);
  within(f, "feed_decimals", m.control.feed_decimals, range::kDecimals);
  if (f.has("length_offsets")) {
    const std::string from = f.text("length_offsets");
    if (from != "gage_line" && from != "reference")
      f.fault("DATA-UNKNOWN", "length offsets count from '" + from + "'", "length_offsets",
              f.line_of("length_offsets"), "gage_line or reference");
    m.control.offsets_against_reference = from == "reference";
  }
  within(f, "path_tolerance_mm", m.control.path_tolerance_mm, range::kPathToleranceMm);
  within(f, "block_time_s", m.control.block_time_s, range::kBlockTimeS);
  read_control_options(f, m);
  keep_sources(f, m);
}

}  // namespace

std::vector<std::string> shipped_machines() {
  constexpr std::string_view kFolder = "machines/", kEnding = ".yaml";
  std::vector<std::string> out;
  for (std::string_view name : embedded_names()) {
    if (!name.starts_with(kFolder) || !name.ends_with(kEnding)) continue;
    name.remove_prefix(kFolder.size());
    name.remove_suffix(kEnding.size());
    out.emplace_back(name);
  }
  std::sort(out.begin(), out.end());
  return out;
}

namespace {

Result<Machine> machine_in(const Node& root, const std::string& file, Job& job) {
  std::vector<Diagnostic> faults;
  Fields top(root, file, "", "", faults);
  Machine m;
  if (top.text("capstan_machine") != "1")
    top.fault("DATA-VERSION", "not a machine of version 1", "capstan_machine", 1, "capstan_machine: 1");
  m.id = top.text("id");
  m.description = top.text_or("description", m.id);
  m.cost_per_hour = top.number("cost_per_hour");
  if (top.has("cost_per_hour")) within(top, "cost_per_hour", m.cost_per_hour, range::kCost);
  for (const auto& [path, source] : top.sources()) {
    if (path != "cost_per_hour") continue;
    if (source.empty()) top.fault("DATA-SOURCE", "no source is stated", path, top.line_of(path));
    m.sources.emplace_back(path, source);
  }
  read_axes(top, m);
  read_spindle(top, m);
  read_magazine(top, m);
  read_coolant(top, m);
  read_control(top, m);
  read_abilities(top, m);
  read_modes(top, m);
  top.finish();
  if (auto d = tell(std::move(faults), job)) return fail(std::move(*d));
  return m;
}

}  // namespace

Result<Machine> read_machine(std::string_view text, const std::string& file, Job& job) {
  const auto root = parse_tree(text, file);
  if (!root) return fail(root.error());
  return machine_in(*root, file, job);
}

Result<Machine> in_gear(Machine m, std::string_view id) {
  std::string names;
  for (const auto& g : m.spindle.gears) {
    if (g.id == id) {
      const model::SpindleGear gear = g;
      put_in_gear(m, gear);
      return m;
    }
    names += (names.empty() ? "" : ", ") + g.id;
  }
  return fail({.code = "MACHINE-GEAR",
               .message = "the machine '" + m.id + "' has no gear '" + std::string(id) + "'",
               .expected = names.empty() ? "no gear: it has one only" : "one of: " + names});
}

namespace {

Result<Machine> load_plain(const std::string& path, Job& job) {
  const auto shipped = shipped_machines();
  if (std::find(shipped.begin(), shipped.end(), path) != shipped.end()) {
    const std::string name = "machines/" + path + ".yaml";
    const auto root = shipped_tree(name);
    if (!root) return fail(root.error());
    return machine_in(*root, name, job);
  }
  auto text = read_file(path, kDataFileCap);
  if (!text) {
    if (only_a_name(path)) return fail(unknown_name("machine", path, shipped, "capstan machines list"));
    Diagnostic d = text.error();
    std::string names;
    for (const std::string& s : shipped) names += (names.empty() ? "" : ", ") + s;
    d.hint = "a machine file, or one of: " + names;
    return fail(std::move(d));
  }
  const auto first = text->find_first_not_of(" \t\r\n");
  const bool ini =
      path.ends_with(".ini") || (text->find("[TRAJ]") != std::string::npos && first != std::string::npos);
  return ini ? read_linuxcnc_ini(*text, path, job) : read_machine(*text, path, job);
}

}  // namespace

Result<Machine> load_machine(const std::string& path, Job& job) {
  // "name:gear"; a file whose name holds a colon is meant as it is.
  const auto colon = path.rfind(':');
  std::error_code ignored;
  if (colon == std::string::npos || colon == 0 || std::filesystem::exists(path, ignored))
    return load_plain(path, job);
  auto m = load_plain(path.substr(0, colon), job);
  if (!m) return m;
  return in_gear(*std::move(m), path.substr(colon + 1));
}

}  // namespace capstan::tooling

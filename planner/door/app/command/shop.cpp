#include <algorithm>
#include <filesystem>
#include <numbers>

#include "planner/controls/controls.h"
#include "planner/door/app/command/session.h"
#include "planner/door/service/explain/values.h"
#include "planner/door/service/shop.h"
#include "planner/ground/base/nearest_names.h"
#include "planner/ground/base/number.h"
#include "rules/rules.h"
#include "tooling/library/cutters/generic.h"
#include "tooling/library/library.h"
#include "tooling/shop/fixtures/fixtures.h"
#include "tooling/shop/machine/machine.h"

// The tool library and the rule tables.

namespace capstan::app {

using service::table;

namespace {

using Rows = std::vector<std::vector<std::string>>;

std::string n(double v) { return trimmed(v, 4); }

/// The cutters whose id or class contains the filter, a line each; empty: there is none.
std::string list_text(const std::vector<model::Cutter>& library, const std::string& filter) {
  Rows rows = {{"id", "class", "D", "R", "flutes", "reach", "teeth", "T"}};
  for (const auto& c : library) {
    const std::string kind(model::to_text(c.cutter_class));
    if (!filter.empty() && c.id.find(filter) == std::string::npos && kind.find(filter) == std::string::npos)
      continue;
    rows.push_back({c.id, kind, n(c.cutting_diameter_mm), n(c.corner_radius_mm), n(c.maximum_depth_of_cut_mm),
                    n(c.usable_length_mm), std::to_string(c.teeth),
                    c.pocket > 0 ? std::to_string(c.pocket) : std::string("-")});
  }
  return rows.size() == 1 ? std::string() : table(rows, "");
}

std::string cutter_page(const model::Cutter& c) {
  Rows rows;
  const auto number = [&](const char* name, double v, const char* unit) {
    if (v != 0.0) rows.push_back({name, n(v) + unit});
  };
  const auto angle = [&](const char* name, double v) { number(name, v * 180.0 / std::numbers::pi, " deg"); };
  rows.push_back({"class", std::string(model::to_text(c.cutter_class))});
  rows.push_back({"substrate", std::string(model::to_text(c.substrate))});
  number("cutting_diameter", c.cutting_diameter_mm, " mm");
  number("adjustable_to", c.adjustable_to_mm, " mm");
  number("corner_radius", c.corner_radius_mm, " mm");
  angle("point_angle", c.point_angle_rad);
  number("tip_diameter", c.tip_diameter_mm, " mm");
  number("maximum_depth_of_cut", c.maximum_depth_of_cut_mm, " mm");
  number("usable_length", c.usable_length_mm, " mm");
  number("stick_out", c.stick_out_mm, " mm");
  number("functional_length", c.functional_length_mm, " mm");
  number("shank_diameter", c.shank_diameter_mm, " mm");
  number("holder_diameter", c.holder_diameter_mm, " mm");
  number("teeth", c.teeth, "");
  angle("helix", c.helix_rad);
  angle("lead_angle", c.lead_angle_rad);
  number("thread_pitch", c.thread_pitch_mm, " mm");
  rows.push_back({"centre_cutting", c.centre_cutting ? "yes" : "no"});
  angle("maximum_ramp_angle", c.maximum_ramp_angle_rad);
  rows.push_back({"hand", c.hand == model::Hand::kLeft ? "left" : "right"});
  rows.push_back({"coolant_through", c.coolant_through ? "yes" : "no"});
  number("maximum_speed", c.maximum_speed_rpm, " 1/min");
  number("fz_min", c.fz_min_mm, " mm");
  number("fz_max", c.fz_max_mm, " mm");
  number("pocket", c.pocket, "");
  std::string out = c.id + (c.description.empty() ? "" : ": " + c.description) + "\n" + table(rows);
  Rows presets;
  for (const auto& p : c.presets)
    presets.push_back({p.material_group.text(), "vc " + n(p.vc_m_min) + " m/min", "fz " + n(p.fz_mm) + " mm",
                       p.source.text()});
  if (!presets.empty()) out += "start values\n" + table(presets);
  Rows sources;
  for (const auto& [field, source] : c.sources) sources.push_back({field, source});
  if (!sources.empty()) out += "sources\n" + table(sources);
  return out;
}

std::vector<std::string> machine_known(const model::Machine& m, const std::string& id) {
  std::string travel;
  for (const auto& a : m.axes) travel += (travel.empty() ? "" : " x ") + n(a.travel_max_mm - a.travel_min_mm);
  double power = 0.0;
  for (const auto& p : m.spindle.curve) power = std::max(power, p.power_w);
  std::string gears;
  for (const auto& g : m.spindle.gears)
    gears += (gears.empty() ? "gears " : ", ") + std::string(g.id.empty() ? "?" : id + ":" + g.id);
  return {id, travel + " mm", "to " + n(m.spindle.rpm_max) + " 1/min", n(power) + " W", gears};
}

std::string conclusion_of(const rules::Row& row) {
  if (!row.cannot.empty()) return "cannot: " + row.cannot;
  std::string out;
  for (const auto& chain : row.chains) {
    if (!out.empty()) out += " | ";
    for (std::size_t i = 0; i < chain.size(); ++i) out += (i != 0 ? " > " : "") + chain[i].action;
  }
  for (const auto& [name, value] : row.values) out += (out.empty() ? "" : ", ") + name + " = " + n(value);
  return out;
}

std::string rules_text(const rules::RuleBase& base) {
  std::string out;
  for (const auto& t : base.tables) {
    out += t.name + " (" + std::to_string(t.rows.size()) + " rows)\n";
    for (const auto& row : t.rows) {
      const std::string when = rules::to_text(row.when, t.facts);
      out += "  " + row.id + " (priority " + std::to_string(row.priority) + ", " + row.file + ":" +
             std::to_string(row.line) + ")\n    when    " + (when.empty() ? "always" : when) +
             "\n    then    " + conclusion_of(row) + "\n";
      if (!row.text.empty()) out += "    because " + row.text + "\n";
      if (!row.source.empty()) out += "    source  " + row.source + "\n";
    }
  }
  return out;
}

/// A filter that no cutter fits may have been meant for a library.
Diagnostic no_such_cutter(const std::string& filter) {
  std::error_code error;
  const bool file = std::filesystem::exists(filter, error);
  return {.code = "TOOLS-NONE",
          .message = filter.empty() ? "there is no cutter in the library"
                                    : "no cutter of the library has '" + filter + "' in its id or class",
          .hint = file ? "name a library's file by its option: capstan tools list --tools " + filter
                       : "`capstan tools list` shows all"};
}

}  // namespace

int run_tools(Session& s) {
  const auto library =
      tooling::load_library(s.options.inputs.tools.value_or(std::string(tooling::kGeneric)), s.job);
  if (!library) return s.end(library.error(), kUnreadable);
  const std::string word = s.options.words.empty() ? "" : s.options.words.front();
  if (s.options.command == Command::kToolsList) {
    const std::string text = list_text(*library, word);
    if (text.empty()) return s.end(no_such_cutter(word), kUsage);
    return print(text) ? kDone : kImpossible;
  }
  for (const auto& c : *library) {
    if (c.id == word) return print(cutter_page(c)) ? kDone : kImpossible;
  }
  std::vector<std::string> ids;
  for (const auto& c : *library) ids.push_back(c.id);
  return s.end(unknown_name("cutter", word, ids, "capstan tools list"), kUsage);
}

int run_known(Session& s) {
  Rows rows;
  if (s.options.command == Command::kMachinesList) {
    for (const std::string& id : tooling::shipped_machines()) {
      const auto m = tooling::load_machine(id, s.job);
      if (!m) return s.end(m.error(), kUnreadable);
      rows.push_back(machine_known(*m, id));
    }
  } else if (s.options.command == Command::kControlsList) {
    for (const controls::Dialect* d : controls::dialects())
      rows.push_back({std::string(d->id), std::string(d->name), std::string(d->program.ending)});
  } else {
    auto own = service::own_fixtures(s.options.inputs.fixtures, s.job);
    if (!own) return s.end(own.error(), kUnreadable);
    const auto fixtures = tooling::known_fixtures(*std::move(own), s.job);
    if (!fixtures) return s.end(fixtures.error(), kUnreadable);
    for (const auto& f : *fixtures) rows.push_back({f.id, f.description});
  }
  const std::string word = s.options.words.empty() ? "" : s.options.words.front();
  std::erase_if(rows, [&](const auto& row) {
    return std::none_of(row.begin(), row.end(),
                        [&](const auto& cell) { return cell.find(word) != std::string::npos; });
  });
  return print(table(rows, "")) ? kDone : kImpossible;
}

int run_rules(Session& s) {
  const auto base = rules::load_rules(s.options.inputs.rules.value_or(""), s.job);
  if (!base) return s.end(base.error(), kUnreadable);
  if (s.options.command == Command::kRulesList) return print(rules_text(*base)) ? kDone : kImpossible;
  const auto findings = rules::check(*base);
  for (const auto& f : findings) {
    s.job.report({.code = std::string(rules::code_of(f.fault)),
                  .severity = Severity::kWarning,
                  .message = f.text(),
                  .file = f.file,
                  .line = f.line});
  }
  std::size_t rows = 0;
  for (const auto& t : base->tables) rows += t.rows.size();
  s.summary = "checked " + counted(base->tables.size(), "table", "tables") + " with " +
              counted(rows, "row", "rows") + ": " + counted(findings.size(), "finding", "findings");
  return findings.empty() ? kDone : kFindings;
}

}  // namespace capstan::app

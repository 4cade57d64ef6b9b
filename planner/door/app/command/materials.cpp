#include <algorithm>

#include "planner/door/app/command/session.h"
#include "planner/door/service/explain/values.h"
#include "planner/ground/base/number.h"
#include "tooling/shop/material/iso_groups.h"
#include "tooling/shop/material/material.h"
#include "tooling/shop/material/material_table.h"

// The work materials: a short list by group, and all that is known of one.

namespace capstan::app {

using service::table;

namespace {

using model::WorkMaterial;
using Rows = std::vector<std::vector<std::string>>;

constexpr std::size_t kNamesShown = 3;

std::string n(double v) { return trimmed(v, 4); }

std::string speed(double v) { return v > 0.0 ? n(v) : std::string("-"); }

bool has(const WorkMaterial& m, const std::string& word) {
  if (word.empty() || m.id.find(word) != std::string::npos || word == m.iso_group) return true;
  return std::any_of(m.names.begin(), m.names.end(),
                     [&](const std::string& name) { return name.find(word) != std::string::npos; });
}

std::string first_names(const WorkMaterial& m, const std::string& word) {
  // Matches of the word come first.
  std::vector<std::string> names = m.names;
  if (!word.empty())
    std::stable_partition(names.begin(), names.end(),
                          [&](const std::string& name) { return name.find(word) != std::string::npos; });
  std::string out;
  for (std::size_t i = 0; i < std::min(names.size(), kNamesShown); ++i)
    out += (i == 0 ? "" : ", ") + names[i];
  if (names.size() > kNamesShown) out += ", +" + std::to_string(names.size() - kNamesShown);
  return out;
}

std::string list_text(const std::vector<WorkMaterial>& materials, const std::string& word) {
  Rows rows;
  for (const tooling::IsoGroup& g : tooling::kIsoGroups) {
    const std::size_t before = rows.size();
    for (const WorkMaterial& m : materials) {
      if (m.iso_group != g.letter || !has(m, word)) continue;
      if (rows.size() == before)
        rows.push_back(
            {"ISO 513 " + m.iso_group, "kc1.1", "mc", "HSS", "carbide", "HB", std::string(g.words)});
      rows.push_back({"  " + m.id, n(m.kc11_n_mm2), n(m.mc), speed(m.vc_hss_m_min), speed(m.vc_carbide_m_min),
                      m.hardness_hb > 0.0 ? n(m.hardness_hb) : std::string("-"), first_names(m, word)});
    }
  }
  return table(rows, "");
}

std::string source_of(const WorkMaterial& m, std::string_view field) {
  const std::string* source = tooling::source_of(m, field);
  return source == nullptr ? std::string() : *source;
}

std::string page_of(const WorkMaterial& m, const std::vector<std::string>& harder) {
  Rows rows;
  const auto value = [&](const char* name, const char* field, double v, const char* unit) {
    if (v != 0.0) rows.push_back({name, n(v) + unit, source_of(m, field)});
  };
  rows.push_back({"group", "ISO 513 " + m.iso_group, ""});
  value("kc1.1", "kc11_n_mm2", m.kc11_n_mm2, " N/mm2");
  value("mc", "mc", m.mc, "");
  value("uncertainty of kc", "kc_uncertainty", m.kc_uncertainty, "");
  value("hardness", "hardness_hb", m.hardness_hb, " HB");
  value("tensile strength", "tensile_strength_n_mm2", m.tensile_strength_n_mm2, " N/mm2");
  const auto start = [&](const char* name, const char* field, double v) {
    rows.push_back({name, v > 0.0 ? n(v) + " m/min" : std::string("none"), source_of(m, field)});
  };
  start("speed, HSS", "vc_hss_m_min", m.vc_hss_m_min);
  start("speed, carbide", "vc_carbide_m_min", m.vc_carbide_m_min);
  for (const auto& set : m.mechanistic)
    rows.push_back(
        {"measured, " + set.substrate,
         "Ktc " + n(set.ktc_n_mm2) + ", Krc " + n(set.krc_n_mm2) + ", Kac " + n(set.kac_n_mm2) + " N/mm2",
         set.source});
  for (const auto& law : m.life)
    rows.push_back(
        {"life, " + law.substrate, n(law.life_min) + " min at " + n(law.v0_m_min) + " m/min", law.source});
  for (const std::string& id : harder) rows.push_back({"where it is harder", id, ""});
  std::string out = m.id + "\n" + table(rows);
  // Groups names by source.
  Rows names;
  for (const std::string& name : m.names) {
    const std::string source = source_of(m, "name " + name);
    const auto it = std::find_if(names.begin(), names.end(), [&](const auto& r) { return r[1] == source; });
    if (it == names.end())
      names.push_back({name, source});
    else
      it->front() += ", " + name;
  }
  if (names.empty()) return out;
  out += "names\n";
  for (const auto& row : names) out += "  " + row[0] + "\n    " + row[1] + "\n";
  return out;
}

}  // namespace

int run_materials(Session& s) {
  const auto materials = tooling::shipped_materials();
  if (!materials) return s.end(materials.error(), kUnreadable);
  const std::string word = s.options.words.empty() ? "" : s.options.words.front();
  return print(list_text(*materials, word)) ? kDone : kImpossible;
}

int run_material(Session& s) {
  const auto& shipped = tooling::shipped_material_table();
  if (!shipped) return s.end(shipped.error(), kUnreadable);
  const std::string& name = s.options.words.front();
  if (tooling::names_a_material_file(name)) {
    const auto own = tooling::load_material(name, shipped->materials, s.job);
    if (!own) return s.end(own.error(), kUnreadable);
    return print(page_of(*own, {})) ? kDone : kImpossible;
  }
  const auto found = tooling::find_material({name}, shipped->materials, s.job, tooling::Families::kRefused);
  if (!found) return s.end(found.error(), kUsage);
  // Shows the card unchanged: the sets of all its alloys.
  for (const WorkMaterial& m : shipped->materials) {
    if (m.id != found->id) continue;
    const auto harder = shipped->harder.find(m.id);
    return print(page_of(m, harder == shipped->harder.end() ? std::vector<std::string>{} : harder->second))
               ? kDone
               : kImpossible;
  }
  return print(page_of(*found, {})) ? kDone : kImpossible;
}

}  // namespace capstan::app

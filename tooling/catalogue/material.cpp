#include "tooling/catalogue/material.h"

#include <algorithm>
#include <array>

#include "planner/ground/base/nearest_names.h"
#include "planner/ground/base/number.h"
#include "planner/model/plan/cutter.h"
#include "planner/model/plan/ranges.h"
#include "tooling/catalogue/data.h"
#include "tooling/catalogue/tree.h"

namespace capstan::tooling {
namespace {

using model::WorkMaterial;
namespace range = model::range;

constexpr const char* kFile = "materials.yaml";
constexpr const char* kListMaterials = "capstan materials list";
/// Shorter names must match as a whole: "O1" must not claim "O1-tool".
constexpr std::size_t kLeastPrefix = 4;

struct Family {
  std::vector<std::string> words;
  std::string material, source;
};
struct Table {
  std::vector<WorkMaterial> materials;
  std::vector<Family> families;
  Family unnamed;
};

/// Upper case, letters and digits only: "EN AW-6061" and "ENAW6061" are one name.
std::string plain(std::string_view text) {
  std::string out;
  for (const char c : text) {
    if (c >= 'a' && c <= 'z') out += static_cast<char>(c - 'a' + 'A');
    if ((c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9')) out += c;
  }
  return out;
}

void check(double value, const model::Range& range, std::string_view key, Fields& f) {
  if (range.holds(value)) return;
  f.fault("MATERIAL-RANGE", model::value_text(value) + " is no value of a material", key, f.line_of(key),
          to_text(range));
}

std::vector<std::string> words_of(const Node& n) {
  std::vector<std::string> out;
  if (n.kind == Node::Kind::kScalar) out.push_back(n.text);
  for (const Node& item : n.items)
    if (item.kind == Node::Kind::kScalar) out.push_back(item.text);
  return out;
}

void read_names(Fields& f, WorkMaterial& m) {
  const Node* names = f.child("names", false);
  if (names == nullptr) return;
  for (const Node& row : names->items) {
    Fields r = f.below("names", row);
    if (const Node* name = r.child("name", true)) {
      for (std::string& word : words_of(*name)) {
        m.sources.emplace_back("name " + word, r.source());
        m.names.push_back(std::move(word));
      }
    }
    r.finish();
  }
}

/// The substrate of a measured set or a life law, checked.
std::string read_substrate(Fields& f) {
  std::string out = f.text("substrate");
  if (!out.empty() && !model::substrate_from_text(out))
    f.fault("MATERIAL-SUBSTRATE", "'" + out + "' is no substrate of a tool", "substrate",
            f.line_of("substrate"), "hss or carbide");
  return out;
}

/// Where each set's alloys are kept until a name is looked up: "set 0 for 6061".
std::string set_key(std::size_t set) { return "set " + std::to_string(set) + " for "; }

void read_sets(Fields& f, WorkMaterial& m) {
  const Node* rows = f.child("mechanistic", false);
  if (rows == nullptr) return;
  for (const Node& row : rows->items) {
    Fields r = f.below("mechanistic", row);
    const std::size_t before = r.fault_count();
    model::MechanisticSet set;
    set.substrate = read_substrate(r);
    set.ktc_n_mm2 = r.number("ktc_n_mm2");
    set.kte_n_mm = r.number_or("kte_n_mm", 0.0);
    set.krc_n_mm2 = r.number("krc_n_mm2");
    set.kre_n_mm = r.number_or("kre_n_mm", 0.0);
    set.kac_n_mm2 = r.number_or("kac_n_mm2", 0.0);
    set.kae_n_mm = r.number_or("kae_n_mm", 0.0);
    set.uncertainty = r.number("uncertainty");
    set.source = r.source();
    if (set.source.empty()) r.fault("DATA-SOURCE", "no source is stated", "mechanistic", r.line());
    if (r.fault_count() == before) {
      check(set.ktc_n_mm2, range::kKtcNMm2, "ktc_n_mm2", r);
      check(set.krc_n_mm2, range::kKrcNMm2, "krc_n_mm2", r);
      check(set.kac_n_mm2, range::kKrcNMm2, "kac_n_mm2", r);
      check(set.kte_n_mm, range::kEdgeNMm, "kte_n_mm", r);
      check(set.kre_n_mm, range::kEdgeNMm, "kre_n_mm", r);
      check(set.kae_n_mm, range::kEdgeNMm, "kae_n_mm", r);
      check(set.uncertainty, range::kSetUncertainty, "uncertainty", r);
    }
    if (const Node* alloys = r.child("for", false))
      for (const std::string& name : words_of(*alloys))
        m.sources.emplace_back(set_key(m.mechanistic.size()) + name, set.source);
    m.mechanistic.push_back(std::move(set));
    r.finish();
  }
}

void read_life(Fields& f, WorkMaterial& m) {
  const Node* rows = f.child("life", false);
  if (rows == nullptr) return;
  for (const Node& row : rows->items) {
    Fields r = f.below("life", row);
    const std::size_t before = r.fault_count();
    model::ToolLifeLaw law;
    law.substrate = read_substrate(r);
    law.v0_m_min = r.number("v0_m_min");
    law.life_min = r.number("life_min");
    law.n = r.number("n");
    law.h0_mm = r.number_or("h0_mm", 0.0);
    law.p = r.number_or("p", 0.0);
    law.a0_mm = r.number_or("a0_mm", 0.0);
    law.q = r.number_or("q", 0.0);
    law.scatter = r.number_or("scatter", 0.0);
    law.source = r.source();
    if (law.source.empty()) r.fault("DATA-SOURCE", "no source is stated", "life", r.line());
    if (r.fault_count() == before) {
      check(law.v0_m_min, range::kLifeSpeedMMin, "v0_m_min", r);
      check(law.life_min, range::kLifeMin, "life_min", r);
      check(law.n, range::kTaylorN, "n", r);
      check(law.scatter, range::kLifeScatter, "scatter", r);
      check(law.p, range::kTaylorPq, "p", r);
      check(law.q, range::kTaylorPq, "q", r);
      if (law.p > 0.0) check(law.h0_mm, range::kLifeChipMm, "h0_mm", r);
      if (law.q > 0.0) check(law.a0_mm, range::kLifeDepthMm, "a0_mm", r);
    }
    m.life.push_back(std::move(law));
    r.finish();
  }
}

WorkMaterial read_material(Fields f, double uncertainty, const std::string& uncertainty_source) {
  WorkMaterial m;
  m.id = f.text("id");
  m.iso_group = f.text("iso_group");
  m.kc11_n_mm2 = f.number("kc11_n_mm2");
  m.mc = f.number("mc");
  m.vc_hss_m_min = f.number("vc_hss_m_min");
  m.vc_carbide_m_min = f.number("vc_carbide_m_min");
  m.tensile_strength_n_mm2 = f.number_or("tensile_strength_n_mm2", 0.0);
  m.hardness_hb = f.number_or("hardness_hb", 0.0);
  m.kc_uncertainty = f.number_or("kc_uncertainty", uncertainty);
  for (const auto& [path, source] : f.sources()) {
    if (source.empty()) f.fault("DATA-SOURCE", "no source is stated", path, f.line());
    const std::string key = path.substr(path.rfind('.') + 1);
    if (key != "id" && key != "iso_group") m.sources.emplace_back(key, source);
  }
  if (!f.has("kc_uncertainty")) m.sources.emplace_back("kc_uncertainty", uncertainty_source);
  check(m.kc11_n_mm2, range::kKc11NMm2, "kc11_n_mm2", f);
  check(m.mc, range::kMc, "mc", f);
  check(m.vc_hss_m_min, range::kVcHssMMin, "vc_hss_m_min", f);
  check(m.vc_carbide_m_min, range::kVcCarbideMMin, "vc_carbide_m_min", f);
  check(m.kc_uncertainty, range::kKcUncertainty, "kc_uncertainty", f);
  check(m.tensile_strength_n_mm2, range::kStrengthNMm2, "tensile_strength_n_mm2", f);
  check(m.hardness_hb, range::kHardnessHb, "hardness_hb", f);
  if (m.iso_group.size() != 1 || std::string_view("PMKNSH").find(m.iso_group) == std::string_view::npos)
    f.fault("MATERIAL-GROUP", "'" + m.iso_group + "' is no group of ISO 513", "iso_group",
            f.line_of("iso_group"), "P, M, K, N, S or H");
  read_names(f, m);
  read_sets(f, m);
  read_life(f, m);
  f.finish();
  return m;
}

Family read_family(Fields f) {
  Family out;
  if (const Node* words = f.child("words", false))
    for (const std::string& w : words_of(*words)) out.words.push_back(plain(w));
  out.material = f.text("material");
  out.source = f.source();
  f.finish();
  return out;
}

Result<Table> read_table(std::string_view text, const std::string& file, Job& job) {
  auto root = parse_tree(text, file);
  if (!root) return fail(root.error());
  std::vector<Diagnostic> faults;
  Fields top(*root, file, "", "", faults);
  Table out;
  if (top.text("capstan_materials") != "1")
    top.fault("DATA-VERSION", "not a material table of version 1", "capstan_materials", 1);
  const double uncertainty = top.number("kc_uncertainty");
  const std::string uncertainty_source = top.sources().empty() ? "" : top.sources().back().second;
  if (const Node* rows = top.child("materials", true))
    for (const Node& row : rows->items)
      out.materials.push_back(read_material(top.below("materials", row), uncertainty, uncertainty_source));
  if (const Node* rows = top.child("families", false))
    for (const Node& row : rows->items) out.families.push_back(read_family(top.below("families", row)));
  if (const Node* row = top.child("unnamed", false)) out.unnamed = read_family(top.below("unnamed", *row));
  top.finish();
  for (std::size_t i = 0; i < out.materials.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      if (out.materials[i].id == out.materials[j].id)
        top.fault("DATA-DUPLICATE", "material '" + out.materials[i].id + "' is given twice", "materials", 1);
  if (auto d = tell(std::move(faults), job)) return fail(std::move(*d));
  return out;
}

/// A family's word where a material has to be named: with the names that have the word, else the nearest.
Diagnostic only_a_family(const std::string& text, const Family& family,
                         const std::vector<WorkMaterial>& materials) {
  constexpr std::size_t kShown = 6;  // default, unsourced
  std::string names;
  std::size_t shown = 0;
  for (const WorkMaterial& m : materials) {
    const bool of_it = m.id == family.material ||
                       std::any_of(family.words.begin(), family.words.end(), [&](const std::string& word) {
                         return plain(m.id).find(word) != std::string::npos;
                       });
    if (!of_it || shown == kShown) continue;
    names += (shown++ == 0 ? "'" : ", '") + m.id + "'";
  }
  Diagnostic d = unknown_name("material", text, names_of(materials), kListMaterials);
  d.message = "'" + text + "' names a family of materials, not a material";
  d.expected = names;
  return d;
}

const WorkMaterial* by_id(const std::vector<WorkMaterial>& materials, const std::string& id) {
  for (const WorkMaterial& m : materials)
    if (m.id == id) return &m;
  return nullptr;
}

struct Match {
  const WorkMaterial* material = nullptr;
  std::string name, source;
};

Match exact(const std::string& wanted, const std::vector<WorkMaterial>& materials) {
  for (const WorkMaterial& m : materials) {
    if (plain(m.id) == wanted) return {&m, m.id, "its id"};
    for (const std::string& name : m.names) {
      if (plain(name) != wanted) continue;
      const auto it = std::find_if(m.sources.begin(), m.sources.end(),
                                   [&](const auto& s) { return s.first == "name " + name; });
      return {&m, name, it == m.sources.end() ? "" : it->second};
    }
  }
  return {};
}

/// The longest known name that the wanted one begins with; what follows may not go on as a number
/// ("ST-50" must not claim "ST-500").
Match longest_prefix(const std::string& wanted, const std::vector<WorkMaterial>& materials) {
  for (std::size_t n = wanted.size(); n-- > kLeastPrefix;) {
    const bool digits = wanted[n - 1] >= '0' && wanted[n - 1] <= '9' && wanted[n] >= '0' && wanted[n] <= '9';
    if (digits) continue;
    if (Match m = exact(wanted.substr(0, n), materials); m.material != nullptr) return m;
  }
  return {};
}

/// A family's word is in the text: long ones anywhere, short ones only as a word of their own.
bool says(const std::string& text, const std::string& word) {
  if (word.size() >= 5) return plain(text).find(word) != std::string::npos;
  std::string token;
  for (const char c : text + " ") {
    const std::string p = plain(std::string_view(&c, 1));
    token += p;
    if (!p.empty()) continue;
    if (token == word) return true;
    token.clear();
  }
  return false;
}

/// The material with those measured sets that are of the alloy meant: a set that names its alloys holds for
/// them alone, and is dropped when only the family is known.
WorkMaterial chosen(const WorkMaterial& m, const std::string& alloy, std::string why) {
  WorkMaterial out = m;
  out.mechanistic.clear();
  std::erase_if(out.sources, [](const auto& s) { return s.first.starts_with("set "); });
  for (std::size_t i = 0; i < m.mechanistic.size(); ++i) {
    const std::string key = set_key(i);
    bool named = false;
    bool meant = false;
    for (const auto& [path, source] : m.sources) {
      if (!path.starts_with(key)) continue;
      named = true;
      meant = meant || plain(path.substr(key.size())) == plain(alloy);
    }
    if (!named || meant) out.mechanistic.push_back(m.mechanistic[i]);
  }
  out.sources.emplace_back("chosen", std::move(why));
  return out;
}

const WorkMaterial& hardest(const std::vector<WorkMaterial>& materials) {
  return *std::max_element(materials.begin(), materials.end(),
                           [](const auto& a, const auto& b) { return a.kc11_n_mm2 < b.kc11_n_mm2; });
}

}  // namespace

Result<std::vector<WorkMaterial>> read_materials(std::string_view text, const std::string& file, Job& job) {
  auto table = read_table(text, file, job);
  if (!table) return fail(table.error());
  return std::move(table->materials);
}

Result<std::vector<WorkMaterial>> shipped_materials() {
  Job job;
  return read_materials(shipped_text(kFile), kFile, job);
}

std::vector<std::string> names_of(const std::vector<WorkMaterial>& materials) {
  std::vector<std::string> out;
  for (const WorkMaterial& m : materials) {
    out.push_back(m.id);
    out.insert(out.end(), m.names.begin(), m.names.end());
  }
  return out;
}

Result<WorkMaterial> find_material(const std::vector<std::string>& texts,
                                   const std::vector<WorkMaterial>& materials, Job& job, Families families) {
  if (materials.empty()) return fail("MATERIAL-NONE", "the material table is empty");
  using Search = Match (*)(const std::string&, const std::vector<WorkMaterial>&);
  for (const Search search : std::array<Search, 2>{exact, longest_prefix}) {
    for (const std::string& text : texts) {
      const Match m = search(plain(text), materials);
      if (m.material == nullptr) continue;
      return chosen(*m.material, m.name, "'" + text + "' is " + m.name + ": " + m.source);
    }
  }
  auto table = read_table(shipped_text(kFile), kFile, job);
  if (!table) return fail(table.error());
  for (const std::string& text : texts) {
    const Family* best = nullptr;
    std::size_t longest = 0;
    for (const Family& f : table->families)
      for (const std::string& w : f.words)
        if (w.size() > longest && says(text, w)) {
          best = &f;
          longest = w.size();
        }
    if (best == nullptr) continue;
    const WorkMaterial* m = by_id(materials, best->material);
    if (m == nullptr) continue;
    if (families == Families::kRefused) return fail(only_a_family(text, *best, materials));
    job.warn("MATERIAL-FAMILY", "the material '" + text + "' names only a family; forces and speeds are " +
                                    "calculated for " + m->id + ", " + best->source +
                                    "; name the material with --material");
    return chosen(*m, {}, "'" + text + "': " + best->source);
  }
  const auto named =
      std::find_if(texts.begin(), texts.end(), [](const auto& t) { return !plain(t).empty(); });
  if (named != texts.end())
    return fail(unknown_name("material", *named, names_of(materials), kListMaterials));
  const WorkMaterial* m = by_id(materials, table->unnamed.material);
  if (m == nullptr) m = &hardest(materials);
  job.warn("MATERIAL-DEFAULT", "no material is named; planned for " + m->id +
                                   " by default (the largest cutting force): name one with --material");
  return chosen(*m, {}, table->unnamed.source);
}

Result<WorkMaterial> find_material(const std::string& text, const std::vector<WorkMaterial>& materials,
                                   Job& job) {
  return find_material(std::vector<std::string>{text}, materials, job);
}

}  // namespace capstan::tooling

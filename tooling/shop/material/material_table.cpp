#include "tooling/shop/material/material_table.h"

#include <algorithm>

#include "planner/model/plan/cutter/cutter.h"
#include "planner/model/plan/range/ranges.h"
#include "planner/model/plan/resources/by_cases.h"
#include "tooling/shop/data/data.h"
#include "tooling/shop/data/tree.h"
#include "tooling/shop/material/iso_groups.h"
#include "tooling/shop/material/material.h"

// A table is read row by row; every fault is reported. Sources stay as written until the whole table is
// read: then each @name becomes the citation of that name, so that the file states a citation once and
// the plan has it whole.

namespace capstan::tooling {
namespace {

using model::WorkMaterial;
namespace range = model::range;

constexpr const char* kFile = "materials.yaml";
/// A source comes again with every value that it speaks for, and a citation wherever it is meant: unbounded,
/// a small file would fill the memory. The shipped table's longest has 214 bytes, its values are some 3000.
constexpr std::size_t kLongestSource = 1000;  // bytes; default, unsourced
constexpr std::size_t kMostValues = 20'000;   // default, unsourced

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
        if (r.source().empty()) r.fault("DATA-SOURCE", "no source is stated", "name", r.line());
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

/// What planning makes of cases is left out when a part is planned anew: a table's own row may not be.
void refuse_mark(Fields& r, const char* of) {
  r.fault("DATA-SOURCE",
          "a source begins '" + std::string(model::kByCases) + "', which is how planning marks its own", of,
          r.line(), "name the source in other words");
}

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
    if (model::by_cases(set)) refuse_mark(r, "mechanistic");
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
    if (model::by_cases(law)) refuse_mark(r, "life");
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

WorkMaterial read_material(Fields f, double uncertainty, const std::string& uncertainty_source,
                           MaterialTable& table) {
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
  if (!is_iso_group(m.iso_group))
    f.fault("MATERIAL-GROUP", "'" + m.iso_group + "' is no group of ISO 513", "iso_group",
            f.line_of("iso_group"), iso_group_letters());
  read_names(f, m);
  read_sets(f, m);
  read_life(f, m);
  if (const Node* ids = f.child("harder", false)) table.harder[m.id] = words_of(*ids);
  f.finish();
  return m;
}

MaterialFamily read_family(Fields f) {
  MaterialFamily out;
  if (const Node* words = f.child("words", false))
    for (const std::string& w : words_of(*words)) out.words.push_back(plain_name(w));
  out.material = f.text("material");
  out.source = f.source();
  f.finish();
  return out;
}

constexpr std::size_t kMostFaults = 100;  // told of citations; default, unsourced

/// Whether a source is short enough; reports one that is not.
bool fits(std::size_t bytes, const std::string& begins, std::string_view key, std::uint64_t line,
          Fields& top) {
  if (bytes <= kLongestSource) return true;
  constexpr std::size_t kShown = 60;
  top.fault("DATA-SOURCE",
            "the source that begins with '" + begins.substr(0, kShown) + "' has " + std::to_string(bytes) +
                " bytes",
            key, line, "at most " + std::to_string(kLongestSource) + " bytes, its citations written out");
  return false;
}

/// How many values stand below a node; what it calls a source is held against the bound.
std::size_t count_values(const Node& node, Fields& top) {
  std::size_t out = node.kind == Node::Kind::kScalar ? 1 : 0;
  for (const Node& item : node.items) out += count_values(item, top);
  for (const auto& [name, entry] : node.entries) {
    if (name == "source") (void)fits(entry.text.size(), entry.text, "source", entry.line, top);
    out += count_values(entry, top);
  }
  return out;
}

/// What its citations are called in the table's sources.
using Citations = std::map<std::string, std::string>;

Citations read_citations(const Node& rows, Fields& top) {
  Citations out;
  for (const auto& [name, text] : rows.entries) {
    if (text.kind == Node::Kind::kScalar && !text.text.empty()) {
      if (fits(text.text.size(), text.text, "citations", text.line, top)) out[name] = text.text;
    } else
      top.fault("DATA-SOURCE", "the citation '" + name + "' says nothing", "citations", text.line);
  }
  return out;
}

bool of_name(char c) { return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '_'; }

/// "@iscar group 2" with the citation in place of its name.
void cite(std::string& source, const Citations& citations, Fields& top) {
  std::string out;
  for (std::size_t i = 0; i < source.size();) {
    if (out.size() > kLongestSource || top.fault_count() > kMostFaults) break;
    const std::size_t at = std::min(source.find('@', i), source.size());
    out.append(source, i, at - i);
    i = at;
    if (i == source.size()) break;
    std::size_t end = i + 1;
    while (end < source.size() && of_name(source[end])) ++end;
    const std::string name = source.substr(i + 1, end - i - 1);
    const auto it = citations.find(name);
    if (it == citations.end())
      top.fault("DATA-SOURCE", "'@" + name + "' is no citation of this table", "citations",
                top.line_of("citations"), "a name listed under 'citations'");
    out += it == citations.end() ? name : it->second;
    i = end;
  }
  if (fits(out.size(), out, "citations", top.line_of("citations"), top)) source = std::move(out);
}

void cite_all(MaterialTable& table, const Citations& citations, Fields& top) {
  for (WorkMaterial& m : table.materials) {
    for (auto& [field, source] : m.sources) cite(source, citations, top);
    for (auto& set : m.mechanistic) cite(set.source, citations, top);
    for (auto& law : m.life) cite(law.source, citations, top);
  }
  for (MaterialFamily& f : table.families) cite(f.source, citations, top);
  cite(table.unnamed.source, citations, top);
}

/// A name means one material; what is said to be harder is there.
void check_names(const MaterialTable& table, Fields& top) {
  std::map<std::string, std::string> owner, ids;
  for (const WorkMaterial& m : table.materials) {
    if (!ids.emplace(m.id, m.id).second)
      top.fault("DATA-DUPLICATE", "material '" + m.id + "' is given twice", "materials", 1);
    std::vector<std::string> names = m.names;
    names.insert(names.begin(), m.id);
    for (const std::string& name : names) {
      if (plain_name(name).empty())
        top.fault("DATA-KIND", "the name '" + name + "' of '" + m.id + "' has neither letters nor digits",
                  "materials", 1);
      const auto [at, fresh] = owner.emplace(plain_name(name), m.id);
      if (!fresh && at->second != m.id)
        top.fault("DATA-DUPLICATE",
                  "the name '" + name + "' is given to '" + at->second + "' and to '" + m.id + "'",
                  "materials", 1);
    }
  }
  for (const auto& [id, harder] : table.harder) {
    for (const std::string& other : harder) {
      if (ids.count(other) == 0)
        top.fault("DATA-UNKNOWN", "'" + other + "', said to be harder than '" + id + "', is no material here",
                  "harder", 1);
    }
  }
}

}  // namespace

std::string plain_name(std::string_view text) {
  std::string out;
  for (const char c : text) {
    if (c >= 'a' && c <= 'z') out += static_cast<char>(c - 'a' + 'A');
    if ((c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9')) out += c;
  }
  return out;
}

std::string set_key(std::size_t set) { return "set " + std::to_string(set) + " for "; }

namespace {

Result<MaterialTable> table_in(const Node& root, const std::string& file, Job& job) {
  std::vector<Diagnostic> faults;
  Fields top(root, file, "", "", faults);
  MaterialTable out;
  if (top.text("capstan_materials") != "1")
    top.fault("DATA-VERSION", "not a material table of version 1", "capstan_materials", 1);
  const std::size_t before = faults.size();
  if (const std::size_t values = count_values(root, top); values > kMostValues)
    top.fault("DATA-SIZE", "the table has " + std::to_string(values) + " values", "", 1,
              "at most " + std::to_string(kMostValues));
  if (faults.size() > before) return fail(*tell(std::move(faults), job));
  const double uncertainty = top.number("kc_uncertainty");
  const std::string uncertainty_source = top.sources().empty() ? "" : top.sources().back().second;
  const Node* cited = top.child("citations", false);
  const Citations citations = cited == nullptr ? Citations{} : read_citations(*cited, top);
  if (const Node* rows = top.child("materials", true))
    for (const Node& row : rows->items)
      out.materials.push_back(
          read_material(top.below("materials", row), uncertainty, uncertainty_source, out));
  if (const Node* rows = top.child("families", false))
    for (const Node& row : rows->items) out.families.push_back(read_family(top.below("families", row)));
  if (const Node* row = top.child("unnamed", false)) out.unnamed = read_family(top.below("unnamed", *row));
  top.finish();
  check_names(out, top);
  cite_all(out, citations, top);
  if (auto d = tell(std::move(faults), job)) return fail(std::move(*d));
  return out;
}

}  // namespace

Result<MaterialTable> read_material_table(std::string_view text, const std::string& file, Job& job) {
  const auto root = parse_tree(text, file);
  if (!root) return fail(root.error());
  return table_in(*root, file, job);
}

const Result<MaterialTable>& shipped_material_table() {
  static const Result<MaterialTable> kTable = []() -> Result<MaterialTable> {
    Job job;
    const auto root = shipped_tree(kFile);
    if (!root) return fail(root.error());
    return table_in(*root, kFile, job);
  }();
  return kTable;
}

}  // namespace capstan::tooling

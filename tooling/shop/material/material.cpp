#include "tooling/shop/material/material.h"

#include <algorithm>
#include <array>
#include <map>

#include "planner/ground/base/file.h"
#include "planner/ground/base/nearest_names.h"
#include "planner/ground/base/number.h"
#include "tooling/shop/material/hardness.h"
#include "tooling/shop/material/material_table.h"

namespace capstan::tooling {
namespace {

using model::WorkMaterial;

constexpr const char* kListMaterials = "capstan materials list";
constexpr std::size_t kMaterialBytesCap = std::size_t{1} << 20;
/// Shorter names must match as a whole: "O1" must not claim "O1-tool".
constexpr std::size_t kLeastPrefix = 4;

/// Where in a plain name the last of the family's words ends; 0: it has none of them.
std::size_t ends_in(const std::string& name, const MaterialFamily& family) {
  std::size_t end = 0;
  for (const std::string& word : family.words) {
    const auto at = name.rfind(word);
    if (at != std::string::npos) end = std::max(end, at + word.size());
  }
  return end;
}

/// Whether a name that people give is of the family: "aluminium bronze" is a bronze, for that word comes
/// last.
bool is_of(const std::string& name, const MaterialFamily& family,
           const std::vector<MaterialFamily>& families) {
  const std::string plain = plain_name(name);
  const std::size_t own = ends_in(plain, family);
  return own > 0 && std::all_of(families.begin(), families.end(),
                                [&](const MaterialFamily& f) { return ends_in(plain, f) <= own; });
}

bool is_of(const WorkMaterial& m, const MaterialFamily& family, const std::vector<MaterialFamily>& families) {
  if (ends_in(plain_name(m.id), family) > 0) return true;
  const auto named = [&](const MaterialFamily& f) {
    return std::any_of(m.names.begin(), m.names.end(),
                       [&](const std::string& name) { return is_of(name, f, families); });
  };
  // The card that stands for the family, unless it is called by another one's word.
  return named(family) || (m.id == family.material && std::none_of(families.begin(), families.end(), named));
}

/// A family's word where a material has to be named: with those of the family.
Diagnostic only_a_family(const std::string& text, const MaterialFamily& family,
                         const std::vector<MaterialFamily>& families,
                         const std::vector<WorkMaterial>& materials) {
  constexpr std::size_t kShown = 6;  // default, unsourced
  std::string names;
  std::size_t shown = 0;
  for (const WorkMaterial& m : materials) {
    if (shown == kShown || !is_of(m, family, families)) continue;
    names += (shown++ == 0 ? "'" : ", '") + m.id + "'";
  }
  Diagnostic d = unknown_name("material", text, names_of(materials), kListMaterials);
  d.message = "'" + text + "' names a family of materials, not a material";
  d.expected = names.empty() ? "'" + family.material + "'" : names;
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
  std::size_t length = 0;  ///< how many letters and digits of the text the name takes
};

Match exact(const std::string& wanted, const std::vector<WorkMaterial>& materials) {
  if (wanted.empty()) return {};
  for (const WorkMaterial& m : materials) {
    for (const std::string& name : m.names) {
      if (plain_name(name) != wanted) continue;
      const std::string* source = source_of(m, "name " + name);
      return {&m, name, source == nullptr ? "" : *source, wanted.size()};
    }
    if (plain_name(m.id) == wanted) return {&m, m.id, "its id", wanted.size()};
  }
  return {};
}

/// "GF30", "CF": what a plastic is filled with makes it another one.
bool filled(std::string_view rest) {
  for (const std::string_view word : {"GF", "CF", "GLASS", "CARBON"})
    if (rest.find(word) != std::string_view::npos) return true;
  return false;
}

/// The longest known name that the wanted one begins with; what follows may not go on as a number
/// ("ST-50" must not claim "ST-500").
Match longest_prefix(const std::string& wanted, const std::vector<WorkMaterial>& materials) {
  for (std::size_t n = wanted.size(); n-- > kLeastPrefix;) {
    const bool digits = wanted[n - 1] >= '0' && wanted[n - 1] <= '9' && wanted[n] >= '0' && wanted[n] <= '9';
    if (digits || filled(std::string_view(wanted).substr(n))) continue;
    if (Match m = exact(wanted.substr(0, n), materials); m.material != nullptr) return m;
  }
  return {};
}

/// A family's word is in the text: long ones anywhere, short ones only as a word of their own.
bool says(const std::string& text, const std::string& word) {
  if (word.size() >= 5) return plain_name(text).find(word) != std::string::npos;
  std::string token;
  for (const char c : text + " ") {
    const std::string p = plain_name(std::string_view(&c, 1));
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
      meant = meant || plain_name(path.substr(key.size())) == plain_name(alloy);
    }
    if (!named || meant) out.mechanistic.push_back(m.mechanistic[i]);
  }
  std::erase_if(out.sources, [](const auto& s) { return s.first == "chosen"; });
  out.sources.emplace_back("chosen", std::move(why));
  return out;
}

const WorkMaterial& hardest(const std::vector<WorkMaterial>& materials) {
  return *std::max_element(materials.begin(), materials.end(),
                           [](const auto& a, const auto& b) { return a.kc11_n_mm2 < b.kc11_n_mm2; });
}

/// Where its force is from: of another material where no table has its own.
std::string force_of(const WorkMaterial& m) {
  const std::string* source = source_of(m, "kc11_n_mm2");
  return source == nullptr ? std::string() : "; kc1.1: " + *source;
}

struct Grade {
  Match match;
  Beside beside;  ///< what the text says beside the name: "42CrMo4 50 HRC", "C45 nitrided"
};

/// What stands behind the first letters and digits of a text.
std::string_view behind(std::string_view text, std::size_t letters) {
  std::size_t i = 0;
  for (; i < text.size() && letters > 0; ++i) letters -= plain_name(text.substr(i, 1)).size();
  return text.substr(i);
}

/// A name that holds a state ("C45+QT") says it itself; what stands behind it counts.
Grade with_rest(Match match, const std::string& text, std::vector<StatedHardness> hardness) {
  Grade out{std::move(match), {std::move(hardness), {}}};
  const std::string_view rest = behind(text, out.match.length);
  out.beside.states = stated_words(rest).states;
  for (StatedState& s : states_behind_grade(rest)) out.beside.states.push_back(std::move(s));
  return out;
}

/// The name that a text begins with when words are taken from its end one by one.
template <class Search>
Match without_last_words(std::string text, Search search, const std::vector<WorkMaterial>& materials) {
  while (!plain_name(text).empty()) {
    if (Match m = search(plain_name(text), materials); m.material != nullptr) return m;
    const auto last = text.find_last_not_of(" ,;/");
    const auto cut = text.find_last_of(" ,;/", last);
    if (cut == std::string::npos) break;
    text.resize(cut);
  }
  return {};
}

/// The grade that a text names, by one way of searching.
template <class Search>
Grade grade_of(const std::string& text, Search search, const std::vector<WorkMaterial>& materials) {
  StatedWords said = stated_words(text);
  if (Match m = search(plain_name(text), materials); m.material != nullptr) {
    // "50 HRC" may be a name itself.
    if (plain_name(text) == plain_name(m.name)) return {std::move(m), {}};
    return with_rest(std::move(m), text, std::move(said.hardness));
  }
  if (said.none()) return {};
  // "C45 hardened to 55 HRC": the words between are not the grade's.
  if (Match m = without_last_words(said.before, search, materials); m.material != nullptr)
    return with_rest(std::move(m), text, std::move(said.hardness));
  // "case-hardened C45"
  if (Match m = without_last_words(said.plain, search, materials); m.material != nullptr)
    return {std::move(m), {std::move(said.hardness), std::move(said.states)}};
  return {};
}

/// Adds what other texts say of the same piece.
void add(const StatedWords& said, Beside& to) {
  to.hardness.insert(to.hardness.end(), said.hardness.begin(), said.hardness.end());
  to.states.insert(to.states.end(), said.states.begin(), said.states.end());
}

/// The card for the piece, and a warning for each hardness of its names that is not used.
Result<ChosenCard> judged(const WorkMaterial& m, const std::string& named, Beside of_names,
                          const std::vector<std::string>& properties,
                          const std::vector<WorkMaterial>& materials, Job& job) {
  const std::vector<StatedHardness> in_names = of_names.hardness;
  for (const std::string& p : properties) add(stated_words(p), of_names);
  auto out = as_stated(m, named, of_names, materials);
  if (!out) return out;
  for (const StatedHardness& h : in_names) {
    if (is_used(h, *out)) continue;
    const bool converted = converts(h.scale, out->material.iso_group);
    job.report(
        {.code = "MATERIAL-HARDNESS",
         .severity = Severity::kWarning,
         .message = "'" + named + "' states " + h.text + ", which is not used: " +
                    (converted ? "the card '" + out->material.id + "' states no hardness"
                               : "it does not convert to Brinell for ISO 513 " + out->material.iso_group),
         .hint = "forces and speeds are those of '" + out->material.id +
                 "'; state the hardness in HB, HV or HRC, or name a harder material with --material"});
  }
  return out;
}

}  // namespace

Result<std::vector<WorkMaterial>> read_materials(std::string_view text, const std::string& file, Job& job) {
  auto table = read_material_table(text, file, job);
  if (!table) return fail(table.error());
  return std::move(table->materials);
}

Result<std::vector<WorkMaterial>> shipped_materials() {
  const auto& table = shipped_material_table();
  if (!table) return fail(table.error());
  return table->materials;
}

bool names_a_material_file(std::string_view text) {
  for (const std::string_view ending : {".yaml", ".yml", ".json"})
    if (text.ends_with(ending)) return true;
  return false;
}

Result<WorkMaterial> load_material(const std::string& path, const std::vector<WorkMaterial>& shipped,
                                   Job& job) {
  const auto text = read_file(path, kMaterialBytesCap);
  if (!text) return fail(text.error());
  auto own = read_materials(*text, path, job);
  if (!own) return fail(own.error());
  if (own->size() != 1)
    return fail({.code = "MATERIAL-FILE",
                 .message = "the file holds " + std::to_string(own->size()) +
                            " materials, and the part is made of one",
                 .file = path,
                 .expected = "one material under 'materials'"});
  WorkMaterial& m = own->front();
  if (plain_name(m.id).empty())
    return fail({.code = "MATERIAL-FILE", .message = "the id has neither letters nor digits", .file = path});
  for (const WorkMaterial& other : shipped) {
    if (plain_name(other.id) == plain_name(m.id))
      return fail({.code = "MATERIAL-FILE",
                   .message = "'" + m.id +
                              "' is the id of a built-in material; start values of the built-in " +
                              "tools are kept by id",
                   .file = path,
                   .expected = "an id of its own, e.g. 'shop_" + m.id + "'",
                   .hint = "`" + std::string(kListMaterials) + "` shows those that are built in"});
  }
  return std::move(m);
}

std::vector<std::string> names_of(const std::vector<WorkMaterial>& materials) {
  std::vector<std::string> out;
  for (const WorkMaterial& m : materials) {
    out.push_back(m.id);
    out.insert(out.end(), m.names.begin(), m.names.end());
  }
  return out;
}

const std::string* source_of(const WorkMaterial& m, std::string_view field) {
  for (const auto& [name, source] : m.sources)
    if (name == field) return &source;
  return nullptr;
}

Result<ChosenMaterial> choose_material(const std::vector<std::string>& texts,
                                       const std::vector<std::string>& properties,
                                       const std::vector<WorkMaterial>& materials, Job& job,
                                       Families families) {
  if (materials.empty()) return fail("MATERIAL-NONE", "the material table is empty");
  // Only who chooses a name can ask for another material's figures.
  const auto asked_of = [&](const std::string& text) {
    return families == Families::kRefused && text.starts_with(kLike) ? text.substr(kLike.size()) : text;
  };
  const auto as_said = [&](const WorkMaterial& m, const std::string& named, const std::string& alloy,
                           std::string why, Beside beside) -> Result<ChosenMaterial> {
    auto out = judged(chosen(m, alloy, std::move(why)), named, std::move(beside), properties, materials, job);
    if (!out) return fail(out.error());
    return ChosenMaterial{std::move(out->material), m.id, out->by_hardness};
  };
  using Search = Match (*)(const std::string&, const std::vector<WorkMaterial>&);
  for (const Search search : std::array<Search, 2>{exact, longest_prefix}) {
    for (const std::string& text : texts) {
      const std::string asked = asked_of(text);
      Grade g = grade_of(asked, search, materials);
      const Match& m = g.match;
      if (m.material == nullptr) continue;
      std::string why = "'" + asked + "' is " + m.name + ": " + m.source + force_of(*m.material);
      if (asked != text)
        why = "'" + text + "' is asked for: planned with the figures of '" + m.material->id +
              "', whatever the material is; " + why;
      // What the other texts say of the piece counts, too.
      for (const std::string& other : texts)
        if (&other != &text) add(stated_words(asked_of(other)), g.beside);
      return as_said(*m.material, asked, m.name, std::move(why), std::move(g.beside));
    }
  }
  const auto& table = shipped_material_table();
  if (!table) return fail(table.error());
  Beside beside;
  for (const std::string& text : texts) add(stated_words(asked_of(text)), beside);
  for (const std::string& text : texts) {
    const MaterialFamily* best = nullptr;
    std::size_t longest = 0;
    for (const MaterialFamily& f : table->families)
      for (const std::string& w : f.words)
        if (w.size() > longest && says(asked_of(text), w)) {
          best = &f;
          longest = w.size();
        }
    if (best == nullptr) continue;
    const WorkMaterial* m = by_id(materials, best->material);
    if (m == nullptr) continue;
    if (families == Families::kRefused)
      return fail(only_a_family(asked_of(text), *best, table->families, materials));
    job.warn("MATERIAL-FAMILY", "the material '" + text + "' names only a family; forces and speeds are " +
                                    "calculated for " + m->id + ", " + best->source +
                                    "; name the material with --material");
    return as_said(*m, text, {}, "'" + text + "': " + best->source, std::move(beside));
  }
  const auto named =
      std::find_if(texts.begin(), texts.end(), [](const auto& t) { return !plain_name(t).empty(); });
  if (named != texts.end())
    return fail(unknown_name("material", asked_of(*named), names_of(materials), kListMaterials));
  const WorkMaterial* m = by_id(materials, table->unnamed.material);
  if (m == nullptr) m = &hardest(materials);
  job.warn("MATERIAL-DEFAULT", "no material is named; planned for " + m->id +
                                   " by default (the largest cutting force of those that are neither " +
                                   "hardened nor heat resistant): name one with --material");
  return as_said(*m, m->id, {}, table->unnamed.source, {});
}

Result<WorkMaterial> find_material(const std::vector<std::string>& texts,
                                   const std::vector<WorkMaterial>& materials, Job& job, Families families) {
  auto out = choose_material(texts, {}, materials, job, families);
  if (!out) return fail(out.error());
  return std::move(out->material);
}

Result<WorkMaterial> find_material(const std::string& text, const std::vector<WorkMaterial>& materials,
                                   Job& job) {
  return find_material(std::vector<std::string>{text}, materials, job);
}

}  // namespace capstan::tooling

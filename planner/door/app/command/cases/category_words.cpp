#include "planner/door/app/command/cases/category_words.h"

#include <algorithm>
#include <array>
#include <map>
#include <set>
#include <string_view>
#include <utility>

#include "planner/ground/base/nearest_names.h"
#include "planner/ground/base/number.h"
#include "planner/ground/vocabulary/cutter_class.h"
#include "planner/model/nouns/arena/attribute.h"
#include "tooling/shop/material/material.h"

namespace capstan::app {
namespace {

using casebase::Question;
using Categories = casebase::CaseBase::Categories;

struct Category {
  std::string_view name;
  std::string Question::*asked;
  std::string Categories::*held;
};
constexpr std::array kCategories = {
    Category{"operation", &Question::operation, &Categories::operation},
    Category{"material", &Question::material_group, &Categories::material_group},
    Category{"tool", &Question::tool_class, &Categories::tool_class},
    Category{"machine", &Question::machine_class, &Categories::machine_class}};

bool has(const std::vector<std::string>& words, std::string_view word) {
  return std::find(words.begin(), words.end(), word) != words.end();
}

/// The groups of materials, or why there are none.
std::vector<std::string> planned_materials() {
  std::vector<std::string> out;
  const auto cards = tooling::shipped_materials();
  if (!cards) return out;
  for (const model::WorkMaterial& card : *cards) out.push_back(casebase::material_group_of(card));
  return out;
}

/// "P/c45": a letter of ISO 513 and the material's id.
bool is_group(std::string_view word) {
  constexpr std::string_view kLetters = "PMKNSHO";
  return word.size() > 2 && word[1] == '/' && kLetters.find(word[0]) != std::string_view::npos;
}

/// The words that a base has in a category, by how many cases have them.
std::vector<std::string> words_in(const std::vector<Categories>& all, std::string Categories::*held) {
  std::map<std::string, std::size_t> count;
  for (const Categories& c : all) {
    if (c.cases > 0) count[c.*held] += c.cases;
  }
  std::vector<std::pair<std::string, std::size_t>> sorted(count.begin(), count.end());
  std::stable_sort(sorted.begin(), sorted.end(),
                   [](const auto& a, const auto& b) { return a.second > b.second; });
  std::vector<std::string> out;
  for (auto& [word, cases] : sorted) out.push_back(std::move(word));
  return out;
}

/// "'a', 'b' and 3 more".
std::string some_of(const std::vector<std::string>& words) {
  constexpr std::size_t kNamed = 4;
  std::string out;
  for (std::size_t i = 0; i < std::min(kNamed, words.size()); ++i)
    out += (i == 0 ? "'" : ", '") + words[i] + "'";
  if (words.size() > kNamed) out += " and " + std::to_string(words.size() - kNamed) + " more";
  return out;
}

}  // namespace

std::vector<std::string> planned_operations() {
  std::vector<std::string> out;
  for (std::size_t i = 1; i < model::kTypeCount; ++i) {
    const auto type = static_cast<model::TypeId>(i);
    const model::NounType& noun = model::noun_type(type);
    if (!noun.abstract && !noun.keyword.empty() && model::is_a(type, model::TypeId::kMachiningOperation))
      out.emplace_back(noun.keyword);
  }
  return out;
}

std::vector<std::string> planned_tool_classes() {
  std::vector<std::string> out;
  for (const model::Substrate substrate : {model::Substrate::kHss, model::Substrate::kCarbide}) {
    for (const model::CutterClassRow& row : model::cutter_classes())
      out.push_back(std::string(to_text(substrate)) + '/' + std::string(row.name));
  }
  return out;
}

std::vector<Diagnostic> unplanned_words(const std::vector<casebase::Case>& cases) {
  std::set<std::string> operations, tools, materials;
  for (const casebase::Case& c : cases) {
    operations.insert(c.asked.operation);
    tools.insert(c.asked.tool_class);
    if (!is_group(c.asked.material_group)) materials.insert(c.asked.material_group);
  }
  std::vector<Diagnostic> out;
  const auto tell = [&](std::string_view what, const std::set<std::string>& words,
                        const std::vector<std::string>& known) {
    for (const std::string& word : words) {
      if (has(known, word)) continue;
      Diagnostic d = unknown_name(what, word, known, "capstan cases list");
      d.code = "CASE-WORD";
      d.severity = Severity::kNote;
      d.hint = "no plan has that word, so that planning never finds these cases";
      out.push_back(std::move(d));
    }
  };
  tell("operation", operations, planned_operations());
  tell("tool", tools, planned_tool_classes());
  if (!materials.empty()) tell("material", materials, planned_materials());
  return out;
}

Status known_categories(const Question& q, const casebase::CaseBase& base) {
  const std::vector<Categories> all = base.categories();
  const auto check = [&](const Category& category, const std::vector<std::string>& planned) -> Status {
    std::vector<std::string> known = words_in(all, category.held);
    known.insert(known.end(), planned.begin(), planned.end());
    const std::string& word = q.*category.asked;
    if (has(known, word)) return {};
    return tl::unexpected(unknown_name(category.name, word, known, "capstan cases list"));
  };
  if (auto ok = check(kCategories[0], planned_operations()); !ok) return ok;
  return check(kCategories[2], planned_tool_classes());
}

std::string no_shared_categories(const Question& q, const casebase::CaseBase& base) {
  std::vector<Categories> all = base.categories();
  std::erase_if(all, [](const Categories& c) { return c.cases == 0; });
  if (all.empty()) return "the base holds no case\n";
  // By which categories differ: a bit each.
  std::map<unsigned, std::size_t> cases;
  for (const Categories& c : all) {
    unsigned differ = 0;
    for (std::size_t i = 0; i < kCategories.size(); ++i) {
      if (q.*kCategories[i].asked != c.*kCategories[i].held) differ |= 1U << i;
    }
    cases[differ] += c.cases;
  }
  if (cases.contains(0))
    return "the cases of these categories have another of diameter, depth and width than is asked, or none\n";
  const auto bits = [](unsigned differ) {
    int n = 0;
    for (; differ != 0; differ &= differ - 1) ++n;
    return n;
  };
  const auto nearest = std::min_element(cases.begin(), cases.end(), [&](const auto& a, const auto& b) {
    return bits(a.first) != bits(b.first) ? bits(a.first) < bits(b.first) : a.second > b.second;
  });
  std::string out = "no case shares these categories; " + counted(nearest->second, "case", "cases") +
                    (nearest->second == 1 ? " differs in" : " differ in");
  const char* before = " ";
  for (std::size_t i = 0; i < kCategories.size(); ++i) {
    if ((nearest->first >> i & 1U) == 0) continue;
    std::vector<Categories> there;
    for (const Categories& c : all) {
      bool of = true;
      for (std::size_t k = 0; k < kCategories.size(); ++k)
        of = of && ((nearest->first >> k & 1U) != 0) == (q.*kCategories[k].asked != c.*kCategories[k].held);
      if (of) there.push_back(c);
    }
    out += std::string(std::exchange(before, ", and in ")) + "the " + std::string(kCategories[i].name) +
           ": '" + q.*kCategories[i].asked + "' is asked, there it is " +
           some_of(words_in(there, kCategories[i].held));
  }
  return out + "\n";
}

}  // namespace capstan::app

#include "tooling/catalogue/hardness.h"

#include <algorithm>
#include <array>

#include "planner/ground/base/number.h"
#include "tooling/catalogue/material_table.h"

namespace capstan::tooling {
namespace {

using model::WorkMaterial;

/// Hardness of a grade varies from piece to piece by about this. Default, unsourced.
constexpr double kHardnessSlack = 1.1;

struct Point {
  double hrc, hb;
};
constexpr std::array<Point, 9> kBrinell = {
    {{20, 226}, {25, 253}, {30, 286}, {35, 327}, {40, 371}, {45, 421}, {50, 481}, {55, 560}, {60, 654}}};

std::optional<double> brinell_of_rockwell(double hrc) {
  for (std::size_t i = 0; i + 1 < kBrinell.size(); ++i) {
    const Point a = kBrinell[i], b = kBrinell[i + 1];
    if (hrc >= a.hrc && hrc <= b.hrc) return a.hb + (hrc - a.hrc) / (b.hrc - a.hrc) * (b.hb - a.hb);
  }
  return std::nullopt;
}

bool digit(char c) { return c >= '0' && c <= '9'; }
bool letter(char c) { return c >= 'A' && c <= 'Z'; }

std::string upper(std::string_view text) {
  std::string out(text);
  for (char& c : out)
    if (c >= 'a' && c <= 'z') c = static_cast<char>(c - 'a' + 'A');
  return out;
}

struct Number {
  double value = 0.0;
  std::size_t begin = 0;
};

std::optional<Number> number_at(const std::string& text, std::size_t begin, std::size_t end) {
  const auto value = parse_double(text.substr(begin, end - begin));
  if (!value) return std::nullopt;
  return Number{*value, begin};
}

/// The number that begins at `at`, after blanks; nothing where none does.
std::optional<Number> number_after(const std::string& text, std::size_t at) {
  at = text.find_first_not_of(" =:", at);
  if (at == std::string::npos || !digit(text[at])) return std::nullopt;
  std::size_t end = at;
  while (end < text.size() && (digit(text[end]) || text[end] == '.')) ++end;
  return number_at(text, at, end);
}

/// The number that ends before `at`, blanks apart.
std::optional<Number> number_before(const std::string& text, std::size_t at) {
  while (at > 0 && text[at - 1] == ' ') --at;
  std::size_t begin = at;
  while (begin > 0 && (digit(text[begin - 1]) || text[begin - 1] == '.')) --begin;
  // "X40HRC" is no number, "S 40 HRC" is one.
  if (begin == at || (begin > 0 && letter(text[begin - 1]))) return std::nullopt;
  return number_at(text, begin, at);
}

}  // namespace

std::optional<StatedHardness> stated_hardness(double value, std::string_view unit) {
  const std::string u = plain_name(unit);
  std::optional<double> hb;
  if (u == "HB" || u == "HBW" || u == "HBS" || u == "BHN" || u == "BRINELL") {
    if (value > 0.0) hb = value;
  } else if (u == "HRC" || u == "ROCKWELLC") {
    hb = brinell_of_rockwell(value);
  }
  if (!hb) return std::nullopt;
  return StatedHardness{*hb, trimmed(value, 4) + " " + std::string(unit), {}};
}

std::optional<StatedHardness> stated_hardness(std::string_view text) {
  const std::string t = upper(text);
  for (const char* unit : {"HRC", "HBW", "BHN", "HB"}) {
    const std::string u = unit;
    for (auto at = t.find(u); at != std::string::npos; at = t.find(u, at + 1)) {
      const std::size_t end = at + u.size();
      if ((at > 0 && letter(t[at - 1])) || (end < t.size() && letter(t[end]))) continue;
      auto value = number_before(t, at);
      if (!value) value = number_after(t, end);
      if (!value) continue;
      auto out = stated_hardness(value->value, u);
      if (!out) continue;
      out->before = std::string(text.substr(0, std::min(value->begin, at)));
      return out;
    }
  }
  return std::nullopt;
}

Result<std::optional<WorkMaterial>> as_hard_as(const WorkMaterial& material, const StatedHardness& stated,
                                               const std::vector<WorkMaterial>& materials) {
  const auto table = shipped_material_table();
  if (!table) return fail(table.error());
  std::vector<const WorkMaterial*> cards;
  if (material.hardness_hb > 0.0) cards.push_back(&material);
  if (const auto it = table->harder.find(material.id); it != table->harder.end()) {
    for (const std::string& id : it->second)
      for (const WorkMaterial& m : materials)
        if (m.id == id && m.hardness_hb > 0.0) cards.push_back(&m);
  }
  if (cards.empty() || cards.size() == 1) return std::optional<WorkMaterial>{};
  std::sort(cards.begin() + (cards.front() == &material ? 1 : 0), cards.end(),
            [](const auto* a, const auto* b) { return a->hardness_hb < b->hardness_hb; });
  const auto fits = [&](const WorkMaterial* m) { return stated.brinell <= kHardnessSlack * m->hardness_hb; };
  const auto it = std::find_if(cards.begin(), cards.end(), fits);
  if (it == cards.end())
    return fail({.code = "MATERIAL-HARDNESS",
                 .message = "the material is " + stated.text + " hard, and no card of '" + material.id +
                            "' goes above " + trimmed(cards.back()->hardness_hb, 0) + " HB (" +
                            cards.back()->id + ")",
                 .expected = "at most " + trimmed(kHardnessSlack * cards.back()->hardness_hb, 0) + " HB",
                 .hint = "name a card with --material, or a file with the material's own figures"});
  WorkMaterial out = **it;
  if (*it != &material) {
    for (const auto& [field, source] : material.sources)
      if (field == "chosen") out.sources.emplace_back("chosen", source);
  }
  out.sources.emplace_back("chosen", stated.text + " is stated (" + trimmed(stated.brinell, 0) +
                                         " HB): the card '" + out.id + "' of " + trimmed(out.hardness_hb, 0) +
                                         " HB");
  return std::optional<WorkMaterial>(std::move(out));
}

}  // namespace capstan::tooling

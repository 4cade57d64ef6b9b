#include "tooling/catalogue/hardness.h"

#include <algorithm>
#include <array>
#include <limits>

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

/// A number of a text, and where the run of numbers begins that it stands in.
struct Number {
  double value = 0.0;
  std::size_t begin = 0;
};

bool of_numbers(char c) { return digit(c) || std::string_view(" .,+-/").find(c) != std::string_view::npos; }

/// What a run of numbers means at most: "48-52" is 52, "58+2" is 60, "58,5" is 58.5; numbers that are no
/// hardness in this unit, such as those of a grade before it, are passed over.
std::optional<Number> most_of(const std::string& text, std::size_t begin, std::size_t end, double lo,
                              double hi) {
  std::optional<Number> out;
  double before = 0.0;  // the last number, where it is one of this unit
  bool plus = false;    // between it and here
  for (std::size_t i = begin; i < end;) {
    if (!digit(text[i])) {
      if (text[i] == '+') plus = true;
      if (text[i] != '+' && text[i] != ' ') before = 0.0;
      ++i;
      continue;
    }
    const std::size_t from = i;
    while (i < end &&
           (digit(text[i]) || ((text[i] == '.' || text[i] == ',') && i + 1 < end && digit(text[i + 1]))))
      ++i;
    std::string word = text.substr(from, i - from);
    std::replace(word.begin(), word.end(), ',', '.');
    // "X40" is a grade.
    if (from > 0 && letter(text[from - 1])) continue;
    const auto value = parse_double(word);
    if (!value) continue;
    const double most = plus ? before + *value : *value;
    plus = false;
    if (most >= lo && most <= hi && (!out || most > out->value)) out = Number{most, out ? out->begin : from};
    before = most >= lo && most <= hi ? most : 0.0;
  }
  return out;
}

struct Unit {
  const char* name;
  double lo, hi;  ///< outside, a number beside it is something else
};
constexpr std::array<Unit, 5> kUnits = {
    {{"HRC", 5, 80}, {"HBW", 50, 1000}, {"BHN", 50, 1000}, {"HB", 50, 1000}, {"HV", 50, 2000}}};
constexpr double kHarderThanAnyCard = std::numeric_limits<double>::infinity();

}  // namespace

std::optional<StatedHardness> stated_hardness(double value, std::string_view unit) {
  const std::string u = plain_name(unit);
  if (!(value > 0.0)) return std::nullopt;
  double hb = 0.0;
  // A Brinell number is never above the Vickers number.
  if (u == "HB" || u == "HBW" || u == "HBS" || u == "BHN" || u == "BRINELL" || u == "HV" || u == "VICKERS") {
    hb = value;
  } else if (u == "HRC" || u == "ROCKWELLC") {
    hb = value < kBrinell.front().hrc ? kBrinell.front().hb
                                      : brinell_of_rockwell(value).value_or(kHarderThanAnyCard);
  } else {
    return std::nullopt;
  }
  return StatedHardness{hb, trimmed(value, 4) + " " + std::string(unit), {}};
}

std::optional<StatedHardness> stated_hardness(std::string_view text) {
  const std::string t = upper(text);
  std::optional<StatedHardness> out;
  for (const Unit& unit : kUnits) {
    const std::string u = unit.name;
    for (auto at = t.find(u); at != std::string::npos; at = t.find(u, at + 1)) {
      const std::size_t end = at + u.size();
      if ((at > 0 && letter(t[at - 1])) || (end < t.size() && letter(t[end]))) continue;
      std::size_t first = at;
      while (first > 0 && of_numbers(t[first - 1])) --first;
      std::size_t last = t.find_first_not_of(" =:", end);
      if (last == std::string::npos) last = t.size();
      const std::size_t after = last;
      while (last < t.size() && of_numbers(t[last])) ++last;
      const auto left = most_of(t, first, at, unit.lo, unit.hi);
      const auto right = most_of(t, after, last, unit.lo, unit.hi);
      auto here =
          !left && !right
              ? StatedHardness{kHarderThanAnyCard, "of a hardness in " + u + " that cannot be read,", {}}
              : *stated_hardness(std::max(left ? left->value : 0.0, right ? right->value : 0.0), u);
      here.before = std::string(text.substr(0, left ? std::min(left->begin, at) : at));
      if (!out || here.brinell > out->brinell) out = std::move(here);
    }
  }
  return out;
}

Result<std::optional<WorkMaterial>> as_hard_as(const WorkMaterial& material, const StatedHardness& stated,
                                               const std::vector<WorkMaterial>& materials) {
  const auto& table = shipped_material_table();
  if (!table) return fail(table.error());
  std::vector<const WorkMaterial*> cards;
  if (material.hardness_hb > 0.0) cards.push_back(&material);
  if (const auto it = table->harder.find(material.id); it != table->harder.end()) {
    for (const std::string& id : it->second)
      for (const WorkMaterial& m : materials)
        if (m.id == id && m.hardness_hb > 0.0) cards.push_back(&m);
  }
  if (cards.empty()) return std::optional<WorkMaterial>{};
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

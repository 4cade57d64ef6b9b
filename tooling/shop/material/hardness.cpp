#include "tooling/shop/material/hardness.h"

#include <algorithm>
#include <optional>

#include "planner/ground/base/number.h"
#include "tooling/shop/material/material.h"
#include "tooling/shop/material/material_table.h"

namespace capstan::tooling {
namespace {

using model::WorkMaterial;

/// Hardness of a grade varies from piece to piece by about this. Default, unsourced.
constexpr double kHardnessSlack = 1.1;
/// From here steel counts as hardened: 45 HRC, the softest card of ISO 513 H, less the slack.
constexpr double kHardened = 421.0 / kHardnessSlack;
/// Cards from here on are of a tempered state already: that of C45+QT, the softest of them.
constexpr double kTempered = 250.0;

std::optional<StatedHardness> hardest(const std::vector<StatedHardness>& all, const WorkMaterial& m) {
  std::optional<StatedHardness> out;
  for (const StatedHardness& h : all)
    if (converts(h.scale, m.iso_group) && (!out || h.brinell > out->brinell)) out = h;
  return out;
}

std::string words(const WorkMaterial& m) {
  return m.id + (m.hardness_hb > 0.0 ? ", " + trimmed(m.hardness_hb, 0) + " HB" : std::string());
}

/// The cards of the grade, its own first, then from soft to hard.
std::vector<const WorkMaterial*> cards_of(const WorkMaterial& material, const MaterialTable& table,
                                          const std::vector<WorkMaterial>& materials) {
  std::vector<const WorkMaterial*> out;
  if (const auto it = table.harder.find(material.id); it != table.harder.end()) {
    for (const std::string& id : it->second)
      for (const WorkMaterial& m : materials)
        if (m.id == id && m.hardness_hb > 0.0) out.push_back(&m);
  }
  std::sort(out.begin(), out.end(),
            [](const auto* a, const auto* b) { return a->hardness_hb < b->hardness_hb; });
  out.insert(out.begin(), &material);
  return out;
}

/// The first that is as hard; null: the material's own states no hardness and is taken to be.
Result<const WorkMaterial*> as_hard(const WorkMaterial& material, const StatedHardness& stated,
                                    const std::vector<const WorkMaterial*>& cards) {
  const bool known = material.hardness_hb > 0.0;
  if (!known) {
    const double next = cards.size() > 1 ? cards[1]->hardness_hb / kHardnessSlack : kHardened;
    if (stated.brinell < next) return nullptr;
  }
  const auto it = std::find_if(cards.begin() + (known ? 0 : 1), cards.end(), [&](const WorkMaterial* m) {
    return stated.brinell <= kHardnessSlack * m->hardness_hb;
  });
  if (it != cards.end()) return *it;
  const WorkMaterial& last = *cards.back();
  const bool any = last.hardness_hb > 0.0;
  return fail(
      {.code = "MATERIAL-HARDNESS",
       .message = stated.text + " is stated, and " +
                  (any ? "no card of '" + material.id + "' goes above " + trimmed(last.hardness_hb, 0) +
                             " HB (" + last.id + ")"
                       : "the card '" + material.id + "' holds for nothing as hard"),
       .expected = "at most " + trimmed(any ? kHardnessSlack * last.hardness_hb : kHardened, 0) + " HB",
       .hint = "name a card with --material, or a file with the material's own figures"});
}

/// Whether a state in words means harder than the card, and no number says how hard.
bool unstated(State state, const WorkMaterial& card, const std::optional<StatedHardness>& number) {
  if (card.iso_group == "H") return false;
  const bool steel_or_iron = card.iso_group == "P" || card.iso_group == "M" || card.iso_group == "K";
  switch (state) {
    case State::kSoft:
      return false;
    case State::kTempered:
      // Other groups are used as they are treated: T6, solution treated and aged.
      return !number && steel_or_iron && card.hardness_hb < kTempered;
    case State::kAged:
      return !number && steel_or_iron;
    case State::kHard:
      return !number;
    case State::kSurface:
      return !number || number->brinell < kHardened;  // a softer one is the core's
  }
  return false;
}

}  // namespace

Result<ChosenCard> as_stated(const WorkMaterial& material, const std::string& named, const Beside& beside,
                             const std::vector<WorkMaterial>& materials) {
  ChosenCard out{material, false};
  const auto stated = hardest(beside.hardness, material);
  if (stated) {
    const auto& table = shipped_material_table();
    if (!table) return fail(table.error());
    const auto card = as_hard(material, *stated, cards_of(material, *table, materials));
    if (!card) return fail(card.error());
    if (const WorkMaterial* m = *card) {
      if (m != &material) {
        out.material = *m;
        if (const std::string* why = source_of(material, "chosen"))
          out.material.sources.emplace_back("chosen", *why);
      }
      out.material.sources.emplace_back("chosen", stated->text + " is stated (" +
                                                      trimmed(stated->brinell, 0) + " HB): the card '" +
                                                      m->id + "' of " + trimmed(m->hardness_hb, 0) + " HB");
      out.by_hardness = true;
    }
  }
  for (const StatedState& s : beside.states) {
    if (!unstated(s.state, out.material, stated)) continue;
    const bool core = s.state == State::kSurface && stated;
    return fail(
        {.code = "MATERIAL-STATE",
         .message = "the material '" + named + "' is said to be '" + s.text +
                    "', which is harder than its card (" + words(out.material) + "), and " +
                    (core ? stated->text + " is not the hardness of its surface" : "nothing says how hard"),
         .expected = "the hardness beside the name or as a property, as in '" + material.id + " " +
                     (s.state == State::kTempered || s.state == State::kAged ? "32 HRC'" : "58 HRC'"),
         .hint = "state it in HRC, or plan with another material's figures: --material like:" +
                 std::string(s.state == State::kTempered || s.state == State::kAged ? "42CrMo4+QT"
                                                                                    : "hardened_steel_60")});
  }
  return out;
}

bool is_used(const StatedHardness& stated, const ChosenCard& judged) {
  return judged.by_hardness && converts(stated.scale, judged.material.iso_group);
}

}  // namespace capstan::tooling

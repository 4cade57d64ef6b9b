#include <algorithm>

#include "tooling/library/cutters/complete.h"
#include "tooling/library/formats/cutters/symbols.h"
#include "tooling/library/formats/format.h"
#include "tooling/library/formats/values.h"

// Cutters to records.

namespace capstan::tooling {
namespace {

using model::Cutter;

/// "stated: x" -> its state and x.
std::pair<ValueState, std::string> state_of(const Cutter& c, std::string_view field) {
  const std::string* s = source_of(c, field);
  if (s == nullptr) return {ValueState::kStated, ""};
  const auto rest = [s](std::size_t n) {
    std::string_view t = std::string_view(*s).substr(std::min(n, s->size()));
    if (t.starts_with(": ")) t.remove_prefix(2);
    return std::string(t);
  };
  if (s->starts_with("derived")) return {ValueState::kDerived, rest(7)};
  if (s->starts_with("default")) return {ValueState::kDefault, rest(7)};
  return {ValueState::kStated, s->starts_with("stated") ? rest(6) : *s};
}

CatalogueItem item_of(const Cutter& c) {
  CatalogueItem out;
  out.id = c.id;
  out.description = c.description;
  out.cutter_class = c.cutter_class;
  out.kind = model::to_text(c.cutter_class);
  out.product_id = c.product_id;
  out.inches = c.stated_in_inches;
  const auto add = [&](const char* symbol, double value, const char* unit, const char* field) {
    auto [state, source] = state_of(c, field);
    const char* u = std::string_view(unit) == "mm" && c.stated_in_inches ? "in" : unit;
    out.properties.push_back(number_property(symbol, value, u, state, source));
  };
  const auto text = [&](const char* symbol, std::string_view value, const char* field) {
    auto [state, source] = state_of(c, field);
    Property p = text_property(symbol, value, source);
    p.state = state;
    out.properties.push_back(std::move(p));
  };
  const char* before = "";
  for (const SymbolRow& f : kCutterSymbols) {
    if (c.*f.field != 0.0 && std::string_view(before) != f.name) add(f.symbol, c.*f.field, f.unit, f.name);
    before = f.name;
  }
  if (c.teeth > 0) add("ZEFF", c.teeth, "", "teeth");
  if (c.life_min > 0.0) add("LIFE", c.life_min, "", "life_min");
  if (c.price > 0.0) add("PRICE", c.price, "", "price");
  text("SUBSTRATE", model::to_text(c.substrate), "substrate");
  if (c.hand == model::Hand::kLeft) text("HAND", "left", "hand");
  text("CCC", c.centre_cutting ? "true" : "false", "centre_cutting");
  if (c.coolant_through) text("CSP", "true", "coolant_through");
  if (!c.thread_form.empty()) text("THFT", c.thread_form, "thread_form");
  if (!c.library_reference.empty()) text("PLIB", c.library_reference, "library_reference");
  if (!c.library_source.empty()) text("PLIBSOURCE", c.library_source, "library_source");
  const bool own =
      std::any_of(c.presets.begin(), c.presets.end(), [](const auto& p) { return !borrowed(p); });
  for (const auto& p : c.presets) {
    if (own && borrowed(p)) continue;  // the reader fills it in again
    Preset q;
    q.name = q.material = p.material_group.text();
    if (p.vc_m_min > 0.0) q.vc_m_min = p.vc_m_min;
    if (p.fz_mm > 0.0 && model::has(c.cutter_class, model::CutterTrait::kAlongAxis))
      q.feed_per_revolution_mm = p.fz_mm * std::max(c.teeth, 1);
    else if (p.fz_mm > 0.0)
      q.fz_mm = p.fz_mm;
    q.source = p.source.text();
    out.presets.push_back(std::move(q));
  }
  return out;
}

}  // namespace

ToolLibrary library_of(const std::vector<Cutter>& cutters, std::string name) {
  ToolLibrary out;
  out.name = std::move(name);
  for (const Cutter& c : cutters) {
    out.items.push_back(item_of(c));
    ToolAssembly a;
    a.id = a.item = c.id;
    if (!c.holder.empty() || !c.holder_id.empty()) {
      Holder h;
      h.id = c.holder_id.empty() ? "holder of " + c.id : c.holder_id;
      h.segments = c.holder;
      h.inches = c.stated_in_inches;
      a.holder = h.id;
      const auto same = std::find_if(out.holders.begin(), out.holders.end(),
                                     [&h](const Holder& o) { return o.id == h.id; });
      if (same == out.holders.end()) out.holders.push_back(std::move(h));
    }
    if (c.stick_out_mm > 0.0) a.stick_out_mm = c.stick_out_mm;
    if (c.functional_length_mm > 0.0) a.functional_length_mm = c.functional_length_mm;
    if (c.in_stock >= 0 || c.life_used_min > 0.0 || !c.sisters.empty()) {
      ToolInstance i;
      i.id = i.item = c.id;
      if (c.in_stock >= 0) i.in_stock = c.in_stock;
      if (c.life_used_min > 0.0) i.life_used_min = c.life_used_min;
      if (c.life_min > 0.0) i.life_min = c.life_min;
      if (!c.sisters.empty()) i.group = c.id;
      a.instance = i.id;
      out.instances.push_back(std::move(i));
      for (const auto& s : c.sisters) {
        ToolInstance sister;
        sister.id = s.id;
        sister.item = sister.group = c.id;
        sister.life_min = s.life_left_min;
        sister.life_used_min = 0.0;
        out.instances.push_back(std::move(sister));
      }
    }
    out.assemblies.push_back(std::move(a));
    if (c.pocket > 0) {
      MachineEntry e;
      e.number = c.pocket;
      if (c.loaded) e.pocket = c.pocket;
      e.carousel = c.carousel;
      e.assembly = c.id;
      e.comment = c.description;
      if (c.table_line) {
        for (const model::ToolTableWord& w : c.table_line->words) {
          if (w.letter == "P") {
            e.pocket = static_cast<int>(w.value);
          } else if (w.letter.size() == 1) {
            e.offsets.emplace_back(w.letter.front(), w.value);
          }
        }
      }
      out.entries.push_back(std::move(e));
    }
  }
  return out;
}

}  // namespace capstan::tooling

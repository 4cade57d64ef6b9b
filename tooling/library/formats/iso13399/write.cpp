#include "planner/files/p21/print.h"
#include "planner/files/p21/read/text.h"
#include "planner/ground/base/number.h"
#include "tooling/library/formats/iso13399/iso13399.h"
#include "tooling/library/formats/item/iso_names.h"
#include "tooling/library/formats/item/item.h"

namespace capstan::tooling {
namespace {

/// The class of the dictionary that makers' files name as the scope of properties.
constexpr std::string_view kDictionaryClass = "71EAD3871D313", kDictionary = "0112/1///13399__003",
                           kVersion = "003";

class Writer {
 public:
  explicit Writer(Exported& out) : out_(out) {}

  void head(const ToolLibrary& library) {
    w_.entity("FILE_DESCRIPTION").list().text("Cutting tools by ISO 13399").end().text("2;1").end();
    w_.entity("FILE_NAME").text(library.name).text("");
    w_.list().text("").end().list().text("").end().text("Capstan").text("Capstan").text("").end();
    w_.entity("FILE_SCHEMA").list().text("CUTTING_TOOL_SCHEMA_ARM").end().end();
    w_.data();
    language_ = next();
    w_.instance(language_, "LANGUAGE").omitted().text("eng").end();
    scope_ = next();
    w_.instance(scope_, "PLIB_CLASS_REFERENCE").text(kDictionaryClass).text(kDictionary).text(kVersion).end();
  }

  void item(const CatalogueItem& item) {
    const auto role = find_kept(item.kept, "role");
    const auto definition = outline(item.description, item.id, find_kept(item.kept, "name"),
                                    role == nullptr ? "tool item" : *role, item.manufacturer);
    if (item.cutter_class)
      classify(definition.item, "ISO 14649-111 tool body", model::to_text(*item.cutter_class));
    if (const std::string* why = find_kept(item.kept, kLeftOut)) classify(definition.item, kNotPlanned, *why);
    if (!item.kind.empty()) classify(definition.item, "class", item.kind);
    for (const Property& p : item.properties) property(p, definition.definition);
    tell(item);
    ++out_.report.tools;
  }

  void holder(const Holder& h) {
    const auto d = outline(h.description, h.id, nullptr, "adaptive item", h.manufacturer);
    if (!h.connection.empty()) property(text_property("CZCMS", h.connection, ""), d.definition);
    if (h.gage_length_mm)
      property(number_property("LPR", *h.gage_length_mm, h.inches ? "in" : "mm", ValueState::kStated, ""),
               d.definition);
    if (!h.segments.empty()) drop(h.id, "outline", "properties of ISO 13399 hold no outline");
  }

  [[nodiscard]] std::string finish() && { return std::move(w_).finish(); }

  void drop(const std::string& tool, std::string field, std::string what) {
    out_.report.dropped.push_back({tool, std::move(field), std::move(what)});
  }

 private:
  struct Ids {
    std::uint64_t item, definition;
  };
  std::uint64_t next() { return ++last_; }

  std::uint64_t words(std::string_view text) {
    const auto one = next();
    w_.instance(one, "STRING_WITH_LANGUAGE").text(text).reference(language_).end();
    const auto all = next();
    w_.instance(all, "MULTI_LANGUAGE_STRING").list().end().reference(one).end();
    return all;
  }

  Ids outline(std::string_view description, std::string_view id, const std::string* name,
              std::string_view role, std::string_view maker) {
    const auto about = words(description);
    const auto called = name == nullptr ? 0 : words(*name);
    const Ids out{next(), next() + 1};
    const auto version = out.definition - 1;
    last_ = out.definition;
    w_.instance(out.item, "ITEM").reference(about).text(id);
    if (called == 0) {
      w_.omitted().end();
    } else {
      w_.reference(called).end();
    }
    w_.instance(version, "ITEM_VERSION").reference(out.item).omitted().text(id).end();
    w_.instance(out.definition, "ITEM_DEFINITION").reference(version).omitted().text(id).omitted().end();
    w_.instance(next(), "SPECIFIC_ITEM_CLASSIFICATION")
        .list()
        .reference(out.item)
        .end()
        .text(role)
        .omitted()
        .end();
    if (!maker.empty()) {
      const auto who = next();
      w_.instance(who, "ORGANIZATION")
          .omitted()
          .text("")
          .text(maker)
          .text("company")
          .omitted()
          .omitted()
          .end();
      w_.instance(next(), "PERSON_ORGANIZATION_ASSIGNMENT").reference(who).omitted();
      w_.list().reference(out.item).end().text("supplier").end();
    }
    return out;
  }

  void classify(std::uint64_t item, std::string_view about, std::string_view id) {
    const auto general = next();
    w_.instance(general, "GENERAL_CLASSIFICATION")
        .omitted()
        .text(about)
        .text(id)
        .list()
        .end()
        .omitted()
        .end();
    w_.instance(next(), "CLASSIFICATION_ASSOCIATION")
        .reference(general)
        .reference(item)
        .omitted()
        .omitted()
        .end();
  }

  /// A number without a unit is in ours.
  static std::string unit_of(const Property& p) {
    if (p.unit == "\"") return "in";
    if (!p.unit.empty() || !p.number) return p.unit;
    const SymbolFact* fact = symbol_fact(p.symbol);
    if (fact != nullptr && fact->quantity == Quantity::kLength) return "mm";
    if (fact != nullptr && fact->quantity == Quantity::kAngle) return "rad";
    return p.symbol == "WT" ? "kg" : p.symbol == "RPMX" ? "1/min" : "";
  }

  std::uint64_t unit(const std::string& name) {
    for (const auto& [known, id] : units_)
      if (known == name) return id;
    const auto id = next();
    w_.instance(id, "UNIT").text(name).end();
    units_.emplace_back(name, id);
    return id;
  }

  void property(const Property& p, std::uint64_t definition) {
    const IsoName* name = find_symbol(p.symbol);
    std::uint64_t source = 0;
    if (name != nullptr && !name->bsu.empty()) {
      source = next();
      w_.instance(source, "PLIB_PROPERTY_REFERENCE").text(name->bsu).reference(scope_).text("1").end();
    }
    // The newer symbol of a shank's diameter; the reader knows both.
    const std::string symbol = p.symbol == "DMM" ? "DCONMS" : p.symbol;
    std::string about;
    if (p.state != ValueState::kStated) about = std::string(to_text(p.state)) + ": " + p.source;
    const std::string unit_name = unit_of(p);
    const std::uint64_t unit_id = unit_name.empty() ? 0 : unit(unit_name);
    const auto property = next(), value = next(), representation = next(), association = next();
    w_.instance(property, "PROPERTY").list().end().text(about).text(symbol);
    ref(source).omitted().omitted().end();
    if (p.number && symbol_fact(p.symbol) != nullptr) {
      w_.instance(value, "NUMERICAL_VALUE").text(symbol).omitted();
      ref(unit_id).text(p.text.empty() ? shortest(*p.number) : p.text).end();
    } else if (p.number && unit_id != 0) {
      w_.instance(value, "NUMERICAL_VALUE").text(symbol).omitted().reference(unit_id).text(p.text).end();
    } else {
      w_.instance(value, "STRING_VALUE").text(symbol).text(p.text).end();
    }
    w_.instance(representation, "PROPERTY_VALUE_REPRESENTATION").reference(property).omitted().omitted();
    w_.reference(value).omitted().end();
    w_.instance(association, "PROPERTY_VALUE_ASSOCIATION").omitted().reference(definition);
    w_.reference(representation).omitted().omitted().end();
  }

  p21::Writer& ref(std::uint64_t id) { return id == 0 ? w_.omitted() : w_.reference(id); }

  void tell(const CatalogueItem& item) {
    if (!item.presets.empty())
      drop(item.id, "presets",
           std::to_string(item.presets.size()) + " start values: not written to ISO 13399");
    if (!item.product_link.empty()) drop(item.id, "product_link", "not written to ISO 13399");
    if (!item.product_id.empty() && item.product_id != item.id)
      drop(item.id, "product_id", "the item's id is written");
    for (const auto& [path, text] : item.kept)
      if (path != "name" && path != "role" && path != kLeftOut)
        drop(item.id, path, "of another format, no place for it");
  }

  Exported& out_;
  p21::Writer w_;
  std::uint64_t last_ = 0, language_ = 0, scope_ = 0;
  std::vector<std::pair<std::string, std::uint64_t>> units_;
};

}  // namespace

Result<Exported> write_iso13399(const ToolLibrary& library, const FormatOptions& /*options*/, Job& /*job*/) {
  if (library.items.empty()) return fail({.code = "ISO13399-FORM", .message = "the library has no tool"});
  Exported out;
  Writer w(out);
  w.head(library);
  for (const CatalogueItem& i : library.items) w.item(i);
  for (const Holder& h : library.holders) w.holder(h);
  for (const ToolAssembly& a : library.assemblies)
    if (a.stick_out_mm || a.functional_length_mm || !a.holder.empty())
      w.drop(a.item, "assembly", "stick-out and holder of an assembly are not written to ISO 13399");
  for (const ToolInstance& i : library.instances)
    w.drop(i.item, "instance", "stock, life and measures of a piece are not written to ISO 13399");
  for (const MachineEntry& e : library.entries)
    w.drop(e.assembly, "table", "tool number " + std::to_string(e.number) + ": ISO 13399 has no tool table");
  out.bytes = std::move(w).finish();
  return out;
}

}  // namespace capstan::tooling

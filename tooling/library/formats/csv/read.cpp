#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "planner/ground/base/number.h"
#include "planner/ground/base/text.h"
#include "tooling/library/formats/csv/csv.h"
#include "tooling/library/formats/fusion/keys.h"
#include "tooling/library/formats/values.h"
#include "tooling/library/words/comment_words.h"
#include "tooling/shop/data/tree.h"

namespace capstan::tooling::csv {
namespace {

constexpr std::size_t kFaultsShown = 100;

bool has_field(const ColumnMap& map, std::string_view field) {
  return std::any_of(map.columns.begin(), map.columns.end(),
                     [field](const Column& c) { return c.field == field; });
}

class Reader {
 public:
  Reader(const std::string& file, const ColumnMap& map, const FormatOptions& options, Job& job)
      : file_(file), map_(map), job_(job), comma_(map.decimal == ',') {
    unit_ = map.unit;
    if (unit_.empty() && options.mm_per_unit) unit_ = *options.mm_per_unit == kMmPerInch ? "in" : "mm";
    grouped_ = has_field(map, "group");
  }

  Result<Imported> read(const std::vector<SeparatedRow>& rows) {
    out_.library.source = file_;
    out_.library.kept.emplace_back(kMapKey, map_text(map_));
    for (const Column& c : map_.columns)
      if (c.field == "ignore") out_.report.dropped.push_back({"", c.title, "the column map says: ignore"});
    for (std::size_t r = 1; r < rows.size() && faults_.size() < kFaultsShown; ++r) row(rows[r]);
    if (auto d = tell(std::move(faults_), job_)) return fail(*std::move(d));
    std::string kept;
    for (const Column& c : map_.columns)
      if (c.field == "keep" && !c.title.starts_with("kept.")) kept += (kept.empty() ? "" : ", ") + c.title;
    if (!kept.empty()) out_.report.derived.push_back({"", "columns", "kept as they are, not used: " + kept});
    finish();
    out_.report.tools = out_.library.items.size();
    return std::move(out_);
  }

 private:
  struct Open {
    std::size_t item = 0;
    int rows = 0;
    std::map<std::string, std::string> first;  // kept cells of the first row
  };

  [[nodiscard]] Place place(std::string_view column) const {
    return {file_, row_->line,
            (words_.empty() ? "" : words_ + ", ") + "column '" + std::string(column) + "'"};
  }
  void refuse(std::string_view column, const char* code, std::string message, std::string expected,
              std::string hint = "correct the cell") {
    faults_.push_back(
        fault_at(place(column), code, std::move(message), std::move(expected), std::move(hint)));
  }
  /// The cell of a field, without blanks; empty if there is none.
  [[nodiscard]] std::string cell_of(std::string_view field) const {
    for (std::size_t k = 0; k < map_.columns.size(); ++k)
      if (map_.columns[k].field == field) return std::string(trimmed_text(row_->cells[k]));
    return {};
  }
  [[nodiscard]] std::string title_of(std::string_view field) const {
    for (const Column& c : map_.columns)
      if (c.field == field) return c.title;
    return std::string(field);
  }

  void row(const SeparatedRow& r) {
    row_ = &r;
    unit_told_ = false;
    words_.clear();
    if (r.cells.size() != map_.columns.size()) {
      faults_.push_back(fault_at({file_, r.line, ""}, "CSV-SYNTAX",
                                 "the row has " + std::to_string(r.cells.size()) + " cells, the first row " +
                                     std::to_string(map_.columns.size()),
                                 "as many cells as titles",
                                 "put cells that hold the separator (a decimal comma) in quotes"));
      return;
    }
    if (std::all_of(r.cells.begin(), r.cells.end(),
                    [](const std::string& c) { return trimmed_text(c).empty(); }))
      return;
    words_ = cell_of("description").substr(0, 80);
    std::string key = cell_of(grouped_ ? "group" : "id");
    const auto at = key.empty() ? open_.end() : open_.find(key);
    if (at != open_.end()) {
      again(at->second, key);
      return;
    }
    Open o;
    o.item = out_.library.items.size();
    if (!tool(o)) return;
    if (key.empty()) key = out_.library.items.back().id;
    o.rows = 1;
    open_.emplace(key, std::move(o));
  }

  /// A further row of a tool brings a preset.
  void again(Open& o, const std::string& key) {
    if (!has_field(map_, "preset")) {
      refuse(title_of("id"), "TOOL-ID", "the id '" + key + "' is given twice", "ids that differ");
      return;
    }
    CatalogueItem& item = out_.library.items[o.item];
    preset(item);
    keep(item, o, o.rows++);
  }

  bool tool(Open& o) {
    const std::size_t before = faults_.size();
    CatalogueItem item;
    item.description = cell_of("description");
    item.manufacturer = cell_of("manufacturer");
    item.product_id = cell_of("product_id");
    item.product_link = cell_of("product_link");
    kind(item);
    const std::string unit = row_unit();
    item.inches = unit == "in";
    sizes(item, unit);
    std::string id = cell_of("id");
    if (id.empty()) id = item.description;
    if (id.empty()) id = item.product_id;
    if (id.empty() && !cell_of("number").empty()) id = "T" + cell_of("number");
    if (id.empty()) id = "line " + std::to_string(row_->line);
    item.id = unique_id(id, ids_);
    ToolAssembly a;
    a.id = a.item = item.id;
    a.stick_out_mm = length("stick_out", unit);
    if (!a.stick_out_mm) a.stick_out_mm = number_of(item, "LPR");
    a.functional_length_mm = length("length", unit);
    fusion::derive(item, a, out_.report);
    states(item);
    a.holder = holder(unit);
    a.instance = instance(item.id);
    entry(a.id);
    preset(item);
    if (faults_.size() != before) return false;
    keep(item, o, 0);
    out_.library.items.push_back(std::move(item));
    out_.library.assemblies.push_back(std::move(a));
    return true;
  }

  void kind(CatalogueItem& item) {
    const std::string stated = cell_of("class");
    item.kind = cell_of("kind");
    if (!stated.empty()) {
      item.cutter_class = model::cutter_class_from_text(stated);
      if (!item.cutter_class)
        refuse(title_of("class"), "DATA-UNKNOWN", "'" + stated + "' is no class of cutter",
               "endmill, twist_drill, ...", "see tooling/data/README.md");
      return;
    }
    item.cutter_class = fusion::class_of(item.kind);
    if (item.cutter_class || fusion::is_type(item.kind)) return;
    item.cutter_class = model::cutter_class_from_text(item.kind);
    if (item.cutter_class) return;
    const char* from = "the words of its kind";
    item.cutter_class = class_from_words(item.kind);
    if (!item.cutter_class && item.kind.empty()) {
      item.cutter_class = class_from_words(item.description);
      from = "the words of its description";
    }
    if (!item.cutter_class) return;
    Property p = text_property("CLASS", model::to_text(*item.cutter_class), from);
    p.state = ValueState::kDerived;
    item.properties.push_back(std::move(p));
    out_.report.derived.push_back({words_, "class", std::string("from ") + from});
  }

  /// Unit of lengths whose column states none: the row's, else the map's; empty if neither states one.
  std::string row_unit() {
    const std::string stated = cell_of("unit");
    if (stated.empty()) return unit_;
    const auto f = mm_per_unit_of(stated);
    if (!f) {
      unit_told_ = true;
      refuse(title_of("unit"), "DATA-UNIT", "the unit '" + stated + "' is not known", "mm or inch");
      return {};
    }
    return *f == 1.0 ? "mm" : "in";
  }

  [[nodiscard]] static std::string unit_of(const Column& c, const std::string& row_unit) {
    return c.unit.empty() || c.unit == "L" ? row_unit : c.unit;
  }

  void unit_missing(std::string_view title, std::string_view field) {
    if (std::exchange(unit_told_, true)) return;
    refuse(title, "DATA-UNIT", "the unit of " + std::string(field) + " is missing", "mm or inch",
           "name it in the title ([mm]), in a column 'unit', or as unit: in the column map");
  }

  void sizes(CatalogueItem& item, const std::string& row_unit) {
    for (std::size_t k = 0; k < map_.columns.size(); ++k) {
      const Column& c = map_.columns[k];
      const std::string text(trimmed_text(row_->cells[k]));
      if (text.empty()) continue;
      std::string symbol = c.field;
      if (symbol.starts_with("text.")) {
        item.properties.push_back(text_property(symbol.substr(5), text, c.title));
        continue;
      }
      const bool named = symbol.starts_with("prop.");
      if (named) symbol.erase(0, 5);
      const SymbolFact* fact = symbol_fact(symbol);
      const fusion::GeometryKey* key = nullptr;
      for (const auto& g : fusion::kGeometry)
        if (g.symbol == symbol) key = &g;
      if (fact == nullptr && key == nullptr && !named) continue;
      if (fact != nullptr && fact->quantity == Quantity::kText) {
        item.properties.push_back(text_property(symbol, word(symbol, text), c.title));
        continue;
      }
      std::string unit;
      const bool angle =
          fact != nullptr ? fact->quantity == Quantity::kAngle : key != nullptr && key->unit == "deg";
      const bool sized =
          fact != nullptr ? fact->quantity == Quantity::kLength : key != nullptr && key->unit == "L";
      if (angle || c.unit == "deg") {
        unit = "deg";
      } else if (sized || !c.unit.empty()) {
        unit = unit_of(c, row_unit);
      }
      if (sized && unit.empty()) {
        unit_missing(c.title, symbol);
        continue;
      }
      auto p = property(symbol, text, unit, c.title);
      if (p) item.properties.push_back(*std::move(p));
    }
  }

  static std::string word(const std::string& symbol, const std::string& text) {
    const std::string low = lower_text(text);
    if (symbol == "HAND")
      return low == "false" || low == "left" || low == "l" || low == "links" ? "left" : "right";
    if (symbol == "CSP" || symbol == "CCC")
      return low == "yes" || low == "true" || low == "1" || low == "ja" ? "true" : "false";
    return text;
  }

  std::optional<Property> property(const std::string& symbol, const std::string& text,
                                   const std::string& unit, const std::string& title) {
    if (comma_ && text.find('.') != std::string::npos) {
      refuse(title, "DATA-NUMBER", "'" + text + "' has a point, the table decimal commas",
             "a decimal comma and no thousands marks");
      return std::nullopt;
    }
    auto p = property_from(symbol, text, unit, title, place(title), comma_);
    if (p) return *std::move(p);
    faults_.push_back(p.error());
    return std::nullopt;
  }
  std::optional<double> number(std::string_view field, double factor = 1.0) {
    const std::string text = cell_of(field);
    if (text.empty()) return std::nullopt;
    const auto p = property("", text, "", title_of(field));
    if (!p || !p->number) return std::nullopt;
    if (*p->number < 0.0 && !field.starts_with("offset.")) {
      refuse(title_of(field), "TOOL-VALUE", text + " is negative", "a number of at least 0");
      return std::nullopt;
    }
    return *p->number * factor;
  }
  std::optional<double> length(std::string_view field, const std::string& row_unit) {
    for (const Column& c : map_.columns) {
      if (c.field != field || cell_of(field).empty()) continue;
      const std::string unit = unit_of(c, row_unit);
      const auto f = mm_per_unit_of(unit);
      if (!f) {
        unit_missing(c.title, field);
        return std::nullopt;
      }
      return number(field, *f);
    }
    return std::nullopt;
  }
  std::optional<int> whole(std::string_view field, double most) {
    const auto v = number(field);
    if (!v) return std::nullopt;
    if (*v != std::floor(*v) || *v > most) {
      refuse(title_of(field), field == "number" ? "TOOL-NUMBER" : "TOOL-VALUE", cell_of(field),
             "a whole number from 0 to " + trimmed(most, 0));
      return std::nullopt;
    }
    return static_cast<int>(*v);
  }

  /// "LU=derived; CW=default": what was not stated when the table was written.
  void states(CatalogueItem& item) {
    std::string_view text;
    const std::string all = cell_of("not_stated");
    for (text = all; !text.empty();) {
      const auto end = std::min(text.find(';'), text.size());
      const std::string_view one = trimmed_text(text.substr(0, end));
      text.remove_prefix(std::min(end + 1, text.size()));
      const auto eq = one.find('=');
      if (eq == std::string_view::npos) continue;
      for (Property& p : item.properties) {
        if (p.symbol != one.substr(0, eq)) continue;
        if (one.substr(eq + 1) == "derived") p.state = ValueState::kDerived;
        if (one.substr(eq + 1) == "default") p.state = ValueState::kDefault;
      }
    }
  }

  std::string holder(const std::string& row_unit) {
    Holder h;
    h.id = cell_of("holder.id");
    h.description = cell_of("holder.description");
    h.manufacturer = cell_of("holder.manufacturer");
    h.product_id = cell_of("holder.product_id");
    h.product_link = cell_of("holder.product_link");
    h.gage_length_mm = length("holder.gage", row_unit);
    h.inches = row_unit == "in";
    segments(h, row_unit);
    if (h.id.empty() && h.description.empty() && h.segments.empty()) return {};
    if (h.id.empty()) h.id = h.description.empty() ? "holder" : h.description;
    for (const Holder& o : out_.library.holders)
      if (o == h) return o.id;
    // Another one of that name.
    h.id = unique_id(h.id, holder_ids_);
    out_.library.holders.push_back(h);
    return h.id;
  }

  void segments(Holder& h, const std::string& row_unit) {
    const std::string text = cell_of("holder.segments");
    if (text.empty()) return;
    const auto f = mm_per_unit_of(row_unit);
    const auto wrong = [&] {
      refuse(title_of("holder.segments"), f ? "TOOL-VALUE" : "DATA-UNIT",
             f ? "'" + text.substr(0, 60) + "' is no list of holder segments" : "the unit is missing",
             "H6.5 L7.5 U7.5; ... in the tool's unit");
    };
    if (!f) return wrong();
    std::string_view rest = text;
    while (!rest.empty()) {
      const auto end = std::min(rest.find(';'), rest.size());
      std::string_view one = trimmed_text(rest.substr(0, end));
      rest.remove_prefix(std::min(end + 1, rest.size()));
      model::HolderSegment s;
      int seen = 0;
      while (!one.empty()) {
        const std::string_view w = one.substr(0, one.find(' '));
        one = trimmed_text(one.substr(w.size()));
        const auto v = parse_double(w.substr(1));
        double* into = w[0] == 'H'   ? &s.height_mm
                       : w[0] == 'L' ? &s.lower_diameter_mm
                       : w[0] == 'U' ? &s.upper_diameter_mm
                                     : nullptr;
        if (!v || into == nullptr || *v < 0.0) return wrong();
        *into = *v * *f;
        ++seen;
      }
      if (seen != 3) return wrong();
      h.segments.push_back(s);
    }
  }

  std::string instance(const std::string& item) {
    ToolInstance i;
    i.id = i.item = item;
    i.in_stock = whole("in_stock", 1e6);
    i.price = number("price");
    i.life_min = number("life_min");
    i.life_used_min = number("life_used_min");
    if (!i.in_stock && !i.price && !i.life_min && !i.life_used_min) return {};
    out_.library.instances.push_back(i);
    return i.id;
  }

  void entry(const std::string& assembly) {
    MachineEntry e;
    e.number = whole("number", kMostToolNumber).value_or(0);
    e.pocket = whole("pocket", kMostToolNumber);
    e.carousel = cell_of("carousel");
    e.comment = cell_of("comment");
    e.assembly = assembly;
    for (const char letter : std::string_view("XYZABCUVWDIJQ"))
      if (const auto v = number(std::string("offset.") + letter)) e.offsets.emplace_back(letter, *v);
    if (e.number == 0 && !e.pocket && e.comment.empty() && e.offsets.empty()) return;
    if (e.number > 0) {
      const auto [at, fresh] = numbers_.emplace(e.number, row_->line);
      // CAM libraries give every tool the same number until it is used; a list of a shop's tools must not.
      if (!fresh && !grouped_)
        refuse(title_of("number"), "TOOL-NUMBER",
               "tool number " + std::to_string(e.number) + " is given twice, first in line " +
                   std::to_string(at->second),
               "each tool number once", "give one of the tools another number");
      if (!fresh && grouped_)
        out_.report.derived.push_back(
            {words_, "number", "tool number " + std::to_string(e.number) + " is given to several tools"});
    }
    out_.library.entries.push_back(std::move(e));
  }

  void preset(CatalogueItem& item) {
    Preset p;
    p.name = cell_of("preset");
    p.material = cell_of("preset.material");
    p.coolant = cell_of("preset.coolant");
    bool any = false;
    for (const auto& k : fusion::kPreset) {
      const std::string field = "preset." + std::string(k.key);
      p.*k.field = number(field, fusion::preset_factor(k.unit, item.inches));
      any = any || (p.*k.field).has_value();
    }
    // Titles without any preset's name or value mean no preset.
    if (p.name.empty() && p.material.empty() && !any) return;
    p.source = "preset '" + p.name + "'";
    item.presets.push_back(std::move(p));
  }

  void keep(CatalogueItem& item, Open& o, int number_of_row) {
    for (std::size_t k = 0; k < map_.columns.size(); ++k) {
      const Column& c = map_.columns[k];
      if (c.field != "keep") continue;
      const std::string& text = row_->cells[k];
      const bool ours = c.title.starts_with("kept.");
      std::string path = ours ? c.title.substr(5) : "csv." + c.title;
      if (number_of_row == 0) {
        o.first[c.title] = text;
        if (!text.empty()) item.kept.emplace_back(std::move(path), text);
      } else if (text != o.first[c.title]) {
        item.kept.emplace_back("csv#" + std::to_string(number_of_row) + "." + c.title, text);
      }
    }
  }

  /// Reports tools that planning cannot use.
  void finish() {
    for (const CatalogueItem& i : out_.library.items)
      if (!i.cutter_class)
        out_.report.dropped.push_back({i.id, "class", "'" + i.kind + "' names no kind of cutter"});
  }

  const std::string& file_;
  const ColumnMap& map_;
  Job& job_;
  bool comma_, grouped_ = false;
  bool unit_told_ = false;  // one fault a row suffices
  std::string unit_, words_;
  const SeparatedRow* row_ = nullptr;
  Imported out_;
  std::map<std::string, Open> open_;
  UniqueIds ids_, holder_ids_;
  std::map<int, std::uint64_t> numbers_;
  std::vector<Diagnostic> faults_;
};

}  // namespace

Result<Imported> read_rows(const std::vector<SeparatedRow>& rows, const ColumnMap& map,
                           const std::string& file, const FormatOptions& options, Job& job) {
  return Reader(file, map, options, job).read(rows);
}

}  // namespace capstan::tooling::csv

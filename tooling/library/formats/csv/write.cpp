#include <algorithm>
#include <map>
#include <set>

#include "planner/ground/base/number.h"
#include "tooling/library/formats/csv/csv.h"
#include "tooling/library/formats/fusion/keys.h"
#include "tooling/library/formats/values.h"

namespace capstan::tooling::csv {
namespace {

/// A tool, and the preset of the row.
struct Line {
  const CatalogueItem* item = nullptr;
  const ToolAssembly* assembly = nullptr;
  const Holder* holder = nullptr;
  const MachineEntry* entry = nullptr;
  const ToolInstance* instance = nullptr;
  std::string id;
  const Preset* preset = nullptr;
  std::size_t row = 0;  ///< of the tool
};

std::string kept_title(const std::string& path) {
  return path.starts_with("csv.") ? path.substr(4) : "kept." + path;
}

class Writer {
 public:
  explicit Writer(const ToolLibrary& library) : l_(library) {
    for (const auto& h : l_.holders) holders_.emplace(h.id, &h);
    for (const auto& e : l_.entries)
      if (!e.assembly.empty()) entries_.emplace(e.assembly, &e);
    for (const auto& i : l_.instances) instances_.emplace(i.id, &i);
    for (const auto& e : l_.entries)
      if (e.number > 0 && !e.assembly.empty()) numbers_.emplace(e.number, e.assembly);
    for (const auto& i : l_.items) items_.emplace(i.id, &i);
    gather();
  }

  /// The columns that this library needs.
  [[nodiscard]] ColumnMap columns() const {
    ColumnMap map;
    const auto add = [&map](std::string title, std::string field, std::string unit = "") {
      map.columns.push_back({std::move(title), std::move(field), std::move(unit)});
    };
    for (const char* f : {"id", "description", "kind", "class", "manufacturer", "product_id", "product_link",
                          "number", "pocket", "carousel", "comment", "unit"})
      if (used(f) || std::string_view(f) == "id" || std::string_view(f) == "unit") add(f, f);
    properties(map);
    for (const char* f : {"stick_out",          "length",
                          "not_stated",         "holder.id",
                          "holder.description", "holder.manufacturer",
                          "holder.product_id",  "holder.product_link",
                          "holder.gage",        "holder.segments",
                          "in_stock",           "price",
                          "life_min",           "life_used_min",
                          "offset.X",           "offset.Y",
                          "offset.Z",           "offset.A",
                          "offset.B",           "offset.C",
                          "offset.U",           "offset.V",
                          "offset.W",           "offset.D",
                          "offset.I",           "offset.J",
                          "offset.Q",           "preset",
                          "preset.material",    "preset.coolant"})
      if (used(f)) add(f, f);
    for (const auto& k : fusion::kPreset)
      if (const std::string f = "preset." + std::string(k.key); used(f)) add(f, f);
    std::set<std::string> titles;
    for (const auto& i : l_.items)
      for (const auto& [path, text] : i.kept) {
        const std::string title =
            path.starts_with("csv#") ? path.substr(path.find('.') + 1) : kept_title(path);
        if (titles.insert(title).second) add(title, "keep");
      }
    return map;
  }

  Exported write(const ColumnMap& map) {
    Exported out;
    map_ = &map;
    const auto row = [&](const std::vector<std::string>& cells) {
      for (std::size_t k = 0; k < cells.size(); ++k) {
        if (k > 0) out.bytes.push_back(map.separator);
        out.bytes += separated_cell(cells[k], map.separator);
      }
      out.bytes.push_back('\n');
    };
    std::vector<std::string> cells;
    for (const Column& c : map.columns) cells.push_back(c.title);
    row(cells);
    for (const Line& line : lines_) {
      cells.clear();
      for (const Column& c : map.columns) cells.push_back(value(line, c));
      row(cells);
    }
    out.report = report(map);
    return out;
  }

 private:
  void gather() {
    std::map<std::string, std::vector<const ToolAssembly*>> of;
    for (const auto& a : l_.assemblies) of[a.item].push_back(&a);
    for (const auto& i : l_.items) {
      const auto at = of.find(i.id);
      if (at == of.end()) {
        Line line;
        line.item = &i;
        line.id = i.id;
        rows_of(line);
        continue;
      }
      for (const ToolAssembly* a : at->second) {
        Line line;
        line.item = &i;
        line.assembly = a;
        line.id = a->id;
        if (const auto h = holders_.find(a->holder); h != holders_.end()) line.holder = h->second;
        if (const auto e = entries_.find(a->id); e != entries_.end()) line.entry = e->second;
        if (const auto n = instances_.find(a->instance); n != instances_.end()) line.instance = n->second;
        rows_of(line);
      }
    }
  }
  void rows_of(Line line) {
    const auto& presets = line.item->presets;
    do {
      if (line.row < presets.size()) line.preset = &presets[line.row];
      lines_.push_back(line);
      ++line.row;
    } while (line.row < presets.size());
  }

  [[nodiscard]] bool used(std::string_view field) const {
    const Column c{"", std::string(field), ""};
    return std::any_of(lines_.begin(), lines_.end(),
                       [&](const Line& line) { return !value(line, c).empty(); });
  }

  void properties(ColumnMap& map) const {
    std::set<std::string> seen;
    for (const auto& i : l_.items) {
      for (const Property& p : i.properties) {
        if (p.symbol == "CLASS") continue;
        const SymbolFact* fact = symbol_fact(p.symbol);
        bool known = fact != nullptr;
        for (const auto& g : fusion::kGeometry) known = known || g.symbol == p.symbol;
        const std::string field = known ? p.symbol : (p.number ? "prop." : "text.") + p.symbol;
        if (!seen.insert(field).second) continue;
        std::string title = field, unit;
        if (p.number && (p.unit == "deg" || p.unit == "rad")) {
          title += " [deg]";
          unit = "deg";
        } else if (p.number && mm_per_unit_of(p.unit)) {
          if (!known) title += " [tool unit]";
          unit = "L";
        }
        map.columns.push_back({title, field, unit});
      }
    }
  }

  [[nodiscard]] std::string number(std::string text) const {
    if (map_ != nullptr && map_->decimal == ',') std::replace(text.begin(), text.end(), '.', ',');
    return text;
  }
  [[nodiscard]] std::string number(const std::optional<double>& v, double factor) const {
    return v ? number(spelled(*v, factor)) : std::string();
  }

  [[nodiscard]] std::string value(const Line& line, const Column& c) const {
    const std::string& f = c.field;
    const CatalogueItem& i = *line.item;
    const std::string tool_unit = i.inches ? "in" : "mm";
    const std::string unit = c.unit == "mm" || c.unit == "in" ? c.unit
                             : map_unit().empty()             ? tool_unit
                                                              : map_unit();
    const double mm = *mm_per_unit_of(unit);
    if (f == "keep") return kept(line, c.title);
    if (f == "id") return line.id;
    if (f == "group") return line.id;
    if (f == "description") return i.description;
    if (f == "kind") return i.kind;
    if (f == "class") return i.cutter_class ? std::string(model::to_text(*i.cutter_class)) : "";
    if (f == "manufacturer") return i.manufacturer;
    if (f == "product_id") return i.product_id;
    if (f == "product_link") return i.product_link;
    if (f == "unit") return tool_unit;
    if (f == "not_stated") return not_stated(i);
    if (f.starts_with("holder.")) return holder(line, f.substr(7), mm);
    if (f.starts_with("preset")) return preset(line, f);
    if (f == "stick_out" || f == "length") {
      if (line.assembly == nullptr) return {};
      return number(f == "length" ? line.assembly->functional_length_mm : line.assembly->stick_out_mm, mm);
    }
    if (std::string text; entry(line, f, text)) return text;
    if (f == "in_stock" || f == "price" || f == "life_min" || f == "life_used_min") {
      if (line.instance == nullptr) return {};
      if (f == "in_stock") return line.instance->in_stock ? std::to_string(*line.instance->in_stock) : "";
      return number(f == "price"      ? line.instance->price
                    : f == "life_min" ? line.instance->life_min
                                      : line.instance->life_used_min,
                    1.0);
    }
    const std::string symbol = f.starts_with("prop.") || f.starts_with("text.") ? f.substr(5) : f;
    const Property* p = find(i.properties, symbol);
    if (p == nullptr) return {};
    if (!p->number) return p->text;
    if (p->unit == "deg" || p->unit == "rad") return number(spelled_in(*p, "deg"));
    if (mm_per_unit_of(p->unit)) return number(spelled_in(*p, unit));
    return number(spelled_in(*p, ""));
  }
  [[nodiscard]] std::string map_unit() const { return map_ == nullptr ? std::string() : map_->unit; }

  [[nodiscard]] static std::string kept(const Line& line, const std::string& title) {
    const auto& all = line.item->kept;
    if (line.row > 0)
      if (const auto* t = find_kept(all, "csv#" + std::to_string(line.row) + "." + title)) return *t;
    const std::string path = title.starts_with("kept.") ? title.substr(5) : "csv." + title;
    const auto* t = find_kept(all, path);
    return t == nullptr ? std::string() : *t;
  }

  [[nodiscard]] static std::string not_stated(const CatalogueItem& i) {
    std::string out;
    for (const Property& p : i.properties) {
      if (p.state == ValueState::kStated || p.symbol == "CLASS") continue;
      out += (out.empty() ? "" : "; ") + p.symbol + "=" + std::string(to_text(p.state));
    }
    return out;
  }

  [[nodiscard]] std::string holder(const Line& line, const std::string& f, double mm) const {
    if (line.holder == nullptr) return {};
    const Holder& h = *line.holder;
    if (f == "id") return h.id;
    if (f == "description") return h.description;
    if (f == "manufacturer") return h.manufacturer;
    if (f == "product_id") return h.product_id;
    if (f == "product_link") return h.product_link;
    if (f == "gage") return number(h.gage_length_mm, mm);
    return segments_text(h.segments, mm);
  }

  [[nodiscard]] std::string preset(const Line& line, const std::string& f) const {
    if (line.preset == nullptr) return {};
    const Preset& p = *line.preset;
    if (f == "preset") return p.name;
    if (f == "preset.material") return p.material;
    if (f == "preset.coolant") return p.coolant;
    for (const auto& k : fusion::kPreset)
      if (f.substr(7) == k.key) return number(p.*k.field, fusion::preset_factor(k.unit, line.item->inches));
    return {};
  }

  bool entry(const Line& line, const std::string& f, std::string& out) const {
    const bool ours =
        f == "number" || f == "pocket" || f == "carousel" || f == "comment" || f.starts_with("offset.");
    if (!ours) return false;
    if (line.entry == nullptr) return true;
    const MachineEntry& e = *line.entry;
    if (f == "number") {
      // A list of a shop's tools gives each number once.
      const auto owner = numbers_.find(e.number);
      out = owner != numbers_.end() && owner->second == line.id ? std::to_string(e.number) : "";
    } else if (f == "pocket") {
      out = e.pocket ? std::to_string(*e.pocket) : "";
    } else if (f == "carousel") {
      out = e.carousel;
    } else if (f == "comment") {
      out = e.comment;
    } else {
      for (const auto& [letter, v] : e.offsets)
        if (letter == f[7]) out = number(shortest(v));
    }
    return true;
  }

  [[nodiscard]] LossReport report(const ColumnMap& map) const {
    LossReport out;
    out.tools = l_.items.size();
    std::set<std::string> fields;
    for (const Column& c : map.columns) fields.insert(c.field == "keep" ? "keep " + c.title : c.field);
    for (const Column& need : columns().columns) {
      const std::string name = need.field == "keep" ? "keep " + need.title : need.field;
      const bool one_unit = need.field == "unit" && !map.unit.empty();
      const bool as_group = need.field == "id" && fields.contains("group");
      if (!fields.contains(name) && !one_unit && !as_group)
        out.dropped.push_back({"", need.title, "the column map has no column for it"});
    }
    for (const auto& e : l_.entries)
      if (const auto owner = numbers_.find(e.number);
          owner != numbers_.end() && !e.assembly.empty() && owner->second != e.assembly)
        out.dropped.push_back(
            {e.assembly, "number", "tool number " + std::to_string(e.number) + " is that of another tool"});
    for (const auto& e : l_.entries)
      if (e.assembly.empty())
        out.dropped.push_back(
            {"T" + std::to_string(e.number), "", "a line of the tool table without a tool"});
    std::set<std::string> placed, holders;
    for (const Line& line : lines_) {
      if (line.instance != nullptr) placed.insert(line.instance->id);
      if (line.holder != nullptr) holders.insert(line.holder->id);
    }
    for (const auto& i : l_.instances) {
      if (!placed.contains(i.id)) out.dropped.push_back({i.id, "instance", "one piece a row"});
      if (!i.group.empty()) out.dropped.push_back({i.id, "group", "a table has no place for sister tools"});
      if (!i.measured.empty()) out.dropped.push_back({i.id, "measured", "a table has no place for it"});
    }
    for (const auto& h : l_.holders) {
      if (!holders.contains(h.id))
        out.dropped.push_back({h.id, "holder", "a holder without a tool has no row"});
      if (!h.connection.empty()) out.dropped.push_back({h.id, "connection", "a table has no place for it"});
      for (const auto& [path, text] : h.kept)
        out.dropped.push_back({h.id, path, "a table has no place for it"});
    }
    bool derived = false;
    for (const auto& i : l_.items)
      for (const Property& p : i.properties) derived = derived || p.state != ValueState::kStated;
    if (derived)
      out.dropped.push_back(
          {"", "source", "where values that are not stated come from; that they are is kept"});
    for (const auto& [path, text] : l_.kept)
      if (path != kMapKey) out.dropped.push_back({"", path, "a table has no place for it"});
    return out;
  }

  const ToolLibrary& l_;
  const ColumnMap* map_ = nullptr;
  std::map<std::string, const Holder*> holders_;
  std::map<std::string, const MachineEntry*> entries_;
  std::map<std::string, const ToolInstance*> instances_;
  std::map<int, std::string> numbers_;  // of whom
  std::map<std::string, const CatalogueItem*> items_;
  std::vector<Line> lines_;
};

}  // namespace

std::string segments_text(const std::vector<model::HolderSegment>& segments, double mm_per_unit) {
  std::string out;
  for (const auto& s : segments)
    out += (out.empty() ? "H" : "; H") + spelled(s.height_mm, mm_per_unit) + " L" +
           spelled(s.lower_diameter_mm, mm_per_unit) + " U" + spelled(s.upper_diameter_mm, mm_per_unit);
  return out;
}

Result<Exported> write(const ToolLibrary& library, const FormatOptions& options, Job& job) {
  Writer writer(library);
  if (options.column_map.empty()) return writer.write(writer.columns());
  const auto map = read_map(options.column_map, "column map", job);
  if (!map) return fail(map.error());
  return writer.write(*map);
}

}  // namespace capstan::tooling::csv

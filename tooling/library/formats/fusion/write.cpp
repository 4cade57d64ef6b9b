#include <map>

#include "planner/ground/base/number.h"
#include "tooling/library/formats/all.h"
#include "tooling/library/formats/fusion/keys.h"
#include "tooling/library/formats/values.h"
#include "tooling/library/formats/zip.h"

namespace capstan::tooling::fusion {
namespace {

/// The version that Fusion writes today; it reads older ones. Source: exported libraries.
constexpr const char* kVersion = "36";

class Writer {
 public:
  Writer(const ToolLibrary& library, LossReport& report) : l_(library), report_(report) {}

  Result<Json> write() {
    for (const auto& h : l_.holders) holders_.emplace(h.id, &h);
    for (const auto& e : l_.entries)
      if (!e.assembly.empty()) entries_.emplace(e.assembly, &e);
    std::map<std::string, const CatalogueItem*> items;
    for (const auto& i : l_.items) items.emplace(i.id, &i);
    std::map<std::string, std::vector<const ToolAssembly*>> assemblies;
    for (const auto& a : l_.assemblies) assemblies[a.item].push_back(&a);

    Json data = Json::list();
    std::map<std::string, bool> used;
    for (const auto& i : l_.items) {
      const auto at = assemblies.find(i.id);
      if (at == assemblies.end()) {
        tool(i, nullptr, data);
        continue;
      }
      for (const ToolAssembly* a : at->second) {
        used[a->holder] = true;
        tool(i, a, data);
      }
    }
    // Holders listed by themselves follow the tools.
    for (const auto& [key, id] : l_.kept)
      if (key == kListedKey) used.erase(id);
    for (const auto& h : l_.holders)
      if (!used.contains(h.id)) data.items.push_back(holder(h));
    rest();
    Json root = Json::map();
    root.set("data", std::move(data));
    root.set("version", Json::number(kVersion));
    if (auto d = put_kept(l_.kept, "", root)) return fail(*std::move(d));
    if (fault_) return fail(*std::move(fault_));
    sort_keys(root);
    return root;
  }

 private:
  void drop(const std::string& who, std::string field, std::string why) {
    report_.dropped.push_back({who, std::move(field), std::move(why)});
  }

  /// Restores kept texts of Fusion files at their place; texts of other formats have none here.
  std::optional<Diagnostic> put_kept(const std::vector<std::pair<std::string, std::string>>& kept,
                                     const std::string& who, Json& into) {
    for (const auto& [path, text] : kept) {
      if (path == kListedKey || path == kReadKey || path == "left out") continue;
      const auto value = parse_json(text, "kept");
      const bool ours = ours_ && value && path.find(':') == std::string::npos;
      Json* at = &into;
      std::string_view rest = path;
      if (ours && rest.starts_with("presets.")) {
        rest.remove_prefix(8);
        const auto dot = rest.find('.');
        const auto k = parse_double(rest.substr(0, dot));
        Json& start = into.find("start-values") != nullptr ? entry(into, "start-values")
                                                           : into.set("start-values", Json::map());
        Json& list =
            start.find("presets") != nullptr ? entry(start, "presets") : start.set("presets", Json::list());
        if (!k || dot == std::string_view::npos || *k < 0.0 ||
            static_cast<std::size_t>(*k) >= list.items.size()) {
          drop(who, path, "it has no place in a Fusion library");
          continue;
        }
        at = &list.items[static_cast<std::size_t>(*k)];
        rest.remove_prefix(dot + 1);
      } else if (ours) {
        for (const std::string_view section : {"geometry.", "post-process.", "start-values."}) {
          if (!rest.starts_with(section)) continue;
          const std::string_view name = section.substr(0, section.size() - 1);
          at = into.find(name) != nullptr ? &entry(into, name) : &into.set(name, Json::map());
          rest.remove_prefix(section.size());
          break;
        }
      }
      if (!ours) {
        drop(who, path, "it has no place in a Fusion library");
        continue;
      }
      at->set(rest, *value);
    }
    return std::nullopt;
  }
  static Json& entry(Json& map, std::string_view key) {
    for (auto& [name, value] : map.entries)
      if (name == key) return value;
    return map.set(key, Json::map());
  }

  void tool(const CatalogueItem& i, const ToolAssembly* a, Json& data) {
    const std::string who = i.description.empty() ? i.id : i.description;
    const Property* hand = find(i.properties, "HAND");
    const bool left = hand != nullptr && hand->text == "left";
    std::string type = i.kind;
    if (!is_type(type)) {
      const auto t = i.cutter_class ? type_of(*i.cutter_class, left) : std::nullopt;
      if (!t) {
        drop(who, "",
             "Fusion has no kind of tool for '" +
                 (i.cutter_class ? std::string(model::to_text(*i.cutter_class)) : i.kind) + "'");
        return;
      }
      type = *t;
      if (class_of(type) != i.cutter_class)
        report_.derived.push_back({who, "type", "written as '" + type + "', the nearest Fusion has"});
    }
    Json t = Json::map();
    t.set("type", Json::string(type));
    t.set("unit", Json::string(i.inches ? "inches" : "millimeters"));
    t.set("guid", Json::string(a != nullptr ? a->id : i.id));
    t.set("description", Json::string(i.description));
    t.set("vendor", Json::string(i.manufacturer));
    t.set("product-id", Json::string(i.product_id));
    t.set("product-link", Json::string(i.product_link));
    if (const Property* p = find(i.properties, "BMC")) {
      t.set("BMC", Json::string(p->text));
    } else if (const Property* s = find(i.properties, "SUBSTRATE")) {
      t.set("BMC", Json::string(s->text));
    }
    if (const Property* p = find(i.properties, "GRADE")) t.set("GRADE", Json::string(p->text));
    t.set("geometry", geometry(i, a, type, who));
    if (a != nullptr)
      if (const auto h = holders_.find(a->holder); h != holders_.end()) t.set("holder", holder(*h->second));
    post_process(a != nullptr ? a->id : i.id, who, t);
    t.set("start-values", start_values(i));
    if (auto d = put_kept(i.kept, who, t)) fault_ = d;
    data.items.push_back(std::move(t));
    ++report_.tools;
  }

  Json geometry(const CatalogueItem& i, const ToolAssembly* a, const std::string& type,
                const std::string& who) {
    Json g = Json::map();
    const std::string unit = i.inches ? "in" : "mm";
    const double factor = i.inches ? kMmPerInch : 1.0;
    for (const Property& p : i.properties) {
      if (p.symbol == "BMC" || p.symbol == "GRADE") continue;
      if (p.symbol == "SUBSTRATE" && find(i.properties, "BMC") == nullptr) continue;
      if (p.symbol == "HAND" || p.symbol == "CSP") {
        g.set(p.symbol, Json::truth(p.symbol == "HAND" ? p.text != "left" : p.text == "true"));
        continue;
      }
      if (!geometry_number(i, p, type, unit, g) && p.state != ValueState::kDerived)
        drop(who, p.symbol, "a Fusion library has no place for it");
    }
    if (a != nullptr) {
      if (a->stick_out_mm && number_of(i, "LPR") != a->stick_out_mm)
        g.set("LB", Json::number(spelled(*a->stick_out_mm, factor)));
      if (a->functional_length_mm && number_of(i, "assemblyGaugeLength") != a->functional_length_mm)
        g.set("assemblyGaugeLength", Json::number(spelled(*a->functional_length_mm, factor)));
    }
    if (g.find("HAND") == nullptr && class_of(type)) g.set("HAND", Json::truth(type != "tap left hand"));
    return g;
  }

  /// False when there is no key for it.
  bool geometry_number(const CatalogueItem& i, const Property& p, const std::string& type,
                       const std::string& unit, Json& g) {
    if (!p.number) return false;
    const auto put = [&](std::string_view key, std::string_view u) {
      if (g.find(key) == nullptr) g.set(key, Json::number(spelled_in(p, u)));
      return true;
    };
    // Fusion gives half the angle of a chamfer mill.
    if (p.symbol == "SIG" && type == "chamfer mill") {
      if (number_of(i, "TA")) return true;
      g.set("TA", Json::number(spelled(0.5 * *p.number, kRadPerDegree)));
      return true;
    }
    if (p.symbol == "PSIR" && type == "face mill") {
      if (!number_of(i, "TA")) g.set("TA", Json::number(spelled(*p.number, kRadPerDegree)));
      return true;
    }
    if (p.state == ValueState::kDerived && find(i.properties, "shoulder-length") != nullptr) return true;
    if (p.state == ValueState::kDerived && type == "slot mill" && p.symbol == "CW") return true;
    for (const GeometryKey& k : kGeometry)
      if (k.symbol == p.symbol) return put(k.key, k.unit == "L" ? std::string_view(unit) : k.unit);
    if (p.symbol == "APMX") return put("LCF", unit);
    if (p.symbol == "LU") return put("shoulder-length", unit);
    if (p.symbol == "LF") return put("assemblyGaugeLength", unit);
    if (p.symbol == "DN") return put("shoulder-diameter", unit);
    if (p.symbol == "DCONMS") return put("SFDM", unit);
    if (p.symbol == "PCEDC") return put("NOF", "");
    return false;
  }

  Json holder(const Holder& h) const {
    const double factor = h.inches ? kMmPerInch : 1.0;
    Json out = Json::map();
    out.set("type", Json::string("holder"));
    out.set("unit", Json::string(h.inches ? "inches" : "millimeters"));
    out.set("guid", Json::string(h.id));
    out.set("description", Json::string(h.description));
    out.set("vendor", Json::string(h.manufacturer));
    out.set("product-id", Json::string(h.product_id));
    out.set("product-link", Json::string(h.product_link));
    if (h.gage_length_mm) out.set("gaugeLength", Json::number(spelled(*h.gage_length_mm, factor)));
    Json segments = Json::list();
    for (const auto& s : h.segments) {
      Json one = Json::map();
      one.set("height", Json::number(spelled(s.height_mm, factor)));
      one.set("lower-diameter", Json::number(spelled(s.lower_diameter_mm, factor)));
      one.set("upper-diameter", Json::number(spelled(s.upper_diameter_mm, factor)));
      segments.items.push_back(std::move(one));
    }
    out.set("segments", std::move(segments));
    for (const auto& [path, text] : h.kept)
      if (auto value = parse_json(text, "kept"); value && ours_) out.set(path, *std::move(value));
    return out;
  }

  void post_process(const std::string& assembly, const std::string& who, Json& t) {
    const auto e = entries_.find(assembly);
    if (e == entries_.end()) {
      Json post = Json::map();
      post.set("number", Json::number("0"));
      post.set("comment", Json::string(""));
      t.set("post-process", std::move(post));
      return;
    }
    Json post = Json::map();
    post.set("number", Json::number(std::to_string(e->second->number)));
    post.set("comment", Json::string(e->second->comment));
    t.set("post-process", std::move(post));
    if (!e->second->offsets.empty()) drop(who, "offsets", "a Fusion library has no place for table offsets");
    if (e->second->pocket) drop(who, "pocket", "a Fusion library has no place for the pocket");
    if (!e->second->carousel.empty()) drop(who, "carousel", "a Fusion library has no place for it");
  }

  static Json start_values(const CatalogueItem& i) {
    Json list = Json::list();
    for (const Preset& p : i.presets) {
      Json one = Json::map();
      one.set("name", Json::string(p.name));
      if (!p.coolant.empty()) one.set("tool-coolant", Json::string(p.coolant));
      for (const PresetKey& k : kPreset)
        if (p.*k.field) one.set(k.key, Json::number(spelled(*(p.*k.field), preset_factor(k.unit, i.inches))));
      if (!p.material.empty()) {
        Json m = Json::map();
        m.set("category", Json::string("all"));
        m.set("query", Json::string(p.material));
        m.set("use-hardness", Json::truth(false));
        one.set("material", std::move(m));
      }
      list.items.push_back(std::move(one));
    }
    Json out = Json::map();
    out.set("presets", std::move(list));
    return out;
  }

  /// Records without a place.
  void rest() {
    for (const auto& i : l_.instances)
      drop(i.id, "instance", "a Fusion library has no place for stock, life and measured sizes");
    for (const auto& e : l_.entries)
      if (e.assembly.empty())
        drop("T" + std::to_string(e.number), "", "a line of the tool table without a tool");
  }

  const ToolLibrary& l_;
  LossReport& report_;
  bool ours_ = find_kept(l_.kept, kReadKey) != nullptr;
  std::map<std::string, const Holder*> holders_;
  std::map<std::string, const MachineEntry*> entries_;
  std::optional<Diagnostic> fault_;
};

Result<Exported> write_json(const ToolLibrary& library, const FormatOptions&, Job&) {
  Exported out;
  const auto root = write_tree(library, out.report);
  if (!root) return fail(root.error());
  out.bytes = json_text(*root, 4) + "\n";
  return out;
}

Result<Exported> write_packed(const ToolLibrary& library, const FormatOptions& options, Job& job) {
  auto out = write_json(library, options, job);
  if (!out) return fail(out.error());
  auto bytes = write_zip({{"tools.json", std::move(out->bytes)}});
  if (!bytes) return fail(bytes.error());
  out->bytes = *std::move(bytes);
  return out;
}

/// A zip's list of entries is at its end.
bool recognises_packed(std::string_view bytes, std::string_view) {
  return is_zip(bytes) && bytes.rfind("tools.json") != std::string_view::npos;
}

/// The first significant key may follow the tools; a list called data decides.
bool recognises_json(std::string_view bytes, std::string_view) {
  if (bytes.starts_with("\xEF\xBB\xBF")) bytes.remove_prefix(3);
  const std::string_view text = trimmed_text(bytes.substr(0, 4096));
  if (!text.starts_with('{')) return false;
  for (auto at = bytes.find("\"data\""); at != std::string_view::npos; at = bytes.find("\"data\"", at + 6)) {
    std::string_view rest = trimmed_text(bytes.substr(at + 6, 200));
    if (!rest.starts_with(':')) continue;
    rest = trimmed_text(rest.substr(1));
    if (rest.starts_with('[')) return true;
  }
  return false;
}

}  // namespace

Result<Json> write_tree(const ToolLibrary& library, LossReport& report) {
  return Writer(library, report).write();
}

}  // namespace capstan::tooling::fusion

namespace capstan::tooling {

const Format& fusion_format() {
  static const Format kFormat{"fusion",      "Fusion library (.tools)",
                              {".tools"},    &fusion::recognises_packed,
                              &fusion::read, &fusion::write_packed};
  return kFormat;
}

const Format& fusion_json_format() {
  static const Format kFormat{"fusion-json", "Fusion library (.json)", {".json"}, &fusion::recognises_json,
                              &fusion::read, &fusion::write_json};
  return kFormat;
}

}  // namespace capstan::tooling

#include <algorithm>
#include <cmath>
#include <map>

#include "planner/ground/base/number.h"
#include "tooling/library/formats/fusion/keys.h"
#include "tooling/library/formats/values.h"
#include "tooling/library/formats/zip.h"
#include "tooling/shop/data/tree.h"

namespace capstan::tooling::fusion {
namespace {

using model::CutterClass;

/// Entries of a map that nothing of ours holds, as texts.
void keep_rest(const Json& map, const std::string& prefix, const std::vector<std::string_view>& known,
               std::vector<std::pair<std::string, std::string>>& kept) {
  for (const auto& [key, value] : map.entries)
    if (std::find(known.begin(), known.end(), key) == known.end())
      kept.emplace_back(prefix + key, json_text(value));
}

void derived(CatalogueItem& item, const char* symbol, double number, const char* why, LossReport& report) {
  const bool angle = std::string_view(symbol) == "SIG";
  const char* unit = angle ? "deg" : item.inches ? "in" : "mm";
  item.properties.push_back(number_property(symbol, number, unit, ValueState::kDerived, why));
  report.derived.push_back({item.description.empty() ? item.id : item.description, symbol, why});
}

class Reader {
 public:
  Reader(const std::string& file, Job& job) : file_(file), job_(job) {}

  Result<Imported> read(const Json& root) {
    Imported out;
    out_ = &out;
    out.library.source = file_;
    out.library.kept.emplace_back(kReadKey, "");
    const Json* data = root.find("data");
    for (std::size_t i = 0; i < data->items.size(); ++i) {
      const Json& t = data->items[i];
      words_ = tool_words(i, t.text_of("description"));
      if (!t.is(Json::Kind::kMap)) {
        refuse(place(t), "JSON-KIND", "this is no tool", "a map with type, unit and geometry");
      } else if (t.text_of("type") == "holder") {
        if (const std::string id = holder(t); !id.empty()) out.library.kept.emplace_back(kListedKey, id);
      } else {
        tool(t);
      }
      if (faults_.size() >= kFaultsShown) break;
    }
    keep_rest(root, "", {"data"}, out.library.kept);
    if (auto d = tell(std::move(faults_), job_)) return fail(*std::move(d));
    out.report.tools = out.library.items.size();
    return out;
  }

 private:
  static constexpr std::size_t kFaultsShown = 100;

  [[nodiscard]] Place place(const Json& at, std::string_view element = {}) const {
    return {file_, at.line, words_ + (element.empty() ? "" : ", " + std::string(element))};
  }
  void refuse(const Place& p, const char* code, std::string message, std::string expected) {
    faults_.push_back(
        fault_at(p, code, std::move(message), std::move(expected), "correct it in Fusion and export again"));
  }

  /// "mm" or "in"; empty (and a fault) when it is not stated.
  std::string unit_of(const Json& t) {
    const std::string unit = t.text_of("unit");
    if (unit == "millimeters") return "mm";
    if (unit == "inches") return "in";
    refuse(place(t, "unit"), "DATA-UNIT",
           unit.empty() ? "the unit is missing" : "the unit '" + unit + "' is not known",
           "\"unit\": \"millimeters\" or \"inches\"");
    return {};
  }

  void tool(const Json& t) {
    const std::string unit = unit_of(t);
    CatalogueItem item;
    item.kind = t.text_of("type");
    item.cutter_class = class_of(item.kind);
    if (!is_type(item.kind))
      refuse(place(t, "type"), "DATA-UNKNOWN", "'" + item.kind + "' is no kind of tool",
             "a type of Fusion's");
    item.description = t.text_of("description");
    item.manufacturer = t.text_of("vendor");
    item.product_id = t.text_of("product-id");
    item.product_link = t.text_of("product-link");
    item.inches = unit == "in";
    item.id = id_of(t, "tool");
    for (const char* symbol : {"BMC", "GRADE"})
      if (t.find(symbol) != nullptr)
        item.properties.push_back(text_property(symbol, t.text_of(symbol), symbol));
    const Json* geometry = t.find("geometry");
    if (geometry == nullptr || !geometry->is(Json::Kind::kMap)) {
      refuse(place(t, "geometry"), "DATA-MISSING", "the geometry is missing", "a map with DC, LCF, ...");
      return;
    }
    if (unit.empty()) return;
    sizes(*geometry, unit, item);
    ToolAssembly assembly;
    assembly.id = assembly.item = item.id;
    assembly.stick_out_mm = number_of(item, "LPR");
    derive(item, assembly, out_->report);
    if (const Json* h = t.find("holder"); h != nullptr && h->is(Json::Kind::kMap))
      assembly.holder = holder(*h);
    else
      assembly.holder.clear();
    post_process(t, item, assembly.id);
    presets(t, item);
    keep_rest(t, "",
              {"type", "unit", "guid", "description", "vendor", "product-id", "product-link", "BMC", "GRADE",
               "geometry", "holder", "post-process", "start-values"},
              item.kept);
    if (!item.cutter_class)
      out_->report.derived.push_back({item.description.empty() ? item.id : item.description, "type",
                                      "a '" + item.kind + "' is kept, planning does not use it"});
    out_->library.items.push_back(std::move(item));
    out_->library.assemblies.push_back(std::move(assembly));
  }

  std::string id_of(const Json& t, const char* what) {
    const std::string guid = t.text_of("guid");
    const std::string id = unique_id(guid.empty() ? std::string(what) : guid, ids_);
    if (guid.empty())
      out_->report.derived.push_back({words_, "guid", "missing; '" + id + "' is taken"});
    else if (id != guid)
      out_->report.derived.push_back({words_, "guid", "that of another tool; '" + id + "' is taken"});
    return id;
  }

  void sizes(const Json& geometry, const std::string& unit, CatalogueItem& item) {
    std::vector<std::string_view> known = {"HAND", "CSP"};
    for (const GeometryKey& g : kGeometry) {
      known.push_back(g.key);
      const Json* v = geometry.find(g.key);
      if (v == nullptr) continue;
      const Place p = place(*v, "geometry." + std::string(g.key));
      if (!v->is(Json::Kind::kNumber)) {
        // A number in quotes may have a comma; say which.
        if (auto n = number_from(v->text, p); !n)
          faults_.push_back(n.error());
        else
          refuse(p, "DATA-NUMBER", "'" + v->text + "' is a text, not a number", "a number without quotes");
        continue;
      }
      auto property = property_from(g.symbol, v->text, g.unit == "L" ? unit : std::string(g.unit), g.key, p);
      if (property)
        item.properties.push_back(*std::move(property));
      else
        faults_.push_back(property.error());
    }
    for (const char* key : {"HAND", "CSP"}) {
      const Json* v = geometry.find(key);
      if (v == nullptr) continue;
      if (!v->is(Json::Kind::kBool)) {
        refuse(place(*v, std::string("geometry.") + key), "DATA-KIND",
               "'" + v->text + "' is neither true nor false", "true or false");
        continue;
      }
      const bool hand = std::string_view(key) == "HAND";
      item.properties.push_back(text_property(key,
                                              !hand               ? v->text
                                              : v->text == "true" ? "right"
                                                                  : "left",
                                              key));
    }
    keep_rest(geometry, "geometry.", known, item.kept);
  }

  /// Its id in the library; equal ones are one.
  std::string holder(const Json& h) {
    const std::string unit = unit_of(h);
    if (unit.empty()) return {};
    Holder out;
    out.inches = unit == "in";
    out.description = h.text_of("description");
    out.product_id = h.text_of("product-id");
    out.product_link = h.text_of("product-link");
    out.manufacturer = h.text_of("vendor");
    const double factor = out.inches ? kMmPerInch : 1.0;
    out.gage_length_mm = length(h, "gaugeLength", "holder.gaugeLength", factor);
    if (const Json* list = h.find("segments")) {
      for (const Json& s : list->items) {
        model::HolderSegment seg;
        seg.height_mm = length(s, "height", "holder.segments.height", factor).value_or(0.0);
        seg.lower_diameter_mm =
            length(s, "lower-diameter", "holder.segments.lower-diameter", factor).value_or(0.0);
        seg.upper_diameter_mm =
            length(s, "upper-diameter", "holder.segments.upper-diameter", factor).value_or(0.0);
        out.segments.push_back(seg);
      }
    }
    keep_rest(h, "",
              {"type", "unit", "guid", "description", "vendor", "product-id", "product-link", "gaugeLength",
               "segments"},
              out.kept);
    // The guid is kept unchanged: some exporters leave it empty, or give it to different holders.
    const std::string guid = h.text_of("guid");
    out.kept.emplace_back("guid", json_quoted(guid));
    for (const Holder& o : out_->library.holders) {
      out.id = o.id;
      if (o == out) return o.id;
    }
    out.id = unique_id(guid.empty() ? "holder " + out.description : guid, holder_ids_);
    out_->library.holders.push_back(out);
    return out.id;
  }

  std::optional<double> length(const Json& map, const char* key, const char* path, double factor) {
    const Json* v = map.find(key);
    if (v == nullptr) return std::nullopt;
    const auto n = number_from(v->text, place(*v, path));
    if (!n) {
      faults_.push_back(n.error());
      return std::nullopt;
    }
    if (*n < 0.0) refuse(place(*v, path), "TOOL-VALUE", v->text + " is negative", "a length of at least 0");
    return *n * factor;
  }

  void post_process(const Json& t, CatalogueItem& item, const std::string& assembly) {
    const Json* post = t.find("post-process");
    if (post == nullptr) return;
    keep_rest(*post, "post-process.", {"number", "comment"}, item.kept);
    MachineEntry e;
    e.assembly = assembly;
    e.comment = post->text_of("comment");
    if (const Json* v = post->find("number")) {
      const auto n = number_from(v->text, place(*v, "post-process.number"));
      if (!n) {
        faults_.push_back(n.error());
        return;
      }
      if (*n < 0.0 || *n != std::floor(*n) || *n > kMostToolNumber) {
        refuse(place(*v, "post-process.number"), "TOOL-NUMBER", "the tool number is " + v->text,
               "a whole number from 0 to " + std::to_string(kMostToolNumber));
        return;
      }
      e.number = static_cast<int>(*n);
    }
    if (e.number == 0 && e.comment.empty()) return;
    if (e.number > 0) {
      const auto [at, fresh] = numbers_.emplace(e.number, words_);
      if (!fresh)
        out_->report.derived.push_back({item.description.empty() ? item.id : item.description,
                                        "post-process.number",
                                        "tool number " + std::to_string(e.number) + " is also that of " +
                                            at->second + "; the library may say so, a magazine cannot"});
    }
    out_->library.entries.push_back(std::move(e));
  }

  void presets(const Json& t, CatalogueItem& item) {
    const Json* start = t.find("start-values");
    if (start == nullptr) return;
    keep_rest(*start, "start-values.", {"presets"}, item.kept);
    const Json* list = start->find("presets");
    if (list == nullptr) return;
    for (std::size_t k = 0; k < list->items.size(); ++k) {
      const Json& from = list->items[k];
      const std::string prefix = "presets." + std::to_string(k) + ".";
      Preset p;
      std::vector<std::string_view> known = {"name", "tool-coolant"};
      p.name = from.text_of("name");
      p.coolant = from.text_of("tool-coolant");
      if (const Json* m = from.find("material")) p.material = m->text_of("query");
      p.source = "preset '" + p.name + "'";
      for (const PresetKey& key : kPreset) {
        known.push_back(key.key);
        const Json* v = from.find(key.key);
        if (v == nullptr || v->is(Json::Kind::kNull)) continue;
        const Place where = place(*v, prefix + std::string(key.key));
        const auto n = number_from(v->text, where);
        if (!n)
          faults_.push_back(n.error());
        else if (*n < 0.0)
          refuse(where, "TOOL-VALUE", v->text + " is negative", "a number of at least 0");
        else
          p.*key.field = *n * preset_factor(key.unit, item.inches);
      }
      keep_rest(from, prefix, known, item.kept);
      item.presets.push_back(std::move(p));
    }
  }

  const std::string& file_;
  Job& job_;
  Imported* out_ = nullptr;
  std::string words_;
  UniqueIds ids_, holder_ids_;
  std::map<int, std::string> numbers_;
  std::vector<Diagnostic> faults_;
};

}  // namespace

void derive(CatalogueItem& item, ToolAssembly& assembly, LossReport& report) {
  const auto of = [&item](const char* symbol) { return number_of(item, symbol).value_or(0.0); };
  const auto has = [&item](const char* symbol) { return find(item.properties, symbol) != nullptr; };
  const double stick_out = assembly.stick_out_mm.value_or(0.0), shoulder = of("shoulder-length");
  // Without a holder this is the stick-out, and the length to the gage line is unknown.
  if (const double gauge = of("assemblyGaugeLength"); gauge > stick_out)
    assembly.functional_length_mm = gauge;
  if (of("DMM") > of("DC") && shoulder > 0.0 && shoulder <= stick_out && !has("LU"))
    derived(item, "LU", shoulder, "the shoulder's length, where the shank is thicker than the cut", report);
  if (const double neck = of("shoulder-diameter");
      neck > 0.0 && neck < of("DC") - 1e-9 && shoulder > of("LCF") && !has("DN")) {
    derived(item, "DN", neck, "shoulder-diameter", report);
    derived(item, "LN", shoulder, "shoulder-length", report);
  }
  if (item.cutter_class == CutterClass::kChamferMill && of("TA") > 0.0 &&
      of("TA") <= 0.5 * std::numbers::pi && of("SIG") == 0.0)
    derived(item, "SIG", 2.0 * of("TA"), "twice the taper angle TA", report);
  if (item.cutter_class == CutterClass::kFacemill && of("TA") > 0.0 && of("TA") < 0.5 * std::numbers::pi &&
      !has("PSIR"))
    derived(item, "PSIR", of("TA"), "the taper angle TA of a face mill", report);
  if (item.kind == "slot mill" && of("LCF") > 0.0 && !has("CW"))
    derived(item, "CW", of("LCF"), "the flute length of a slot mill", report);
}

Result<Imported> read_tree(const Json& root, const std::string& file, Job& job) {
  const Json* data = root.find("data");
  if (data == nullptr || !data->is(Json::Kind::kList))
    return fail({.code = "JSON-KIND",
                 .message = "the library has no list of tools",
                 .file = file,
                 .expected = "{\"data\": [...]}"});
  return Reader(file, job).read(root);
}

Result<Imported> read(std::string_view bytes, const std::string& file, const FormatOptions&, Job& job) {
  if (!is_zip(bytes)) {
    const auto root = parse_json(bytes, file);
    if (!root) return fail(root.error());
    return read_tree(*root, file, job);
  }
  const auto entries = read_zip(bytes, file, [](std::string_view name) { return name.ends_with(".json"); });
  if (!entries) return fail(entries.error());
  if (entries->size() != 1)
    return fail({.code = "ZIP-SYNTAX",
                 .message = "the archive has " + std::to_string(entries->size()) + " libraries (.json)",
                 .file = file,
                 .expected = "one tools.json",
                 .hint = "unpack it and give the libraries one by one"});
  const auto root = parse_json(entries->front().bytes, file + ":tools.json");
  if (!root) return fail(root.error());
  auto out = read_tree(*root, file + ":tools.json", job);
  if (out) out->library.source = file;
  return out;
}

}  // namespace capstan::tooling::fusion

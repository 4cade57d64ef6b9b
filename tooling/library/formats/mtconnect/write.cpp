#include <algorithm>
#include <array>
#include <map>
#include <set>

#include "planner/ground/base/number.h"
#include "planner/ground/base/text.h"
#include "tooling/library/formats/all.h"
#include "tooling/library/formats/item/item.h"
#include "tooling/library/formats/mtconnect/mtconnect.h"
#include "tooling/library/formats/values.h"
#include "tooling/library/formats/xml.h"

namespace capstan::tooling {
namespace {

constexpr std::string_view kUnknownTime = "1970-01-01T00:00:00Z";

struct Measure {
  std::string_view symbol, element;
  double per_unit;  ///< the standard's unit in ours
};
constexpr double kGram = 1e-3;
constexpr std::array kOfTool = {
    Measure{"BDX", "BodyDiameterMax", 1.0},  Measure{"LBX", "BodyLengthMax", 1.0},
    Measure{"APMX", "DepthOfCutMax", 1.0},   Measure{"DC", "CuttingDiameterMax", 1.0},
    Measure{"DF", "FlangeDiameterMax", 1.0}, Measure{"OAL", "OverallToolLength", 1.0},
    Measure{"DMM", "ShankDiameter", 1.0},    Measure{"LS", "ShankLength", 1.0},
    Measure{"LUX", "UsableLengthMax", 1.0},  Measure{"LU", "UsableLengthMax", 1.0},
    Measure{"WT", "Weight", kGram},
};
constexpr std::array kOfEdge = {
    Measure{"RE", "CornerRadius", 1.0},
    Measure{"SIG", "PointAngle", kRadPerDegree},
    Measure{"KAPR", "ToolCuttingEdgeAngle", kRadPerDegree},
    Measure{"PSIR", "ToolLeadAngle", kRadPerDegree},
    Measure{"BS", "WiperEdgeLength", 1.0},
    Measure{"IC", "IncribedCircleDiameter", 1.0},  // as the schema spells it
    Measure{"SDL", "StepDiameterLength", 1.0},
    Measure{"STA", "StepIncludedAngle", kRadPerDegree},
};
/// Written elsewhere than as a measurement.
constexpr std::array<std::string_view, 7> kElsewhere = {"ZEFF", "RPMX", "CZCMS", "GRADE",
                                                        "LIFE", "LF",   "LPR"};

/// A name token of XML: what the standard allows as the id of a tool.
std::string token(std::string_view text) {
  std::string out;
  for (const char c : text) {
    const bool plain = (c >= '0' && c <= '9') || (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z') ||
                       c == '.' || c == '-' || c == '_' || c == ':';
    out += plain ? c : '_';
  }
  return out.empty() ? "tool" : out;
}

class Xml {
 public:
  using Attributes = std::vector<std::pair<std::string_view, std::string>>;

  void open(std::string_view name, const Attributes& attributes = {}) {
    start(name, attributes, ">\n");
    open_.emplace_back(name);
  }
  void close() {
    const std::string name = open_.back();
    open_.pop_back();
    indent();
    text_ += "</" + name + ">\n";
  }
  void leaf(std::string_view name, const Attributes& attributes, std::string_view content) {
    if (content.empty()) {
      start(name, attributes, "/>\n");
      return;
    }
    start(name, attributes, ">");
    text_ += xml_escaped(content) + "</" + std::string(name) + ">\n";
  }
  std::string text_ = "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n";

 private:
  void indent() { text_.append(2 * open_.size(), ' '); }
  void start(std::string_view name, const Attributes& attributes, std::string_view end) {
    indent();
    text_ += "<" + std::string(name);
    for (const auto& [key, value] : attributes) {
      std::string line = xml_escaped(value);
      std::ranges::replace_if(
          line, [](char c) { return c == '\n' || c == '\r' || c == '\t'; }, ' ');
      text_ += " " + std::string(key) + "=\"" + line + "\"";
    }
    text_ += end;
  }
  std::vector<std::string> open_;
};

struct Asset {
  const CatalogueItem* item = nullptr;
  const ToolAssembly* assembly = nullptr;
  const ToolInstance* instance = nullptr;
  const Holder* holder = nullptr;
  const MachineEntry* entry = nullptr;
  std::string id;
};

class Writer {
 public:
  Writer(const ToolLibrary& library, LossReport& report) : l_(library), report_(report) {}

  std::string write() {
    gather();
    x_.open("MTConnectAssets", {{"xmlns", "urn:mtconnect.org:MTConnectAssets:1.6"},
                                {"xmlns:xsi", "http://www.w3.org/2001/XMLSchema-instance"},
                                {"xsi:schemaLocation",
                                 "urn:mtconnect.org:MTConnectAssets:1.6 "
                                 "http://schemas.mtconnect.org/schemas/MTConnectAssets_1.6.xsd"}});
    const std::string count = std::to_string(assets_.size());
    x_.leaf("Header",
            {{"version", "1.6"},
             {"creationTime", std::string(kUnknownTime)},
             {"instanceId", "0"},
             {"sender", "capstan"},
             {"assetBufferSize", count},
             {"assetCount", count}},
            "");
    x_.open("Assets");
    for (const Asset& a : assets_) asset(a);
    x_.close();
    x_.close();
    report_.derived.push_back(
        {"", "timestamp", "none is known: " + std::string(kUnknownTime) + " is written for that"});
    report_.tools = assets_.size();
    return std::move(x_.text_);
  }

 private:
  void gather() {
    std::map<std::string, const CatalogueItem*> items;
    std::map<std::string, const ToolInstance*> instances;
    std::map<std::string, const Holder*> holders;
    std::map<std::string, const MachineEntry*> entries;
    for (const auto& i : l_.items) items.emplace(i.id, &i);
    for (const auto& i : l_.instances) instances.emplace(i.id, &i);
    for (const auto& h : l_.holders) holders.emplace(h.id, &h);
    for (const auto& e : l_.entries)
      if (!e.assembly.empty()) entries.emplace(e.assembly, &e);
    const auto at = [](const auto& map, const std::string& id) {
      const auto it = map.find(id);
      return it == map.end() ? nullptr : it->second;
    };
    std::set<const CatalogueItem*> met;
    std::set<const ToolInstance*> used;
    for (const ToolAssembly& a : l_.assemblies) {
      Asset out{at(items, a.item), &a,  at(instances, a.instance), at(holders, a.holder),
                at(entries, a.id), a.id};
      if (out.item == nullptr) continue;
      met.insert(out.item);
      used.insert(out.instance);
      assets_.push_back(std::move(out));
    }
    for (const ToolInstance& i : l_.instances) {
      const CatalogueItem* item = at(items, i.item);
      if (item == nullptr || used.contains(&i)) continue;
      met.insert(item);
      assets_.push_back({item, nullptr, &i, nullptr, nullptr, i.id});
    }
    for (const CatalogueItem& i : l_.items)
      if (!met.contains(&i)) assets_.push_back({&i, nullptr, nullptr, nullptr, at(entries, i.id), i.id});
    for (const MachineEntry& e : l_.entries)
      if (e.assembly.empty())
        report_.dropped.push_back(
            {e.comment, "table", "tool " + std::to_string(e.number) + " is known to the table only"});
  }

  void asset(const Asset& a) {
    const std::string tool_id = token(a.item->id);
    if (tool_id != a.item->id)
      report_.derived.push_back({a.item->id, "toolId", "MTConnect wants a name token: " + tool_id});
    std::string makers = a.item->manufacturer;
    if (a.holder != nullptr && !a.holder->manufacturer.empty())
      makers += (makers.empty() ? "" : ",") + a.holder->manufacturer;
    Xml::Attributes attributes{{"assetId", unique_id(token(a.id), ids_)},
                               {"timestamp", std::string(kUnknownTime)},
                               {"serialNumber", a.instance == nullptr ? a.id : a.instance->id},
                               {"toolId", tool_id}};
    if (!makers.empty()) attributes.emplace_back("manufacturers", makers);
    x_.open("CuttingTool", attributes);
    if (!a.item->description.empty()) x_.leaf("Description", {}, a.item->description);
    x_.open("CuttingToolLifeCycle");
    status(a);
    life(a);
    if (a.instance != nullptr && !a.instance->group.empty())
      x_.leaf("ProgramToolGroup", {}, a.instance->group);
    if (a.entry != nullptr) {
      x_.leaf("ProgramToolNumber", {}, std::to_string(a.entry->number));
      if (a.entry->pocket) x_.leaf("Location", {{"type", "POT"}}, std::to_string(*a.entry->pocket));
    }
    if (const auto n = number_of(*a.item, "RPMX"); n && *n > 0.0)
      x_.leaf("ProcessSpindleSpeed", {{"maximum", trimmed(*n, 3)}}, "");
    connection(a);
    measurements(a);
    edges(*a.item);
    x_.close();
    x_.close();
    tell(a);
  }

  void status(const Asset& a) {
    std::vector<std::string_view> out;
    if (a.entry != nullptr && a.entry->pocket) out.emplace_back("AVAILABLE");
    if (a.instance != nullptr) {
      const ToolInstance& i = *a.instance;
      if (!i.measured.empty()) out.emplace_back("MEASURED");
      if (i.life_used_min == 0.0) out.emplace_back("NEW");
      if (i.life_used_min && *i.life_used_min > 0.0) out.emplace_back("USED");
      if (i.life_used_min && i.life_min && *i.life_used_min >= *i.life_min) out.emplace_back("EXPIRED");
    }
    if (out.empty()) out.emplace_back("UNKNOWN");
    x_.open("CutterStatus");
    for (const auto s : out) x_.leaf("Status", {}, s);
    x_.close();
  }

  void life(const Asset& a) {
    std::optional<double> limit = number_of(*a.item, "LIFE");
    double used = 0.0;
    bool known = false;
    if (a.instance != nullptr) {
      if (a.instance->life_min) limit = a.instance->life_min;
      known = a.instance->life_used_min.has_value();
      used = a.instance->life_used_min.value_or(0.0);
    }
    if (!limit && !known) return;
    Xml::Attributes attributes{{"type", "MINUTES"}, {"countDirection", "UP"}, {"initial", "0"}};
    if (limit) attributes.emplace_back("limit", shortest(*limit));
    x_.leaf("ToolLife", attributes, shortest(used));
    if (!known) report_.derived.push_back({a.id, "ToolLife", "nothing says that the tool was used: 0 min"});
  }

  void connection(const Asset& a) {
    std::string code = a.holder == nullptr ? "" : a.holder->connection;
    if (code.empty())
      if (const Property* p = find(a.item->properties, "CZCMS")) code = p->text;
    if (!code.empty()) x_.leaf("ConnectionCodeMachineSide", {}, code);
  }

  void measure(const Asset& a, std::string_view element, std::string_view symbol,
               std::optional<double> nominal, double per_unit) {
    const Property* found = a.instance == nullptr ? nullptr : find(a.instance->measured, symbol);
    const bool measured = found != nullptr && found->number;
    if (!nominal && !measured) return;
    Xml::Attributes attributes{{"code", std::string(symbol)}};
    const auto text = [per_unit](double v) {
      return shortest(per_unit == 1.0 ? v : unconverted(v, per_unit));
    };
    attributes.emplace_back("units", per_unit == kGram ? "GRAM" : per_unit == 1.0 ? "MILLIMETER" : "DEGREE");
    if (per_unit == 1.0 && a.item->inches) attributes.emplace_back("nativeUnits", "INCH");
    if (nominal) attributes.emplace_back("nominal", text(*nominal));
    x_.leaf(element, attributes, measured ? text(*found->number) : "");
  }

  void measurements(const Asset& a) {
    std::optional<double> length, out;
    if (a.assembly != nullptr) {
      length = a.assembly->functional_length_mm;
      out = a.assembly->stick_out_mm;
    }
    const bool bare = a.assembly == nullptr || (!length && !out);
    if (bare) {
      length = number_of(*a.item, "LF");
      out = number_of(*a.item, "LPR");
    }
    bool any = length || out || (a.instance != nullptr && !a.instance->measured.empty());
    for (const Measure& m : kOfTool) any = any || number_of(*a.item, m.symbol);
    if (!any) return;
    x_.open("Measurements");
    measure(a, "FunctionalLength", "LF", length, 1.0);
    measure(a, "ProtrudingLength", "LPR", out, 1.0);
    std::string_view before;
    for (const Measure& m : kOfTool) {
      auto nominal = number_of(*a.item, m.symbol);
      if (m.symbol == "APMX" && !nominal) nominal = number_of(*a.item, "LCF");
      if (m.element == before) continue;
      if (nominal) before = m.element;
      measure(a, m.element, m.symbol, nominal, m.per_unit);
    }
    x_.close();
  }

  void edges(const CatalogueItem& item) {
    const auto teeth = number_of(item, "ZEFF");
    if (!teeth || *teeth < 1.0) {
      for (const Measure& m : kOfEdge)
        if (number_of(item, m.symbol))
          report_.dropped.push_back(
              {item.id, std::string(m.symbol), "of an edge, and no number of edges is known"});
      return;
    }
    const std::string n = std::to_string(static_cast<int>(*teeth));
    x_.open("CuttingItems", {{"count", n}});
    Xml::Attributes attributes{{"indices", n == "1" ? "1" : "1-" + n}};
    if (const Property* grade = find(item.properties, "GRADE")) attributes.emplace_back("grade", grade->text);
    Asset nominal_only;
    nominal_only.item = &item;
    const bool any =
        std::ranges::any_of(kOfEdge, [&](const Measure& m) { return number_of(item, m.symbol).has_value(); });
    if (!any) {
      x_.leaf("CuttingItem", attributes, "");
    } else {
      x_.open("CuttingItem", attributes);
      x_.open("Measurements");
      for (const Measure& m : kOfEdge)
        measure(nominal_only, m.element, m.symbol, number_of(item, m.symbol), m.per_unit);
      x_.close();
      x_.close();
    }
    x_.close();
  }

  void tell(const Asset& a) {
    if (!told_.insert(a.item).second) return;
    const CatalogueItem& item = *a.item;
    const auto drop = [&](std::string field, std::string what) {
      report_.dropped.push_back({item.id, std::move(field), std::move(what)});
    };
    for (const Property& p : item.properties) {
      const auto has = [&p](const auto& list) {
        return std::ranges::find(list, p.symbol, &Measure::symbol) != list.end();
      };
      const bool depth = p.symbol == "LCF" && !number_of(item, "APMX");
      if (!has(kOfTool) && !has(kOfEdge) && !depth &&
          std::ranges::find(kElsewhere, p.symbol) == kElsewhere.end())
        drop(p.symbol, "MTConnect 1.6 has no measurement for it");
    }
    if (item.cutter_class) drop("class", "MTConnect 1.6 names no class of tool");
    if (!item.presets.empty())
      drop("presets", std::to_string(item.presets.size()) +
                          " start values: one per tool has a place, which is not known");
    if (!item.product_link.empty()) drop("product_link", "no place for it");
    for (const auto& [path, text] : item.kept)
      if (path != kLeftOut) drop(path, "of another format, no place for it");
    if (a.holder != nullptr && !a.holder->segments.empty()) drop("holder", "its outline has no place");
    if (a.entry != nullptr && !a.entry->offsets.empty())
      drop("offsets", "offsets of a tool table have no place");
  }

  const ToolLibrary& l_;
  LossReport& report_;
  Xml x_;
  std::vector<Asset> assets_;
  UniqueIds ids_;
  std::set<const CatalogueItem*> told_;
};

}  // namespace

Result<Exported> write_mtconnect(const ToolLibrary& library, const FormatOptions& /*options*/, Job& /*job*/) {
  if (library.items.empty()) return fail({.code = "MTCONNECT-NONE", .message = "the library has no tool"});
  Exported out;
  out.bytes = Writer(library, out.report).write();
  return out;
}

const Format& mtconnect_format() {
  static const Format kFormat{.name = "mtconnect",
                              .title = "MTConnect CuttingTool assets",
                              .endings = {".xml"},
                              .write = write_mtconnect};
  return kFormat;
}

}  // namespace capstan::tooling

#include "tooling/library/formats/csv/columns.h"

#include <algorithm>
#include <array>
#include <set>

#include "planner/ground/base/text.h"
#include "tooling/library/formats/fusion/keys.h"
#include "tooling/library/formats/json.h"
#include "tooling/library/formats/values.h"
#include "tooling/shop/data/tree.h"

namespace capstan::tooling::csv {
namespace {

constexpr std::array<std::string_view, 28> kFields{"id",
                                                   "group",
                                                   "description",
                                                   "class",
                                                   "kind",
                                                   "manufacturer",
                                                   "product_id",
                                                   "product_link",
                                                   "comment",
                                                   "unit",
                                                   "number",
                                                   "pocket",
                                                   "carousel",
                                                   "in_stock",
                                                   "price",
                                                   "life_min",
                                                   "life_used_min",
                                                   "stick_out",
                                                   "length",
                                                   "not_stated",
                                                   "holder.id",
                                                   "holder.gage",
                                                   "holder.description",
                                                   "holder.segments",
                                                   "holder.manufacturer",
                                                   "preset",
                                                   "holder.product_id",
                                                   "holder.product_link"};

struct Name {
  std::string_view title, field;
};
/// Fusion's export names its parameters in brackets.
constexpr std::array kFusion{
    Name{"tool_index", "group"},
    Name{"preset_name", "preset"},
    Name{"tool_type", "kind"},
    Name{"tool_description", "description"},
    Name{"tool_diameter", "DC"},
    Name{"tool_number", "number"},
    Name{"tool_unit", "unit"},
    Name{"tool_comment", "comment"},
    Name{"tool_vendor", "manufacturer"},
    Name{"tool_productid", "product_id"},
    Name{"tool_productlink", "product_link"},
    Name{"tool_assemblygaugelength", "assemblyGaugeLength"},
    Name{"tool_bodylength", "LPR"},
    Name{"tool_clockwise", "HAND"},
    Name{"tool_coolant", "preset.coolant"},
    Name{"tool_coolantsupport", "CSP"},
    Name{"tool_cornerradius", "RE"},
    Name{"tool_feedcutting", "preset.v_f"},
    Name{"tool_feedperrevolution", "preset.f_n"},
    Name{"tool_feedpertooth", "preset.f_z"},
    Name{"tool_feedplunge", "preset.v_f_plunge"},
    Name{"tool_feedramp", "preset.v_f_ramp"},
    Name{"tool_flutelength", "LCF"},
    Name{"tool_grade", "GRADE"},
    Name{"tool_holdergaugelength", "holder.gage"},
    Name{"tool_material", "BMC"},
    Name{"tool_maximumcuttingdiameter", "DCX"},
    Name{"tool_maximumthreadpitch", "TPX"},
    Name{"tool_minimumthreadpitch", "TPN"},
    Name{"tool_numberofflutes", "ZEFF"},
    Name{"tool_numberofteeth", "NT"},
    Name{"tool_overalllength", "OAL"},
    Name{"tool_presetmaterialquery", "preset.material"},
    Name{"tool_rampangle", "preset.ramp-angle"},
    Name{"tool_shaftdiameter", "DMM"},
    Name{"tool_shoulderlength", "shoulder-length"},
    Name{"tool_shoulderdiameter", "shoulder-diameter"},
    Name{"tool_spindlespeed", "preset.n"},
    Name{"tool_stepdown", "preset.stepdown"},
    Name{"tool_stepover", "preset.stepover"},
    Name{"tool_surfacespeed", "preset.v_c"},
    Name{"tool_taperangle", "TA"},
    Name{"tool_threadpitch", "TP"},
    Name{"tool_tipangle", "SIG"},
    Name{"tool_tipdiameter", "DCN"},
    Name{"tool_tiplength", "tip-length"},
    Name{"tool_tipoffset", "tip-offset"},
    Name{"holder_description", "holder.description"},
    Name{"holder_productid", "holder.product_id"},
    Name{"holder_productlink", "holder.product_link"},
    Name{"holder_vendor", "holder.manufacturer"},
    Name{"holder_segments", "holder.segments"},
};
/// Common names of columns, in lower case.
constexpr std::array kWords{
    Name{"d", "DC"},
    Name{"dia", "DC"},
    Name{"diameter", "DC"},
    Name{"cutting diameter", "DC"},
    Name{"tool diameter", "DC"},
    Name{"durchmesser", "DC"},
    Name{"schneidendurchmesser", "DC"},
    Name{"r", "RE"},
    Name{"corner radius", "RE"},
    Name{"eckenradius", "RE"},
    Name{"flutes", "ZEFF"},
    Name{"teeth", "ZEFF"},
    Name{"z", "ZEFF"},
    Name{"number of flutes", "ZEFF"},
    Name{"number of teeth", "ZEFF"},
    Name{"schneidenzahl", "ZEFF"},
    Name{"zähnezahl", "ZEFF"},
    Name{"flute length", "LCF"},
    Name{"cutting length", "LCF"},
    Name{"length of cut", "LCF"},
    Name{"loc", "LCF"},
    Name{"schneidenlänge", "LCF"},
    Name{"overall length", "OAL"},
    Name{"total length", "OAL"},
    Name{"gesamtlänge", "OAL"},
    Name{"shank", "DMM"},
    Name{"shank diameter", "DMM"},
    Name{"schaftdurchmesser", "DMM"},
    Name{"reach", "LU"},
    Name{"usable length", "LU"},
    Name{"stick-out", "stick_out"},
    Name{"stickout", "stick_out"},
    Name{"stick out", "stick_out"},
    Name{"projection", "stick_out"},
    Name{"auskraglänge", "stick_out"},
    Name{"tool length", "length"},
    Name{"point angle", "SIG"},
    Name{"tip angle", "SIG"},
    Name{"spitzenwinkel", "SIG"},
    Name{"helix", "FHA"},
    Name{"helix angle", "FHA"},
    Name{"pitch", "TP"},
    Name{"thread pitch", "TP"},
    Name{"steigung", "TP"},
    Name{"type", "kind"},
    Name{"tool type", "kind"},
    Name{"typ", "kind"},
    Name{"werkzeugtyp", "kind"},
    Name{"name", "description"},
    Name{"tool", "description"},
    Name{"bezeichnung", "description"},
    Name{"beschreibung", "description"},
    Name{"t", "number"},
    Name{"tool number", "number"},
    Name{"t number", "number"},
    Name{"no", "number"},
    Name{"no.", "number"},
    Name{"nr", "number"},
    Name{"nr.", "number"},
    Name{"werkzeugnummer", "number"},
    Name{"units", "unit"},
    Name{"einheit", "unit"},
    Name{"vendor", "manufacturer"},
    Name{"maker", "manufacturer"},
    Name{"hersteller", "manufacturer"},
    Name{"article", "product_id"},
    Name{"article number", "product_id"},
    Name{"part number", "product_id"},
    Name{"artikelnummer", "product_id"},
    Name{"link", "product_link"},
    Name{"material", "BMC"},
    Name{"tool material", "BMC"},
    Name{"schneidstoff", "BMC"},
    Name{"coating", "COATING"},
    Name{"beschichtung", "COATING"},
    Name{"rpm", "preset.n"},
    Name{"drehzahl", "preset.n"},
    Name{"vc", "preset.v_c"},
    Name{"fz", "preset.f_z"},
    Name{"feed", "preset.v_f"},
    Name{"vorschub", "preset.v_f"},
    Name{"stock", "in_stock"},
    Name{"quantity", "in_stock"},
    Name{"bestand", "in_stock"},
    Name{"preis", "price"},
    Name{"max rpm", "RPMX"},
};

bool is_preset_field(std::string_view field) {
  if (field == "preset.material" || field == "preset.coolant") return true;
  if (!field.starts_with("preset.")) return false;
  for (const auto& k : fusion::kPreset)
    if (field.substr(7) == k.key) return true;
  return false;
}

/// "Diameter [mm]" -> "Diameter" and "mm"; the bracket is left alone when it holds no unit.
std::pair<std::string, std::string> split_unit(std::string_view title) {
  std::string_view t = trimmed_text(title);
  const auto known = [](std::string_view u) {
    return mm_per_unit_of(u) || u == "deg" || u == "\xC2\xB0" || u == "tool unit";
  };
  for (const auto& [open, close] : {std::pair('[', ']'), std::pair('(', ')')}) {
    if (!t.ends_with(close)) continue;
    const auto at = t.rfind(open);
    if (at == std::string_view::npos) continue;
    const std::string_view unit = trimmed_text(t.substr(at + 1, t.size() - at - 2));
    if (known(unit)) return {std::string(trimmed_text(t.substr(0, at))), std::string(unit)};
  }
  if (const auto comma = t.rfind(','); comma != std::string_view::npos) {
    const std::string_view unit = trimmed_text(t.substr(comma + 1));
    if (mm_per_unit_of(unit)) return {std::string(trimmed_text(t.substr(0, comma))), std::string(unit)};
  }
  return {std::string(t), ""};
}

std::string unit_word(const std::string& unit) {
  if (unit == "tool unit") return "L";
  if (unit == "\xC2\xB0" || unit == "deg") return "deg";
  if (const auto f = mm_per_unit_of(unit)) return *f == 1.0 ? "mm" : "in";
  return "";
}

std::string field_of_title(const std::string& name) {
  const std::string low = lower_text(name);
  if (const auto at = low.rfind('('); at != std::string::npos && low.ends_with(')')) {
    const std::string_view inner = std::string_view(low).substr(at + 1, low.size() - at - 2);
    for (const Name& n : kFusion)
      if (n.title == inner) return std::string(n.field);
    if (inner.find('_') != std::string_view::npos) return "keep";
  }
  if (is_known_field(name)) return name;
  for (const Name& n : kWords)
    if (n.title == low) return std::string(n.field);
  std::string upper = name;
  for (char& c : upper)
    if (c >= 'a' && c <= 'z') c = static_cast<char>(c - 32);
  if (upper.size() > 1 && symbol_fact(upper) != nullptr) return upper;
  return "keep";
}

}  // namespace

bool is_known_field(std::string_view field) {
  if (std::find(kFields.begin(), kFields.end(), field) != kFields.end()) return true;
  if (is_preset_field(field) || symbol_fact(field) != nullptr || field == "keep" || field == "ignore")
    return true;
  if ((field.starts_with("prop.") || field.starts_with("text.")) && field.size() > 5) return true;
  if (field.starts_with("offset."))
    return field.size() == 8 && std::string_view("XYZABCUVWDIJQ").find(field[7]) != std::string_view::npos;
  for (const auto& g : fusion::kGeometry)
    if (g.symbol == field) return true;
  return false;
}

ColumnMap map_of_titles(const std::vector<std::string>& titles, char separator) {
  ColumnMap out;
  out.separator = separator;
  std::set<std::string> taken;
  for (const std::string& title : titles) {
    const auto [name, unit] = split_unit(title);
    Column c{title, field_of_title(name), unit_word(unit)};
    // A second column of the same meaning is kept, not mixed with the first.
    if (c.field != "keep" && !taken.insert(c.field).second) c.field = "keep";
    out.columns.push_back(std::move(c));
  }
  return out;
}

Result<ColumnMap> read_map(std::string_view text, const std::string& file, Job& job) {
  const auto root = parse_tree(text, file);
  if (!root) return fail(root.error());
  std::vector<Diagnostic> faults;
  ColumnMap out;
  Fields top(*root, file, "", "", faults);
  if (top.text("capstan_columns") != "1")
    top.fault("DATA-VERSION", "this is no column map of version 1", "capstan_columns", 1,
              "capstan_columns: 1");
  const std::string separator = top.text_or("separator", ","), decimal = top.text_or("decimal", ".");
  if (separator != "," && separator != ";" && separator != "tab")
    top.fault("DATA-UNKNOWN", "'" + separator + "' is no separator", "separator", top.line_of("separator"),
              "\",\", \";\" or tab");
  if (decimal != "." && decimal != ",")
    top.fault("DATA-UNKNOWN", "'" + decimal + "' is no decimal mark", "decimal", top.line_of("decimal"),
              "\".\" or \",\"");
  out.separator = separator == "tab" ? '\t' : separator.empty() ? ',' : separator[0];
  out.decimal = decimal == "," ? ',' : '.';
  const std::string unit = top.text_or("unit", "");
  out.unit = unit_word(unit);
  if (!unit.empty() && out.unit != "mm" && out.unit != "in")
    top.fault("DATA-UNIT", "the unit '" + unit + "' is not known", "unit", top.line_of("unit"), "mm or inch");
  if (const Node* list = top.child("columns", true)) {
    for (const Node& n : list->items) {
      Fields f = top.below("columns", n);
      Column c;
      c.title = f.text("title");
      c.field = f.text("field");
      c.unit = f.text_or("unit", "");
      if (!is_known_field(c.field))
        f.fault("DATA-UNKNOWN", "'" + c.field + "' is no field of a tool", "field", f.line(),
                "a symbol (DC, LCF, ...), a field, keep or ignore");
      f.finish();
      out.columns.push_back(std::move(c));
    }
  }
  top.finish();
  if (auto d = tell(std::move(faults), job)) return fail(*std::move(d));
  return out;
}

std::string map_text(const ColumnMap& map) {
  std::string out = "capstan_columns: 1\nseparator: ";
  out += map.separator == '\t' ? "tab" : std::string("\"") + map.separator + "\"";
  out += std::string("\ndecimal: \"") + map.decimal + "\"\n";
  if (!map.unit.empty()) out += "unit: " + map.unit + "\n";
  out += "columns:\n";
  for (const Column& c : map.columns) {
    out += "  - {title: " + json_quoted(c.title) + ", field: " + json_quoted(c.field);
    if (!c.unit.empty()) out += ", unit: " + json_quoted(c.unit);
    out += "}\n";
  }
  return out;
}

}  // namespace capstan::tooling::csv

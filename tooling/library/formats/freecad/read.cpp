#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <numbers>
#include <set>

#include "planner/ground/base/file.h"
#include "planner/ground/base/number.h"
#include "tooling/library/formats/all.h"
#include "tooling/library/formats/byte_cap.h"
#include "tooling/library/formats/freecad/freecad.h"
#include "tooling/library/formats/freecad/shapes.h"
#include "tooling/library/formats/item/item.h"
#include "tooling/library/formats/json.h"
#include "tooling/library/formats/zip.h"
#include "tooling/library/words/comment_words.h"

namespace capstan::tooling {
namespace {

namespace fs = std::filesystem;
using freecad::Shape;
using model::CutterClass;

constexpr double kSlackMm = 1e-3;  // files give four decimals

std::string stem_of(std::string_view path) {
  if (const auto slash = path.find_last_of("/\\"); slash != std::string_view::npos)
    path.remove_prefix(slash + 1);
  if (const auto dot = path.rfind('.'); dot != std::string_view::npos && dot > 0) path = path.substr(0, dot);
  return std::string(path);
}

bool ends_with_folded(std::string_view path, std::string_view ending) {
  if (path.size() < ending.size()) return false;
  return std::ranges::equal(path.substr(path.size() - ending.size()), ending, [](char a, char b) {
    return (a >= 'A' && a <= 'Z' ? static_cast<char>(a + 32) : a) == b;
  });
}

/// "6.0000 mm" -> its number and its unit.
std::pair<std::string_view, std::string_view> split_quantity(std::string_view text) {
  text = trimmed_text(text);
  std::size_t end = 0;
  while (end < text.size() && std::string_view("0123456789+-.,eE").find(text[end]) != std::string_view::npos)
    ++end;
  return {trimmed_text(text.substr(0, end)), trimmed_text(text.substr(end))};
}

std::string degrees(double rad) { return trimmed(rad / kRadPerDegree, 4); }
std::string text_of(const Json* n) { return n == nullptr ? std::string() : n->text; }

class BitReader {
 public:
  BitReader(const FormatOptions& options, ItemGatherer& gatherer, LossReport& report)
      : gatherer_(gatherer), report_(report) {
    if (options.mm_per_unit) unit_ = *options.mm_per_unit == kMmPerInch ? "in" : "mm";
  }

  /// `file`: to name in diagnostics.
  void read(const Json& root, const std::string& id, const std::string& file) {
    item_ = {};
    file_ = file;
    unit_taken_ = false;
    item_.id = id;
    const Json* name = root.find("name");
    if (name == nullptr) name = root.find("label");
    item_.description = name == nullptr ? id : name->text;
    keep_outline(root);
    const std::string type = text_of(root.find("shape-type")), shape_file = text_of(root.find("shape"));
    item_.kind = type.empty() ? shape_file : type;
    shape_ = freecad::find_shape(type.empty() ? shape_file : type);
    static constexpr Shape kUnknown{"", std::nullopt};
    if (const Json* parameters = root.find("parameter")) {
      for (const auto& [key, value] : parameters->entries)
        read_parameter(shape_ == nullptr ? kUnknown : *shape_, key, value);
    }
    if (shape_ == nullptr) {
      leave_out(item_, "the shape '" + item_.kind + "' is not known", report_);
    } else {
      item_.cutter_class = shape_->cutter_class;
      derive();
    }
    if (unit_taken_)
      report_.derived.push_back(
          {id, "unit", "lengths without a unit are in " + unit_ + ", as the caller says"});
    (void)gatherer_.take(std::move(item_), {file_, root.line, {}});
  }

 private:
  void keep_outline(const Json& root) {
    for (const char* key : {"version", "id", "shape", "shape-type", "toolbit_id"})
      if (const Json* n = root.find(key)) item_.kept.emplace_back(key, n->text);
    if (const Json* attributes = root.find("attribute"))
      for (const auto& [key, value] : attributes->entries) read_attribute(key, value);
    for (const auto& [key, value] : root.entries) {
      static constexpr std::string_view kKnown[] = {"version",   "id",        "shape", "shape-type", "name",
                                                    "parameter", "attribute", "label", "toolbit_id"};
      if (std::ranges::find(kKnown, key) != std::ranges::end(kKnown)) continue;
      report_.dropped.push_back({item_.id, key, "no entry of a tool bit that is known"});
    }
  }

  void read_attribute(const std::string& key, const Json& value) {
    item_.kept.emplace_back("attribute/" + key, json_text(value));
  }

  void read_parameter(const Shape& shape, const std::string& key, const Json& value) {
    const Place place{file_, value.line, item_.id + ", parameter " + key};
    if (!value.is(Json::Kind::kString) && !value.is(Json::Kind::kNumber)) {
      gatherer_.fault(place, "a parameter that is not a single value", "text like \"6.0000 mm\"");
      return;
    }
    const std::string_view symbol = freecad::symbol_of(shape, key);
    if (key == "Chipload" && limits_feed(shape, value.text)) {
      read_quantity("FZMAX", key, value.text, place);
      return;
    }
    if (symbol.empty()) {
      item_.kept.emplace_back("parameter/" + key, value.text);
      read_unmapped(key, value.text);
      return;
    }
    read_quantity(symbol, key, value.text, place);
  }

  void read_quantity(std::string_view symbol, const std::string& key, const std::string& text,
                     const Place& place) {
    const auto [number, stated] = split_quantity(text);
    if (number.empty()) {
      gatherer_.fault(place, "'" + text + "' is no number with a unit", "a value like \"6.0000 mm\"");
      return;
    }
    const std::string_view unit = unit_of(symbol, stated);
    auto fault = add_value(item_, {symbol, number, unit, "FreeCAD " + key}, place);
    if (fault && fault->code == "DATA-UNIT" && unit.empty() && is_length(symbol))
      fault->hint = "state the unit in the file, or give --unit";
    gatherer_.fault(std::move(fault));
  }

  static bool is_length(std::string_view symbol) {
    const SymbolFact* fact = symbol_fact(symbol);
    return fact != nullptr && fact->quantity == Quantity::kLength;
  }

  /// The unit of a value: what the file states, else that of the caller for lengths.
  std::string_view unit_of(std::string_view symbol, std::string_view stated) {
    if (!stated.empty() || unit_.empty() || !is_length(symbol)) return stated;
    unit_taken_ = true;
    return unit_;
  }

  void read_unmapped(const std::string& key, const std::string& text) {
    if (key == "FlatRadius") {
      // FreeCAD's own notes call it the radius of the flat, its operations take it for the corner radius.
      report_.dropped.push_back({item_.id, key, "its meaning differs within FreeCAD; kept word for word"});
    } else if (key == "Material" && (text == "HSS" || text == "Carbide")) {
      (void)add_value(item_, {"SUBSTRATE", text == "HSS" ? "hss" : "carbide", "", "FreeCAD Material"},
                      {file_, 0, {}});
    } else if (key != "CuttingEdgeHeight" && key != "TaperAngle" && key != "Chipload") {
      // The first two are used below, of the third is only what says nothing.
      report_.dropped.push_back({item_.id, key, "no symbol for it; kept word for word"});
    }
  }

  /// Chipload, a length per tooth (ToolBit's schema), names no material: it is no start value for one but the
  /// most that the bit takes in any. 0 is FreeCAD's own default and says nothing; a tap feeds by its pitch.
  static bool limits_feed(const Shape& shape, const std::string& text) {
    return shape.cutter_class != CutterClass::kTap && parse_double(split_quantity(text).first) != 0.0;
  }

  void derive() {
    const auto dc = number_of(item_, "DC");
    if (!dc) {
      if (!gatherer_.has_fault())
        gatherer_.fault(Place{file_, 0, item_.id}, "the Diameter is missing",
                        "a parameter Diameter like \"6.0000 mm\"");
      return;
    }
    const std::string_view t = shape_->type;
    const Property* d = find(item_.properties, "DC");
    if (t == "Ballend") {
      add_derived(item_, "RE", 0.5 * *dc, d->unit, "half the diameter of a ball end mill", report_);
    } else if (t == "VBit" || t == "Chamfer") {
      derive_cone(*dc);
    } else if (t == "SlittingSaw") {
      if (const auto cw = number_of(item_, "CW"))
        add_derived(item_, "APMX", *cw, "mm", "the thickness of the blade", report_);
    } else if (t == "Tap") {
      add_derived(item_, "TDZ", *dc, d->unit, "the diameter of a tap is that of its thread", report_);
      const Property* pitch = find(item_.properties, "TP");
      const bool named = sizes_of_words(item_.description, model::CutterClass::kTap, *dc).pitch_mm > 0.0 ||
                         sizes_of_words(item_.id, model::CutterClass::kTap, *dc).pitch_mm > 0.0;
      if (!named && (pitch == nullptr || pitch->number == 0.0))
        leave_out(item_, pitch == nullptr ? "the tap has no pitch" : "the pitch of the tap is 0", report_);
    } else if (t == "TaperedBallNose" || t == "Dovetail" || t == "Radius" || t == "Fillet") {
      derive_form(*dc);
    }
  }

  /// Chamfer mills and V-bits: the angle is the full one; only V-bits have a cylinder above the cone.
  void derive_cone(double dc) {
    const auto sig = number_of(item_, "SIG");
    const double tip = number_of(item_, "DCN").value_or(0.0);
    if (!sig || *sig <= 0.0 || *sig >= std::numbers::pi) {
      leave_out(item_, "the angle of the cone is missing", report_);
      return;
    }
    const double cone = 0.5 * (dc - tip) / std::tan(0.5 * *sig);
    if (shape_->type == "VBit") {
      double straight = 0.0;
      for (const auto& [key, text] : item_.kept) {
        if (key != "parameter/CuttingEdgeHeight") continue;
        const auto [number, unit] = split_quantity(text);
        const auto v = parse_double(number);
        const auto u = mm_per_unit_of(unit_of("APMX", unit));
        if (v && u) straight = *v * *u;
      }
      add_derived(item_, "APMX", rounded(cone + straight, 4), "mm",
                  "height of the cone and of the cylinder on it", report_);
      return;
    }
    const auto edge = number_of(item_, "APMX");
    if (edge && cone > *edge + kSlackMm) {
      const double reached = tip + 2.0 * *edge * std::tan(0.5 * *sig);
      const double fits = 2.0 * std::atan2(0.5 * (dc - tip), *edge);
      leave_out(item_,
                "its sizes contradict each other: a cone of " + degrees(*sig) + " deg from " +
                    trimmed(tip, 4) + " mm reaches " + trimmed(reached, 4) + " mm over its edge of " +
                    trimmed(*edge, 4) + " mm, the diameter is " + trimmed(dc, 4) + " mm (" + degrees(fits) +
                    " deg would)",
                report_);
    }
  }

  void derive_form(double dc) {
    const std::string_view t = shape_->type;
    if (t == "Fillet") {
      leave_out(item_, "no class of cutter is a filleted chamfer", report_);
    } else if (t == "TaperedBallNose") {
      const auto angle = kept_angle("TaperAngle");
      if (!angle) {
        leave_out(item_, "the taper angle is missing", report_);
        return;
      }
      add_derived(item_, "RE", 0.5 * dc, "mm", "half the diameter of the ball", report_);
      add_derived(item_, "TA", 0.5 * *angle, "deg", "half of TaperAngle, which is the full one", report_);
    } else if (t == "Dovetail") {
      const auto tip = number_of(item_, "DCN"), height = number_of(item_, "APMX");
      if (tip && height && *height > 0.0) {
        add_derived(item_, "PSIR", std::atan2(0.5 * (dc - *tip), *height), "deg",
                    "from Diameter, TipDiameter and CuttingEdgeHeight", report_);
      } else {
        leave_out(item_, "the angle of the dovetail does not follow from its sizes", report_);
      }
    } else if (!number_of(item_, "RE")) {
      leave_out(item_, "the radius is missing", report_);
    } else {
      add_derived(item_, "DCN", std::max(0.0, dc - 2.0 * *number_of(item_, "RE")), "mm",
                  "the diameter without the radius on both sides", report_);
    }
  }

  std::optional<double> kept_angle(std::string_view parameter) const {
    for (const auto& [key, text] : item_.kept) {
      if (key != "parameter/" + std::string(parameter)) continue;
      const auto [number, unit] = split_quantity(text);
      const auto v = property_from("SIG", number, unit, "", {file_, 0, item_.id});
      if (v) return v->number;
    }
    return std::nullopt;
  }

  std::string file_;
  ItemGatherer& gatherer_;
  LossReport& report_;
  CatalogueItem item_;
  const Shape* shape_ = nullptr;
  std::string unit_;         ///< of lengths without one: "mm", "in"; empty: they are a fault
  bool unit_taken_ = false;  ///< by the bit that is read
};

/// The entries of a library: tool number -> bit.
Status read_list(const Json& root, const std::string& path, const std::string& file, Imported& out) {
  const Json* tools = root.find("tools");
  if (tools == nullptr || tools->kind != Json::Kind::kList)
    return fail({.code = "FREECAD-FORM",
                 .message = "the library has no list of tools",
                 .file = file,
                 .line = root.line,
                 .path = path,
                 .expected = "\"tools\": [{\"nr\": 1, \"path\": \"x.fctb\"}]"});
  const std::string label = text_of(root.find("label"));
  const std::string name = label.empty() ? stem_of(path) : label;
  std::map<long, std::uint64_t> numbers;
  for (const Json& tool : tools->items) {
    const Json* nr = tool.find("nr");
    const Json* bit = tool.find("path");
    const auto number = nr == nullptr ? std::nullopt : parse_double(nr->text);
    if (!number || *number != std::floor(*number) || *number < 0.0 || *number > 1e6 || bit == nullptr)
      return fail(
          {.code = "FREECAD-FORM",
           .message = nr == nullptr ? "a tool without a number" : "the tool number '" + nr->text + "'",
           .file = file,
           .line = tool.line,
           .path = path,
           .expected = "\"nr\": a whole number from 0, \"path\": a file's name"});
    const int n = static_cast<int>(*number);
    if (!numbers.emplace(n, tool.line).second)
      return fail({.code = "TOOL-NUMBER",
                   .message = "tool number " + std::to_string(n) + " is given twice",
                   .file = file,
                   .line = tool.line,
                   .path = path,
                   .expected = "each number once"});
    out.library.entries.push_back({.number = n,
                                   .pocket = {},
                                   .carousel = name,
                                   .assembly = stem_of(bit->text),
                                   .offsets = {},
                                   .comment = {}});
  }
  if (out.library.name.empty()) out.library.name = name;
  return {};
}

/// Makes an assembly for each entry whose bit was read; reports the others.
void link_entries(Imported& out, Job& job, const std::string& file) {
  std::set<std::string> items, assembled;
  for (const CatalogueItem& i : out.library.items) items.insert(i.id);
  for (MachineEntry& e : out.library.entries) {
    if (!items.contains(e.assembly)) {
      const std::string what = "the bit '" + e.assembly + "' of tool " + std::to_string(e.number) +
                               " is not there or cannot be used";
      out.report.dropped.push_back({e.assembly, "number", what});
      job.report({.code = "FREECAD-BIT", .severity = Severity::kWarning, .message = what, .file = file});
      e.comment = e.assembly;
      e.assembly.clear();
    } else if (assembled.insert(e.assembly).second) {
      out.library.assemblies.push_back({.id = e.assembly,
                                        .item = e.assembly,
                                        .instance = {},
                                        .holder = {},
                                        .stick_out_mm = {},
                                        .functional_length_mm = {}});
    }
  }
}

/// The bits that a library lists: beside it, or in the folder Bit next to its own. Only names count, so that
/// no path of a file leads elsewhere.
std::vector<FreecadFile> bits_of(std::string_view bytes, const std::string& file) {
  std::vector<FreecadFile> out;
  const auto root = parse_json(bytes, file);
  if (!root) return out;
  const Json* tools = root->find("tools");
  if (tools == nullptr) return out;
  const fs::path folder = fs::path(file).parent_path();
  std::set<std::string> names;
  for (const Json& tool : tools->items) {
    const Json* path = tool.find("path");
    if (path == nullptr) continue;
    const std::string name = stem_of(path->text) + ".fctb";
    if (!names.insert(name).second) continue;
    for (const fs::path& place : {folder, folder / ".." / "Bit", folder / "Bit"}) {
      const std::string on_disk = (place / name).lexically_normal().string();
      if (auto bit = read_file(on_disk, kLibraryBytesCap)) {
        out.push_back({"Bit/" + name, std::move(*bit), on_disk});
        break;
      }
    }
  }
  return out;
}

bool is_freecad_name(std::string_view name) {
  return ends_with_folded(name, ".fctb") || ends_with_folded(name, ".fctl");
}

bool recognises(std::string_view bytes, std::string_view file) {
  if (is_zip(bytes)) {
    const auto found = read_zip(bytes, std::string(file), is_freecad_name);
    return found && !found->empty();
  }
  if (ends_with_folded(file, ".fctb") || ends_with_folded(file, ".fctl")) return true;
  const std::string_view head = bytes.substr(0, std::size_t{1} << 16);
  if (head.find('{') == std::string_view::npos) return false;
  return (head.find("\"shape\"") != std::string_view::npos &&
          head.find("\"parameter\"") != std::string_view::npos) ||
         (head.find("\"tools\"") != std::string_view::npos && head.find(".fctb\"") != std::string_view::npos);
}

Result<Imported> read(std::string_view bytes, const std::string& file, const FormatOptions& options,
                      Job& job) {
  std::vector<FreecadFile> files;
  if (is_zip(bytes)) {
    auto members = read_zip(bytes, file, is_freecad_name);
    if (!members) return fail(members.error());
    for (ZipEntry& m : *members) files.push_back({m.name, std::move(m.bytes)});
  } else {
    const bool list = ends_with_folded(file, ".fctl") || bytes.find(".fctb\"") != std::string_view::npos;
    if (list) files = bits_of(bytes, file);
    files.push_back({stem_of(file) + (list ? ".fctl" : ".fctb"), std::string(bytes), file});
  }
  return read_freecad(files, file, options, job);
}

}  // namespace

Result<Imported> read_freecad(const std::vector<FreecadFile>& files, const std::string& file,
                              const FormatOptions& options, Job& job) {
  Imported out;
  out.library.source = file;
  ItemGatherer gatherer(out, file, "FREECAD-VALUE", job);
  BitReader reader(options, gatherer, out.report);
  for (const FreecadFile& f : files) {
    const std::string name = files.size() == 1    ? file
                             : !f.on_disk.empty() ? f.on_disk
                                                  : file + " (" + f.path + ")";
    const auto root = parse_json(f.bytes, name);
    if (ends_with_folded(f.path, ".fctl")) {
      if (!root) return fail(root.error());
      if (Status s = read_list(*root, f.path, name, out); !s) return fail(s.error());
      continue;
    }
    const std::string id = stem_of(f.path);
    if (root && (root->find("shape") != nullptr || root->find("shape-type") != nullptr)) {
      reader.read(*root, id, name);
      continue;
    }
    gatherer.fault(root ? Diagnostic{.code = "FREECAD-FORM",
                                     .message = "no tool bit: it has no shape",
                                     .file = name,
                                     .line = root->line,
                                     .expected = "\"shape\" and \"parameter\""}
                        : root.error());
    CatalogueItem unread;
    unread.id = id;
    (void)gatherer.take(std::move(unread), {name, 0, {}});
  }
  if (Status s = gatherer.finish("tool bits (.fctb)"); !s) return fail(s.error());
  link_entries(out, job, file);
  return out;
}

const Format& freecad_format() {
  static const Format kFormat{.name = "freecad",
                              .title = "FreeCAD tool bits and libraries",
                              .endings = {".zip", ".fctl", ".fctb"},
                              .recognises = recognises,
                              .read = read,
                              .write = write_freecad};
  return kFormat;
}

}  // namespace capstan::tooling

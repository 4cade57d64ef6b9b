#include <algorithm>
#include <filesystem>
#include <map>
#include <set>

#include "planner/ground/base/text.h"
#include "tooling/library/formats/freecad/freecad.h"
#include "tooling/library/formats/freecad/shapes.h"
#include "tooling/library/formats/item/item.h"
#include "tooling/library/formats/json.h"
#include "tooling/library/formats/zip.h"

namespace capstan::tooling {
namespace {

using freecad::Shape;

constexpr std::string_view kBits = "Bit/";

/// A name for a file on any system; FreeCAD knows a bit by it.
std::string file_name(std::string_view id) {
  std::string out;
  for (const char c : id) {
    const bool plain = (c >= '0' && c <= '9') || (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z') ||
                       std::string_view("._- ()+,").find(c) != std::string_view::npos ||
                       static_cast<unsigned char>(c) >= 0x80;
    out += plain ? c : '_';
  }
  while (!out.empty() && (out.front() == '.' || out.front() == ' ')) out.front() = '_';
  return out.empty() ? "tool" : out;
}

/// "6.0000 mm" as FreeCAD spells it; an empty text where it has no such unit.
std::string quantity(const Property& p) {
  if (!p.number) return p.text;
  const SymbolFact* fact = symbol_fact(p.symbol);
  if (fact == nullptr) return {};
  if (fact->quantity == Quantity::kLength) {
    const std::string unit = mm_per_unit_of(p.unit) ? p.unit : "mm";
    return spelled_in(p, unit) + " " + unit;
  }
  if (fact->quantity == Quantity::kAngle) return spelled_in(p, "deg") + " \xC2\xB0";
  return spelled_in(p, "");
}

class BitWriter {
 public:
  BitWriter(const CatalogueItem& item, LossReport& report) : item_(item), report_(report) {}

  /// The bit, or nothing where FreeCAD has no shape for it.
  std::optional<std::string> write() {
    choose_shape();
    if (shape_ == nullptr) return std::nullopt;
    Json root = Json::map(), parameters = Json::map(), attributes = Json::map();
    const std::string* version = find_kept(item_.kept, "version");
    root.set("version", Json::number(version == nullptr ? "2" : *version));
    if (const std::string* id = find_kept(item_.kept, "id")) root.set("id", Json::string(*id));
    root.set("name", Json::string(item_.description.empty() ? item_.id : item_.description));
    const std::string* file = find_kept(item_.kept, "shape");
    root.set("shape", Json::string(file == nullptr ? file_of(*shape_) : *file));
    const std::string* type = find_kept(item_.kept, "shape-type");
    if (type != nullptr || file == nullptr) root.set("shape-type", Json::string(type ? *type : shape_->type));
    for (const Property& p : item_.properties) write_property(p, parameters);
    for (const auto& [path, text] : item_.kept) write_kept(path, text, parameters, attributes);
    root.set("parameter", std::move(parameters));
    root.set("attribute", std::move(attributes));
    tell_rest();
    return json_text(root, 2) + "\n";
  }

 private:
  void drop(std::string field, std::string what) {
    report_.dropped.push_back({item_.id, std::move(field), std::move(what)});
  }

  void choose_shape() {
    const std::string* type = find_kept(item_.kept, "shape-type");
    if (type == nullptr) type = find_kept(item_.kept, "shape");
    static constexpr Shape kCustom{"Custom", std::nullopt};
    if (type != nullptr) {
      shape_ = freecad::find_shape(*type);
      if (shape_ == nullptr) shape_ = &kCustom;
      return;
    }
    if (!item_.cutter_class) {
      drop("", "its kind '" + item_.kind + "' is no shape of FreeCAD");
      return;
    }
    bool exact = true;
    shape_ = freecad::shape_of(*item_.cutter_class, exact);
    const std::string cls(model::to_text(*item_.cutter_class));
    if (shape_ == nullptr) {
      drop("", "FreeCAD has no shape for a " + cls);
    } else if (!exact) {
      drop("class", "written as " + std::string(shape_->type) + ": FreeCAD has no " + cls);
    }
  }

  void write_property(const Property& p, Json& parameters) {
    // Planning takes either for the depth of cut (`kCutterSymbols`): of a tool that states only its flutes,
    // these are the height of the edge.
    const bool flutes = p.symbol == "LCF" && find(item_.properties, "APMX") == nullptr;
    const std::string_view symbol = flutes ? std::string_view("APMX") : p.symbol;
    const std::string_view name = freecad::parameter_of(*shape_, symbol);
    if (name.empty() || (shape_->type == "VBit" && symbol == "APMX")) {
      // What the bit had stands among the kept parameters.
      const bool material = p.symbol == "SUBSTRATE" || p.symbol == "BMC";
      const bool kept = material && find_kept(item_.kept, "parameter/Material") != nullptr;
      if (material && !kept && (p.text == "hss" || p.text == "carbide")) {
        // The edge's own material counts, the body's where there is no other.
        const Property* edge = find(item_.properties, "SUBSTRATE");
        if (p.symbol == "SUBSTRATE" || edge == nullptr)
          parameters.set("Material", Json::string(p.text == "hss" ? "HSS" : "Carbide"));
        else if (edge->text != p.text)
          drop(p.symbol, "FreeCAD's bits have one material, that of the edge");
      } else if (p.symbol == "FZMAX" && p.source == freecad::kChipLoad) {
        parameters.set("Chipload", Json::string(quantity(p)));
      } else if (p.state == ValueState::kStated && !kept && !is_half(p)) {
        drop(p.symbol, "the shape " + std::string(shape_->type) + " has no parameter for it");
      }
      return;
    }
    const std::string text = quantity(p);
    // The ball's radius and the like follow again on reading.
    if (p.state == ValueState::kDerived && shape_->type != "Custom" && rederived(p.symbol)) return;
    parameters.set(name, Json::string(text));
  }

  /// A ball's radius that is half its diameter: it is read again though no parameter says it.
  [[nodiscard]] bool is_half(const Property& p) const {
    const auto dc = number_of(item_, "DC");
    return shape_->type == "Ballend" && p.symbol == "RE" && p.number && dc && *p.number == 0.5 * *dc;
  }

  [[nodiscard]] bool rederived(std::string_view symbol) const {
    return (shape_->type == "Ballend" && symbol == "RE") || (shape_->type == "Radius" && symbol == "DCN") ||
           (shape_->type == "SlittingSaw" && symbol == "APMX");
  }

  void write_kept(const std::string& path, const std::string& text, Json& parameters, Json& attributes) {
    if (path.starts_with("parameter/")) {
      parameters.set(path.substr(10), Json::string(text));
    } else if (path.starts_with("attribute/")) {
      auto value = parse_json(text, path);
      attributes.set(path.substr(10), value ? *std::move(value) : Json::string(text));
    } else if (path != kLeftOut && path != "version" && path != "id" && path != "shape" &&
               path != "shape-type") {
      drop(path, "of another format, no place for it");
    }
  }

  void tell_rest() {
    for (const auto& [name, value] :
         {std::pair{"manufacturer", &item_.manufacturer}, std::pair{"product_id", &item_.product_id},
          std::pair{"product_link", &item_.product_link}})
      if (!value->empty()) drop(name, "FreeCAD's bits have no place for it");
    if (!item_.presets.empty())
      drop("presets",
           std::to_string(item_.presets.size()) + " start values: FreeCAD's bits have no place for them");
  }

  const CatalogueItem& item_;
  LossReport& report_;
  const Shape* shape_ = nullptr;
};

/// Tool numbers by library; FreeCAD knows neither pockets nor offsets.
std::vector<FreecadFile> lists_of(const ToolLibrary& library, const std::map<std::string, std::string>& bits,
                                  LossReport& report) {
  std::map<std::string, Json> lists;
  std::map<std::string, std::set<int>> numbers;
  for (const MachineEntry& e : library.entries) {
    const auto assembly = std::ranges::find(library.assemblies, e.assembly, &ToolAssembly::id);
    std::string item = assembly == library.assemblies.end() ? e.assembly : assembly->item;
    const auto bit = bits.find(item);
    std::string path = bit == bits.end() ? file_name(e.comment) + ".fctb" : bit->second;
    if (bit == bits.end() && (e.comment.empty() || !e.assembly.empty())) {
      report.dropped.push_back({item, "number", "tool " + std::to_string(e.number) + " has no bit"});
      continue;
    }
    const std::string name = e.carousel.empty() ? library.name : e.carousel;
    const std::string list = file_name(name.empty() ? "Library" : name);
    if (!numbers[list].insert(e.number).second) {
      report.dropped.push_back(
          {item, "number",
           "tool number " + std::to_string(e.number) +
               " is that of another tool of the library; FreeCAD holds each number once"});
      continue;
    }
    if (e.pocket || !e.offsets.empty())
      report.dropped.push_back({item, "table", "FreeCAD's libraries hold neither pockets nor offsets"});
    Json entry = Json::map();
    entry.set("nr", Json::number(std::to_string(e.number)));
    entry.set("path", Json::string(path));
    auto [it, fresh] = lists.try_emplace(list, Json::list());
    it->second.items.push_back(std::move(entry));
  }
  std::vector<FreecadFile> out;
  for (auto& [name, list] : lists) {
    Json root = Json::map();
    root.set("label", Json::string(name));
    root.set("tools", std::move(list));
    root.set("version", Json::number("1"));
    out.push_back({"Library/" + name + ".fctl", json_text(root, 2) + "\n"});
  }
  return out;
}

}  // namespace

std::vector<FreecadFile> freecad_files(const ToolLibrary& library, LossReport& report) {
  std::vector<FreecadFile> out;
  std::map<std::string, std::string> bits;
  UniqueIds taken;
  for (const CatalogueItem& item : library.items) {
    auto text = BitWriter(item, report).write();
    if (!text) continue;
    const std::string name = unique_id(file_name(item.id), taken) + ".fctb";
    bits.emplace(item.id, name);
    out.push_back({std::string(kBits) + name, std::move(*text)});
    ++report.tools;
  }
  for (FreecadFile& f : lists_of(library, bits, report)) out.push_back(std::move(f));
  for (const Holder& h : library.holders)
    report.dropped.push_back({h.id, "holder", "FreeCAD's bits have no holder"});
  for (const ToolInstance& i : library.instances)
    report.dropped.push_back(
        {i.id, "instance", "FreeCAD's bits are no pieces: stock, life and measures are left"});
  for (const ToolAssembly& a : library.assemblies)
    if (a.stick_out_mm || a.functional_length_mm)
      report.dropped.push_back({a.item, "assembly", "FreeCAD's bits have no stick-out"});
  std::ranges::sort(out, {}, &FreecadFile::path);
  return out;
}

namespace {

/// With a tool number for each tool that has none, which a list of FreeCAD asks for.
ToolLibrary numbered(ToolLibrary library, LossReport& report) {
  std::set<std::string> listed;
  int last = 0;
  for (const MachineEntry& e : library.entries) {
    const auto assembly = std::ranges::find(library.assemblies, e.assembly, &ToolAssembly::id);
    listed.insert(assembly == library.assemblies.end() ? e.assembly : assembly->item);
    last = std::max(last, e.number);
  }
  const std::string carousel = library.entries.empty() ? std::string() : library.entries.front().carousel;
  for (const CatalogueItem& item : library.items) {
    if (listed.contains(item.id)) continue;
    library.entries.push_back({.number = ++last,
                               .pocket = {},
                               .carousel = carousel,
                               .assembly = item.id,
                               .offsets = {},
                               .comment = {}});
    report.derived.push_back({item.id, "number", "it has none; in the list it is " + std::to_string(last)});
  }
  return library;
}

Diagnostic not_one(const FormatOptions& options, std::string message, std::string other) {
  return {.code = "FREECAD-ONE",
          .message = std::move(message),
          .file = options.to,
          .hint = "name a file that ends in " + std::move(other)};
}

Result<Exported> write_bit(const ToolLibrary& library, const FormatOptions& options) {
  Exported out;
  auto files = freecad_files(library, out.report);
  std::erase_if(files, [](const FreecadFile& f) { return !f.path.starts_with(kBits); });
  if (files.size() > 1)
    return fail(not_one(
        options, "a .fctb holds one tool, and there are " + std::to_string(files.size()) + " to be written",
        ".fctl (a library, its bits beside it) or .zip (both folders of FreeCAD in one file)"));
  if (!files.empty()) out.bytes = std::move(files.front().bytes);
  if (!library.entries.empty())
    out.report.dropped.push_back({"", "number", "a bit has no tool number; a library (.fctl) has"});
  return out;
}

/// FreeCAD keeps its lists in the folder Library and their bits in Bit beside that.
std::string folder_of_bits(const std::string& list) {
  namespace fs = std::filesystem;
  const fs::path folder = fs::absolute(fs::path(list)).parent_path();
  std::error_code error;
  return folder.filename() == "Library" && fs::is_directory(folder / ".." / "Bit", error) ? "../Bit/" : "";
}

Result<Exported> write_list(const ToolLibrary& library, const FormatOptions& options) {
  Exported out;
  std::size_t lists = 0;
  const std::string folder = folder_of_bits(options.to);
  const ToolLibrary all = numbered(library, out.report);
  for (FreecadFile& f : freecad_files(all, out.report)) {
    if (f.path.starts_with(kBits)) {
      out.beside.emplace_back(folder + f.path.substr(kBits.size()), std::move(f.bytes));
    } else {
      ++lists;
      out.bytes = std::move(f.bytes);
    }
  }
  if (lists > 1)
    return fail(not_one(
        options, "a .fctl holds one list of tool numbers, and the library has " + std::to_string(lists),
        ".zip (all lists and their bits in one file)"));
  return out;
}

Result<Exported> write_archive(const ToolLibrary& library) {
  Exported out;
  std::vector<ZipEntry> entries;
  for (FreecadFile& f : freecad_files(library, out.report))
    entries.push_back({std::move(f.path), std::move(f.bytes)});
  if (out.report.tools == 0) return out;
  auto bytes = write_zip(entries);
  if (!bytes) return fail(bytes.error());
  out.bytes = *std::move(bytes);
  return out;
}

}  // namespace

Result<Exported> write_freecad(const ToolLibrary& library, const FormatOptions& options, Job& /*job*/) {
  const std::string ending = lower_text(std::filesystem::path(options.to).extension().string());
  auto out = ending == ".fctb"   ? write_bit(library, options)
             : ending == ".fctl" ? write_list(library, options)
                                 : write_archive(library);
  if (out && out->report.tools == 0)
    return fail({.code = "FREECAD-NONE", .message = "none of the tools has a shape in FreeCAD"});
  return out;
}

}  // namespace capstan::tooling

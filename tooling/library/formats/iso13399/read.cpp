#include <algorithm>

#include "planner/files/p21/read/parse.h"
#include "tooling/library/formats/all.h"
#include "tooling/library/formats/iso13399/iso13399.h"
#include "tooling/library/formats/iso13399/stated_items.h"
#include "tooling/library/formats/item/iso_names.h"
#include "tooling/library/formats/item/item.h"
#include "tooling/library/words/comment_words.h"

namespace capstan::tooling {
namespace {

using iso13399::Item;
using iso13399::Stated;
using model::CutterClass;

constexpr std::string_view kSchema = "CUTTING_TOOL_SCHEMA_ARM";

p21::Limits limits() {
  p21::Limits l;
  l.bytes = std::size_t{256} << 20;
  l.string_bytes = std::size_t{1} << 20;
  l.instances = std::size_t{8} << 20;
  return l;
}

/// Items of the file into items of the catalogue.
class ToCatalogue {
 public:
  ToCatalogue(const std::string& file, Imported& out, Job& job)
      : file_(file), out_(out), job_(job), gatherer_(out, file, "TOOL-VALUE", job) {}

  Status take_all(const std::vector<Item>& items, const IsoReadOptions& options) {
    for (const Item& item : items) take(item, options);
    if (!out_.library.holders.empty() && out_.library.items.empty()) return {};
    return gatherer_.finish("an ITEM that is a tool item");
  }

 private:
  /// Code, then symbol, then preferred name.
  const IsoName* resolve(const Stated& v, const std::string& tool) {
    const IsoName* by_code = find_bsu(v.bsu);
    const IsoName* by_symbol = find_symbol(v.name);
    if (by_code != nullptr && by_symbol != nullptr && by_code->symbol != by_symbol->symbol)
      out_.report.derived.push_back(
          {tool, std::string(by_code->symbol), "the code " + v.bsu + " says so, the name says " + v.name});
    if (by_code != nullptr) return by_code;
    if (by_symbol != nullptr) return by_symbol;
    if (const IsoName* by_name = find_preferred_name(v.name)) return by_name;
    if (const IsoName* by_id = find_symbol(v.property)) return by_id;
    return find_preferred_name(v.property);
  }

  void add(CatalogueItem& out, const Stated& v) {
    const IsoName* n = resolve(v, out.id);
    std::string symbol = n == nullptr ? v.name : std::string(n->symbol);
    if (symbol.empty()) symbol = v.property.empty() ? v.bsu : v.property;
    std::string source = v.why;
    if (v.state == ValueState::kStated) {
      source = "ISO 13399 " + (v.bsu.empty() ? v.name : v.name + ", code " + v.bsu);
    }
    if (n == nullptr && symbol_fact(symbol) == nullptr)
      out_.report.dropped.push_back({out.id, symbol, "no symbol that is known; kept under its name"});
    const SymbolFact* fact = symbol_fact(symbol);
    if (fact != nullptr && fact->quantity == Quantity::kAngle && mm_per_unit_of(v.unit)) {
      // Public files do this: the number may be right, nothing says so.
      out.kept.emplace_back(symbol, v.text + " " + v.unit);
      const std::string what =
          "an angle in " + v.unit + " is no angle: " + v.text + " " + v.unit + " is not used";
      out_.report.dropped.push_back({out.id, symbol, what});
      job_.report({.code = "DATA-UNIT",
                   .severity = Severity::kWarning,
                   .message = symbol + ": " + what,
                   .file = file_,
                   .line = v.line,
                   .instance = v.id,
                   .expected = "deg or rad"});
      return;
    }
    const std::size_t before = out.properties.size();
    auto fault = add_value(out, {symbol, v.text, v.unit, source},
                           {file_, v.line, "#" + std::to_string(v.id) + " of item " + out.id});
    if (fault) fault->instance = v.id;
    gatherer_.fault(std::move(fault));
    if (out.properties.size() > before) out.properties.back().state = v.state;
  }

  void take(const Item& item, const IsoReadOptions& options) {
    if (item.role == "cutting item") {
      out_.report.dropped.push_back({item.number, "", "a cutting item (insert): planning takes whole tools"});
      return;
    }
    CatalogueItem out;
    out.id = item.number.empty() ? item.name : item.number;
    out.description = item.description.empty() ? item.name : item.description;
    out.manufacturer = item.maker;
    out.product_id = options.product_id.empty() ? item.number : options.product_id;
    if (!item.name.empty()) out.kept.emplace_back("name", item.name);
    if (!item.role.empty()) out.kept.emplace_back("role", item.role);
    for (const Stated& v : item.values) add(out, v);
    if (item.role == "adaptive item") {
      holder(out);
      return;
    }
    classify(out, item, options);
    (void)gatherer_.take(std::move(out), {file_, item.line, "item " + item.number});
  }

  /// Of the shank sizes and a connection, a holder; its outline is in the 3D model only.
  void holder(const CatalogueItem& item) {
    Holder h;
    h.id = item.id;
    h.description = item.description;
    h.product_id = item.product_id;
    h.manufacturer = item.manufacturer;
    if (const Property* c = find(item.properties, "CZCMS")) h.connection = c->text;
    h.gage_length_mm = number_of(item, "LPR");
    if (!h.gage_length_mm) h.gage_length_mm = number_of(item, "LF");
    for (const Property& p : item.properties)
      h.kept.emplace_back(p.symbol, p.text + (p.unit.empty() ? "" : " " + p.unit));
    out_.report.dropped.push_back({item.id, "outline", "an adaptive item states no outline; its model does"});
    out_.library.holders.push_back(std::move(h));
  }

  void classify(CatalogueItem& out, const Item& item, const IsoReadOptions& options) {
    out.kind = options.gtc_class.empty() ? item.kind : options.gtc_class;
    if (!item.left_out.empty()) {
      leave_out(out, item.left_out, out_.report);
      return;
    }
    if (item.cutter_class) {
      out.cutter_class = item.cutter_class;
      return;
    }
    // MILSQS is the only class of the generic hierarchy that a public source explains.
    if (options.gtc_class == "MILSQS") {
      out.cutter_class = CutterClass::kEndmill;
      out_.report.derived.push_back({out.id, "class", "GTC class MILSQS: square shoulder, solid"});
    } else if (const auto c = class_from_words(out.description)) {
      out.cutter_class = c;
      out_.report.derived.push_back({out.id, "class", "from the words '" + out.description + "'"});
    } else {
      leave_out(out, "neither its class nor its words tell what it is", out_.report);
    }
    class_by_radius(out);
  }

  const std::string& file_;
  Imported& out_;
  Job& job_;
  ItemGatherer gatherer_;
};

bool recognises(std::string_view bytes, std::string_view /*file*/) {
  const std::string_view head = bytes.substr(0, std::size_t{1} << 16);
  return head.find("ISO-10303-21") != std::string_view::npos &&
         head.find("CUTTING_TOOL_SCHEMA") != std::string_view::npos;
}

Result<Imported> read(std::string_view bytes, const std::string& file, const FormatOptions& /*options*/,
                      Job& job) {
  return read_iso13399(bytes, file, {}, job);
}

}  // namespace

Result<Imported> read_iso13399(std::string_view bytes, const std::string& file, const IsoReadOptions& options,
                               Job& job) {
  auto parsed = p21::parse(std::string(bytes), file, limits(), job);
  if (!parsed) return fail(parsed.error());
  const auto schemas = parsed->schemas();
  const bool ours = std::ranges::any_of(schemas, [](const std::string& s) {
    std::string upper = s;
    for (char& c : upper)
      if (c >= 'a' && c <= 'z') c = static_cast<char>(c - 32);
    return upper.starts_with(kSchema);
  });
  if (!ours)
    return fail({.code = "ISO13399-FORM",
                 .message = "the schema is " + (schemas.empty() ? "not stated" : "'" + schemas.front() + "'"),
                 .file = file,
                 .expected = "FILE_SCHEMA(('CUTTING_TOOL_SCHEMA_ARM'))"});
  Imported out;
  out.library.source = file;
  const auto items = iso13399::stated_items(*parsed, file, out.report);
  if (!items) return fail(items.error());
  if (Status s = ToCatalogue(file, out, job).take_all(*items, options); !s) return fail(s.error());
  return out;
}

const Format& iso13399_format() {
  static const Format kFormat{.name = "iso13399",
                              .title = "ISO 13399 (Part 21)",
                              .endings = {".p21"},
                              .recognises = recognises,
                              .read = read,
                              .write = write_iso13399};
  return kFormat;
}

}  // namespace capstan::tooling

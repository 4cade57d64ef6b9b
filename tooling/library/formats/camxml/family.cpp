#include <algorithm>

#include "planner/ground/base/number.h"
#include "tooling/library/formats/all.h"
#include "tooling/library/formats/item/iso_names.h"
#include "tooling/library/formats/item/item.h"
#include "tooling/library/formats/xml.h"
#include "tooling/library/words/comment_words.h"

// A maker's catalogue page as XML: FamilyDetails with one Parameters element per size. The names of its
// elements are whole table headings, escaped: "DC_x0020__x003C_br_x003E_..." begins with the symbol DC.

namespace capstan::tooling {
namespace {

/// The heading before its markup, _xHHHH_ undone for ASCII.
std::string heading(std::string_view name) {
  std::string out;
  for (std::size_t i = 0; i < name.size(); ++i) {
    int code = -1;
    if (name[i] == '_' && i + 6 < name.size() && name[i + 1] == 'x' && name[i + 6] == '_') {
      code = 0;
      for (std::size_t k = i + 2; k < i + 6; ++k) {
        const char c = name[k];
        const int digit = c >= '0' && c <= '9'   ? c - '0'
                          : c >= 'A' && c <= 'F' ? c - 'A' + 10
                          : c >= 'a' && c <= 'f' ? c - 'a' + 10
                                                 : -1;
        code = digit < 0 || code < 0 ? -1 : code * 16 + digit;
      }
    }
    if (code < 0) {
      out += name[i];
      continue;
    }
    if (code < 0x80) out += static_cast<char>(code);
    i += 6;
  }
  return out.substr(0, out.find('<'));
}

/// Cells end in "~" and hold blanks that do not break.
std::string cell(std::string text) {
  for (const std::string_view blank : {"&nbsp;", "\xC2\xA0"})
    for (auto at = text.find(blank); at != std::string::npos; at = text.find(blank))
      text.replace(at, blank.size(), " ");
  while (!text.empty() && (text.back() == '~' || text.back() == ' ')) text.pop_back();
  text = trimmed_text(text);
  return text == "-" ? std::string() : text;  // a dash: not given
}

/// The text of a description without its tags.
std::string without_tags(std::string_view text) {
  std::string out;
  bool inside = false;
  for (const char c : text) {
    if (c == '<') inside = true;
    if (!inside) out += c;
    if (c == '>') inside = false;
  }
  return out;
}

std::string_view unit_of(std::string_view symbol, std::string_view length_unit) {
  const SymbolFact* f = symbol_fact(symbol);
  if (symbol == "WT") return "kg";
  if (symbol == "LH") return length_unit;
  if (f == nullptr) return "";
  return f->quantity == Quantity::kLength ? length_unit : f->quantity == Quantity::kAngle ? "deg" : "";
}

class FamilyReader {
 public:
  FamilyReader(const std::string& file, std::string unit, Imported& out, Job& job)
      : file_(file), unit_(std::move(unit)), out_(out), gatherer_(out, file, "CATALOGUE-VALUE", job) {}

  Status read(const XmlNode& root) {
    std::string words;
    if (const XmlNode* info = root.find("FamilyInfo")) {
      family_ = cell(info->text_of("FamilyName"));
      while (!family_.empty() && (family_.back() == ':' || family_.back() == ' ')) family_.pop_back();
      words = without_tags(info->text_of("FamilyDesc"));
      out_.library.name = family_;
    }
    cutter_class_ = class_from_words(words);
    words_ = words.substr(0, words.find("(-)"));
    std::size_t row = 0;
    for (const XmlNode& size : root.children)
      if (size.name == "Parameters") take(size, ++row);
    return gatherer_.finish("Parameters elements, one per size");
  }

 private:
  void take(const XmlNode& size, std::size_t row) {
    CatalogueItem item;
    item.id = item.product_id = cell(size.text_of("Designation"));
    if (item.id.empty()) item.id = family_ + " " + std::to_string(row);
    const Place place{file_, size.line, item.id};
    item.description = family_ + " " + item.id;
    item.kind = family_;
    for (const XmlNode& c : size.children) property(item, c, place);
    if (find(item.properties, "ZEFF") == nullptr)
      if (const auto n = number_of(item, "CICT"))
        add_derived(item, "ZEFF", *n, "", "the number of inserts", out_.report);
    if (const auto head = number_of(item, "LH"); head && *head > 0.0)
      add_derived(item, "LPR", *head, unit_, "LH: all but the shank stands out", out_.report);
    item.cutter_class = cutter_class_;
    if (cutter_class_) {
      add_derived_text(item, "SUBSTRATE", "carbide", "indexable inserts; the file names no grade",
                       out_.report);
      out_.report.derived.push_back({item.id, "class", "from the words '" + words_ + "'"});
    } else {
      leave_out(item, "the words of its family do not tell what it is", out_.report);
    }
    const auto rpmx = number_of(item, "RPMX");
    if (rpmx && *rpmx == 0.0)
      std::erase_if(item.properties, [](const Property& p) { return p.symbol == "RPMX"; });
    (void)gatherer_.take(std::move(item), place);
  }

  void property(CatalogueItem& item, const XmlNode& c, const Place& place) {
    const std::string name = heading(c.name), text = cell(c.text);
    if (text.empty() || c.name == "Designation") return;
    std::string symbol(trimmed_text(name.substr(0, name.find_first_of(" \t"))));
    // A weight has a picture for a heading, Kg.svg.
    if (symbol.empty() && c.name.find("Kg.svg") != std::string::npos) symbol = "WT";
    if (symbol == "CSP") {
      gatherer_.fault(add_value(item, {"CSP", text == "0" ? "false" : "true", "", "catalogue CSP"}, place));
    } else if (find_symbol(symbol) != nullptr || symbol_fact(symbol) != nullptr) {
      gatherer_.fault(add_value(item, {symbol, text, unit_of(symbol, unit_), "catalogue " + symbol}, place));
    } else {
      // Columns without a heading hold numbers of the catalogue's own.
      item.kept.emplace_back(symbol.empty() ? "column" : symbol, text);
      if (!symbol.empty() && !symbol.starts_with("Column"))
        out_.report.dropped.push_back(
            {item.id, symbol, "no symbol that is known; kept word for word: " + text});
    }
  }

  const std::string& file_;
  std::string unit_;
  Imported& out_;
  ItemGatherer gatherer_;
  std::string family_, words_;
  std::optional<model::CutterClass> cutter_class_;
};

bool recognises(std::string_view bytes, std::string_view /*file*/) {
  return bytes.substr(0, 4096).find("<FamilyDetails") != std::string_view::npos;
}

Result<Imported> read(std::string_view bytes, const std::string& file, const FormatOptions& options,
                      Job& job) {
  auto root = parse_xml(bytes, file);
  if (!root) return fail(root.error());
  Imported out;
  out.library.source = file;
  const bool inches = options.mm_per_unit && *options.mm_per_unit == kMmPerInch;
  if (!options.mm_per_unit) {
    out.report.derived.push_back({"", "unit", "the file states no unit of length: millimetres"});
    job.note("CATALOGUE-UNIT", "the file states no unit of length, millimetres are taken", file);
  }
  FamilyReader reader(file, inches ? "in" : "mm", out, job);
  if (Status s = reader.read(*root); !s) return fail(s.error());
  return out;
}

}  // namespace

const Format& family_format() {
  static const Format kFormat{.name = "family",
                              .title = "catalogue family (FamilyDetails XML)",
                              .endings = {".xml"},
                              .recognises = recognises,
                              .read = read};
  return kFormat;
}

}  // namespace capstan::tooling

#include <algorithm>
#include <map>

#include "planner/ground/base/tables/separated.h"
#include "tooling/library/formats/all.h"
#include "tooling/library/formats/din4000/din4000.h"
#include "tooling/library/formats/xml.h"

namespace capstan::tooling {
namespace {

using din4000::Record;

bool is_code(std::string_view s) {
  return s.size() >= 2 && s[0] >= 'A' && s[0] <= 'K' && s[1] >= '0' && s[1] <= '9';
}

std::string_view without_mark(std::string_view bytes) {
  if (bytes.starts_with("\xEF\xBB\xBF")) bytes.remove_prefix(3);
  return bytes;
}

// --- XML: Tool-Data, in the layouts of 2013 and 2016
// ---------------------------------------------------------

void take_properties(const XmlNode& list, std::string_view index, Record& r) {
  for (const XmlNode& p : list.children) {
    if (p.name != "Property-Data") continue;
    std::string code = p.text_of("PropertyName");
    const std::string value = p.text_of("Value");
    if (code.empty() || code == "NSM" || code == "BLD") continue;
    // A block repeats an earlier value, or contains the second of its kind.
    if (!index.empty() && index != "1") code += "_" + std::string(index);
    const std::pair<std::string, std::string> one(code, value);
    if (std::ranges::find(r.values, one) == r.values.end()) r.values.push_back(one);
  }
}

Record record_of(const XmlNode& tool) {
  Record r;
  r.line = tool.line;
  if (const XmlNode* main = tool.find("Main-Data")) {
    r.manufacturer = main->text_of("Manufacturer");
    for (const char* name : {"PrimaryId", "ID21002", "CustomerMaterialId"})
      if (r.id.empty()) r.id = main->text_of(name);
  }
  if (const XmlNode* category = tool.find("Category")) {
    for (const XmlNode& c : category->children) {
      if (c.text_of("PropertyName") == "NSM") r.table = c.text_of("Value");
      if (c.text_of("PropertyName") == "BLD") r.figure = c.text_of("Value");
    }
  }
  for (const XmlNode& c : tool.children) {
    if (c.name == "Properties") take_properties(c, "", r);
    if (c.name == "Block") take_properties(c, c.attribute("index"), r);
  }
  for (const auto& [code, value] : r.values)
    if (code == "J21" && r.id.empty()) r.id = value;
  return r;
}

Result<std::vector<Record>> records_of_xml(std::string_view bytes, const std::string& file) {
  auto root = parse_xml(bytes, file);
  if (!root) return fail(root.error());
  if (root->name != "Tool-Data")
    return fail({.code = "DIN4000-FORM",
                 .message = "the root element is '" + root->name + "'",
                 .file = file,
                 .line = root->line,
                 .expected = "Tool-Data"});
  std::vector<Record> out;
  for (const XmlNode& tool : root->children)
    if (tool.name == "Tool") out.push_back(record_of(tool));
  return out;
}

// --- CSV: a line of codes, then a line per tool
// ----------------------------------------------------------------

Result<std::vector<Record>> records_of_csv(std::string_view bytes, const std::string& file) {
  auto rows = separated_rows(bytes, ';', file, "DIN4000-FORM", StrayQuotes::kKept);
  if (!rows) return fail(rows.error());
  std::vector<std::string> head;
  if (!rows->empty()) head = rows->front().cells;
  std::map<std::string, int> met;
  for (std::string& h : head) {
    h = trimmed_text(h);
    if (!h.empty() && ++met[h] > 1)
      return fail({.code = "DIN4000-FORM",
                   .message = "the column " + h + " is given twice",
                   .file = file,
                   .line = 1,
                   .expected = "each code once"});
  }
  std::vector<Record> out;
  for (std::size_t k = 1; k < rows->size(); ++k) {
    const SeparatedRow& row = (*rows)[k];
    if (std::ranges::all_of(row.cells, [](const std::string& f) { return trimmed_text(f).empty(); }))
      continue;
    if (row.cells.size() != head.size())
      return fail({.code = "DIN4000-FORM",
                   .message = std::to_string(row.cells.size()) + " fields",
                   .file = file,
                   .line = row.line,
                   .expected = std::to_string(head.size()) + " as in the first line"});
    Record r;
    r.line = row.line;
    for (std::size_t i = 0; i < head.size(); ++i) {
      const std::string& code = head[i];
      const std::string& value = row.cells[i];
      if (code == "NSM") r.table = value;
      if (code == "BLD") r.figure = value;
      if (code == "J21") r.id = value;
      if (!code.empty() && code != "NSM" && code != "BLD") r.values.emplace_back(code, value);
    }
    out.push_back(std::move(r));
  }
  return out;
}

bool recognises(std::string_view bytes, std::string_view /*file*/) {
  bytes = without_mark(bytes);
  const std::string_view head = bytes.substr(0, 4096);
  if (head.find('<') != std::string_view::npos) return head.find("<Tool-Data") != std::string_view::npos;
  const std::string_view line = head.substr(0, head.find('\n'));
  std::size_t codes = 0, from = 0;
  bool table = false;
  while (from <= line.size()) {
    const auto end = std::min(line.find(';', from), line.size());
    const std::string_view field = trimmed_text(line.substr(from, end - from));
    table = table || field == "NSM";
    codes += is_code(field) ? 1 : 0;
    from = end + 1;
  }
  return table && codes >= 2;
}

Result<Imported> read(std::string_view bytes, const std::string& file, const FormatOptions& /*options*/,
                      Job& job) {
  bytes = without_mark(bytes);
  const bool xml = bytes.substr(0, 4096).find('<') != std::string_view::npos;
  auto records = xml ? records_of_xml(bytes, file) : records_of_csv(bytes, file);
  if (!records) return fail(records.error());
  Imported out;
  out.library.source = file;
  ItemGatherer gatherer(out, file, "DIN4000-VALUE", job);
  for (const Record& r : *records) {
    if (r.table.empty())
      return fail({.code = "DIN4000-FORM",
                   .message = "a tool without a table (NSM)",
                   .file = file,
                   .line = r.line,
                   .path = r.id,
                   .expected = "NSM, e.g. DIN4000-82: its codes mean nothing without"});
    if (r.id.empty())
      return fail({.code = "DIN4000-FORM",
                   .message = "a tool without an article number",
                   .file = file,
                   .line = r.line,
                   .expected = "J21 or PrimaryId"});
    din4000::read_record(r, file, out, gatherer);
  }
  if (Status s = gatherer.finish("tools, as Tool elements or lines"); !s) return fail(s.error());
  return out;
}

}  // namespace

const Format& din4000_format() {
  static const Format kFormat{.name = "din4000",
                              .title = "DIN 4000 (XML, CSV)",
                              .endings = {".xml", ".csv"},
                              .recognises = recognises,
                              .read = read};
  return kFormat;
}

}  // namespace capstan::tooling

#include "tooling/library/formats/csv/csv.h"

#include <algorithm>
#include <map>

#include "planner/ground/base/number.h"
#include "tooling/library/formats/all.h"
#include "tooling/library/formats/values.h"

namespace capstan::tooling::csv {
namespace {

/// True if the table has decimal commas: columns of numbers contain a comma, and none a point.
bool has_decimal_commas(const std::vector<SeparatedRow>& rows, const ColumnMap& map) {
  bool comma = false;
  for (std::size_t r = 1; r < rows.size(); ++r) {
    for (std::size_t k = 0; k < map.columns.size() && k < rows[r].cells.size(); ++k) {
      const SymbolFact* fact = symbol_fact(map.columns[k].field);
      if (fact == nullptr || fact->quantity == Quantity::kText) continue;
      const std::string_view t = trimmed_text(rows[r].cells[k]);
      if (t.find('.') != std::string_view::npos) return false;
      const auto at = t.find(',');
      if (at == std::string_view::npos) continue;
      std::string point(t);
      point[at] = '.';
      comma = comma || parse_double(point).has_value();
    }
  }
  return comma;
}

/// The saved map, put into the order of the file's titles.
Result<ColumnMap> fitted(const ColumnMap& saved, const std::vector<std::string>& titles,
                         const std::string& file) {
  ColumnMap out = saved;
  out.columns.clear();
  std::vector<bool> used(saved.columns.size(), false);
  for (const std::string& title : titles) {
    Column c{title, "keep", ""};
    for (std::size_t k = 0; k < saved.columns.size(); ++k) {
      if (used[k] || saved.columns[k].title != title) continue;
      used[k] = true;
      c = saved.columns[k];
      break;
    }
    out.columns.push_back(std::move(c));
  }
  for (std::size_t k = 0; k < used.size(); ++k) {
    if (!used[k] && saved.columns[k].field != "keep" && saved.columns[k].field != "ignore")
      return fail({.code = "CSV-COLUMN",
                   .message = "the column '" + saved.columns[k].title + "' of the column map is missing",
                   .file = file,
                   .line = 1,
                   .expected = "a title for each column of the map",
                   .hint = "correct the map or the first row"});
  }
  return out;
}

}  // namespace

Result<Imported> read(std::string_view bytes, const std::string& file, const FormatOptions& options,
                      Job& job) {
  ColumnMap map;
  const bool saved = !options.column_map.empty();
  if (saved) {
    auto m = read_map(options.column_map, "column map", job);
    if (!m) return fail(m.error());
    map = *std::move(m);
  } else {
    map.separator = separator_of(bytes);
    if (map.separator == '\0') map.separator = ',';
  }
  auto rows = separated_rows(bytes, map.separator, file, "CSV-SYNTAX", StrayQuotes::kKept);
  if (!rows) return fail(rows.error());
  // Spreadsheets end their tables with rows of separators alone.
  std::erase_if(*rows, [](const SeparatedRow& r) {
    return std::ranges::all_of(r.cells, [](const std::string& c) { return c.empty(); });
  });
  if (rows->empty())
    return fail({.code = "CSV-SYNTAX", .message = "the table is empty", .file = file, .expected = "titles"});
  // Fusion marks its export behind the last title; no row has a cell there.
  if (rows->front().cells.back().starts_with("CSV_TOOLS_VERSION")) rows->front().cells.pop_back();
  const auto& titles = rows->front().cells;
  if (saved) {
    auto m = fitted(map, titles, file);
    if (!m) return fail(m.error());
    map = *std::move(m);
  } else {
    map = map_of_titles(titles, map.separator);
    // Which of two diameters cuts is not for us to say.
    std::string first;
    for (const std::string& title : titles) {
      if (map_of_titles({title}, map.separator).columns.front().field != "DC") continue;
      if (!first.empty())
        return fail(
            {.code = "DATA-DUPLICATE",
             .message = "the columns '" + first + "' and '" + title + "' are both the cutting diameter",
             .file = file,
             .line = 1,
             .expected = "one column of diameters",
             .hint = "rename one of them, or give a column map"});
      first = title;
    }
    if (has_decimal_commas(*rows, map)) map.decimal = ',';
  }
  std::map<std::string, std::string> fields;
  for (const Column& c : map.columns) {
    if (c.field == "keep" || c.field == "ignore") continue;
    const auto [at, fresh] = fields.emplace(c.field, c.title);
    if (!fresh)
      return fail({.code = "DATA-DUPLICATE",
                   .message = "the columns '" + at->second + "' and '" + c.title + "' both hold " + c.field,
                   .file = file,
                   .line = 1,
                   .expected = "one column for each",
                   .hint = "map one of them to keep"});
  }
  if (!fields.contains("DC"))
    return fail({.code = "CSV-COLUMN",
                 .message = "no column holds the cutting diameter",
                 .file = file,
                 .line = 1,
                 .expected = "a column DC, or one that the column map says to be it",
                 .hint = "save a map (--save-map), correct it, and give it as --column-map"});
  return read_rows(*rows, map, file, options, job);
}

}  // namespace capstan::tooling::csv

namespace capstan::tooling {
namespace {

/// A table whose first row names a diameter and something else that we know.
bool recognises(std::string_view bytes, std::string_view) {
  const char separator = separator_of(bytes.substr(0, std::size_t{1} << 20));
  if (separator == '\0' || bytes.starts_with("<") || trimmed_text(bytes.substr(0, 64)).starts_with('{'))
    return false;
  std::string_view text = bytes;
  if (text.starts_with("\xEF\xBB\xBF")) text.remove_prefix(3);
  text = text.substr(0, text.find('\n'));
  const auto rows = separated_rows(text, separator, "", "CSV-SYNTAX", StrayQuotes::kKept);
  if (!rows || rows->empty()) return false;
  const auto map = csv::map_of_titles(rows->front().cells, separator);
  std::size_t known = 0;
  bool diameter = false;
  for (const auto& c : map.columns) {
    if (c.field != "keep") ++known;
    diameter = diameter || c.field == "DC";
  }
  return diameter && known >= 2;
}

}  // namespace

const Format& csv_format() {
  static const Format kFormat{"csv",
                              "table (.csv, .tsv) with a column for the diameter",
                              {".csv", ".tsv", ".txt"},
                              &recognises,
                              &csv::read,
                              &csv::write};
  return kFormat;
}

}  // namespace capstan::tooling

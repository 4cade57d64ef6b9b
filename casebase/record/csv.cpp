#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cstdint>

#include "casebase/casebase.h"
#include "casebase/record/fields.h"
#include "casebase/store/log.h"
#include "planner/ground/base/no_number.h"
#include "planner/ground/base/number.h"
#include "planner/ground/base/text.h"
#include "planner/ground/base/tables/separated.h"

// One column for each text, number and word. A figure has three: its value, NAME_std_dev, NAME_origin; a
// series two: "time:value time:value ...", NAME_origin. An empty cell: not known.

namespace capstan::casebase {
namespace {

using Fault = std::optional<std::string>;

/// What a column holds of its field.
enum class Part : std::uint8_t { kId, kValue, kStdDev, kOrigin };
struct Column {
  std::string name;
  const Field* field = nullptr;
  Part part = Part::kValue;
};

std::vector<Column> make_columns() {
  std::vector<Column> out = {{"id", nullptr, Part::kId}};
  for (const Field& f : fields()) {
    const std::string name(f.name);
    out.push_back({name, &f, Part::kValue});
    const bool figure = std::holds_alternative<FigureAt>(f.at);
    if (figure) out.push_back({name + "_std_dev", &f, Part::kStdDev});
    if (figure || std::holds_alternative<SeriesAt>(f.at))
      out.push_back({name + "_origin", &f, Part::kOrigin});
  }
  return out;
}
const std::vector<Column>& columns() {
  static const std::vector<Column> kColumns = make_columns();
  return kColumns;
}

std::string joined(const std::vector<std::string>& cells) {
  std::string out;
  for (const std::string& cell : cells) {
    if (&cell != &cells.front()) out += ',';
    out += separated_cell(cell, ',');
  }
  return out + "\r\n";
}

std::string series_text(const Series& series) {
  std::string out;
  for (const Sample& s : series.samples)
    out += (out.empty() ? "" : " ") + shortest(s.t_s) + ':' + shortest(s.value);
  return out;
}

std::string cell_of(const Column& column, const Case& c) {
  if (column.part == Part::kId) return c.id;
  const Field& f = *column.field;
  if (is_default(f, c)) return {};
  if (const auto* t = std::get_if<TextAt>(&f.at)) return value(*t, c);
  if (const auto* n = std::get_if<NumberAt>(&f.at)) return shortest(value(*n, c));
  if (const auto* i = std::get_if<CountAt>(&f.at)) return std::to_string(value(*i, c));
  if (const auto* w = std::get_if<WordAt>(&f.at)) return std::string(w->get(c));
  if (const auto* s = std::get_if<SeriesAt>(&f.at)) {
    const Series& series = value(*s, c);
    return column.part == Part::kValue ? series_text(series) : std::string(to_text(series.origin));
  }
  const Figure& figure = *value(std::get<FigureAt>(f.at), c);
  if (column.part == Part::kValue) return shortest(figure.value);
  if (column.part == Part::kOrigin) return std::string(to_text(figure.origin));
  return figure.std_dev == 0.0 ? std::string() : shortest(figure.std_dev);
}

Fault read_series(std::string_view text, Series& series) {
  while (!text.empty()) {
    const std::string_view pair = text.substr(0, text.find(' '));
    text.remove_prefix(std::min(text.size(), pair.size() + 1));
    const std::size_t colon = pair.find(':');
    if (colon == std::string_view::npos) return "'" + std::string(pair.substr(0, 40)) + "' is not TIME:VALUE";
    const auto t = parse_double(pair.substr(0, colon)), v = parse_double(pair.substr(colon + 1));
    if (!t || !v) return "'" + std::string(pair.substr(0, 40)) + "' is not TIME:VALUE";
    if (series.samples.size() == kMaxSamples)
      return "it has more than " + std::to_string(kMaxSamples) + " samples";
    series.samples.push_back({*t, *v});
  }
  return std::nullopt;
}

/// Puts a cell's value where it belongs; what is wrong with it.
Fault put_value(const Field& f, const std::string& cell, Case& c) {
  if (const auto* t = std::get_if<TextAt>(&f.at)) {
    (*t)(c) = cell;
    return std::nullopt;
  }
  if (const auto* w = std::get_if<WordAt>(&f.at)) {
    if (w->set(c, cell)) return std::nullopt;
    return "'" + cell.substr(0, 40) + "' is none of its words";
  }
  if (const auto* s = std::get_if<SeriesAt>(&f.at)) return read_series(cell, (*s)(c));
  if (const auto* i = std::get_if<CountAt>(&f.at)) {
    int& whole = (*i)(c);
    const auto [end, error] = std::from_chars(cell.data(), cell.data() + cell.size(), whole);
    if (error != std::errc() || end != cell.data() + cell.size()) return "it is not a whole number";
    return std::nullopt;
  }
  const std::optional<double> number = parse_double(cell);
  if (!number) return no_number(cell);
  if (const auto* n = std::get_if<NumberAt>(&f.at)) {
    (*n)(c) = *number;
  } else {
    std::get<FigureAt>(f.at)(c) = Figure{*number, 0.0, c.origin};
  }
  return std::nullopt;
}

/// Puts what a column says beside a value.
Fault put_beside(const Column& column, const std::string& cell, Case& c) {
  const auto origin = origin_of(cell);
  if (column.part == Part::kOrigin && !origin) return "'" + cell.substr(0, 40) + "' is none of its words";
  if (const auto* s = std::get_if<SeriesAt>(&column.field->at)) {
    (*s)(c).origin = *origin;
    return std::nullopt;
  }
  std::optional<Figure>& figure = std::get<FigureAt>(column.field->at)(c);
  if (!figure) return "there is no " + std::string(column.field->name) + " beside it";
  if (column.part == Part::kOrigin) {
    figure->origin = *origin;
    return std::nullopt;
  }
  const std::optional<double> number = parse_double(cell);
  if (!number) return no_number(cell);
  figure->std_dev = *number;
  return std::nullopt;
}

/// The head's columns in the order of a row's cells.
struct HeadRow {
  std::vector<const Column*> of_cell;
  Fault fault;
};

HeadRow head_row_of(const std::vector<std::string>& names) {
  HeadRow head;
  for (const std::string& name : names) {
    const auto column =
        std::find_if(columns().begin(), columns().end(), [&](const Column& c) { return c.name == name; });
    if (column == columns().end()) {
      head.fault = "the column '" + name.substr(0, 40) + "' is unknown";
      return head;
    }
    if (std::find(head.of_cell.begin(), head.of_cell.end(), &*column) != head.of_cell.end()) {
      head.fault = "the column '" + name + "' is there twice";
      return head;
    }
    head.of_cell.push_back(&*column);
  }
  for (const Field& f : fields()) {
    if (f.needed && std::find(names.begin(), names.end(), f.name) == names.end()) {
      head.fault = "the column '" + std::string(f.name) + "' is missing";
      return head;
    }
  }
  return head;
}

Fault read_case(const HeadRow& head, const SeparatedRow& row, Case& c) {
  if (row.cells.size() != head.of_cell.size())
    return fmt::format("{} fields instead of {}", row.cells.size(), head.of_cell.size());
  // A base of an earlier version holds such text and days, under an id that fits: its export is read whole.
  Fault unfit;
  // The case's own origin is what figures have that say none; then values; then what stands beside them.
  for (const int turn : {0, 1, 2}) {
    for (std::size_t i = 0; i < row.cells.size(); ++i) {
      const Column& column = *head.of_cell[i];
      const std::string& cell = row.cells[i];
      if (column.part == Part::kId) {
        c.id = cell;
        continue;
      }
      const int its_turn = column.name == "origin" ? 0 : column.part == Part::kValue ? 1 : 2;
      if (cell.empty() || its_turn != turn) continue;
      if (!is_utf8(cell) && !unfit) unfit = column.name + ": the text is not UTF-8; save the table as UTF-8";
      if (auto wrong = turn == 2 ? put_beside(column, cell, c) : put_value(*column.field, cell, c))
        return column.name + ": " + *wrong;
    }
  }
  if (auto wrong = fault_of(c)) return wrong;
  if (!c.from.time_utc.empty() && !is_of_calendar(c.from.time_utc) && !unfit)
    unfit = "time_utc: there is no day " + c.from.time_utc.substr(0, 10);
  const std::string id = id_of(c);
  if (unfit && c.id != id) return unfit;
  if (!c.id.empty() && c.id != id)
    return "the id does not fit the case: it was altered; leave it empty if that is meant";
  c.id = id;
  return std::nullopt;
}

}  // namespace

std::string to_csv(std::span<const Case> cases) {
  std::vector<std::string> cells;
  for (const Column& column : columns()) cells.push_back(column.name);
  std::string out = joined(cells);
  for (const Case& c : cases) {
    for (std::size_t i = 0; i < cells.size(); ++i) cells[i] = cell_of(columns()[i], c);
    out += joined(cells);
  }
  return out;
}

Result<std::vector<Case>> from_csv(std::string_view text, const std::string& file) {
  const auto wrong = [&](std::uint64_t line, std::string message) {
    return fail(Diagnostic{.code = "CASE-CSV",
                           .message = std::move(message),
                           .file = file,
                           .line = line,
                           .expected = "a table as 'capstan cases export' writes it",
                           .hint = "mend the line, or take it out"});
  };
  const auto rows = separated_rows(text, ',', file, "CASE-CSV", StrayQuotes::kRefused);
  if (!rows) return fail(rows.error());
  if (rows->empty()) return wrong(1, "there is nothing in it");
  const HeadRow head = head_row_of(rows->front().cells);
  if (head.fault) return wrong(rows->front().line, *head.fault);
  std::vector<Case> cases;
  for (std::size_t i = 1; i < rows->size(); ++i) {
    const SeparatedRow& row = (*rows)[i];
    Case c;
    if (const auto fault = read_case(head, row, c)) return wrong(row.line, *fault);
    cases.push_back(std::move(c));
    if (cases.size() > kMaxCases) return wrong(row.line, "more cases than a case base holds");
  }
  return cases;
}

}  // namespace capstan::casebase

#include <fmt/format.h>

#include <algorithm>

#include "casebase/retain/cells.h"
#include "casebase/retain/lines.h"
#include "planner/ground/base/nearest_names.h"
#include "planner/ground/base/number.h"
#include "planner/ground/base/tables/separated.h"

namespace capstan::casebase::retain {
namespace {

// A row's cells. Logs are numbers and names: no cell in quotes holds a separator.
std::vector<std::string_view> cells_of(std::string_view line, char separator) {
  std::vector<std::string_view> out;
  if (separator == ' ') {
    while (true) {
      line = without_blanks(line);
      if (line.empty()) return out;
      const auto end = line.find_first_of(" \t");
      out.push_back(line.substr(0, end));
      line.remove_prefix(out.back().size());
    }
  }
  while (true) {
    const auto end = line.find(separator);
    std::string_view cell = without_blanks(line.substr(0, end));
    if (cell.size() >= 2 && cell.front() == '"' && cell.back() == '"') cell = cell.substr(1, cell.size() - 2);
    out.push_back(cell);
    if (end == std::string_view::npos) return out;
    line.remove_prefix(end + 1);
  }
}

struct Columns {
  std::vector<std::optional<Column>> of;
  std::size_t least = 0;  // that a first row may have; the columns behind its cells are not there. 0: all
  char separator = '\0';  // not known yet
  double time_factor = 1.0;
};

Diagnostic wrong_columns(const std::string& file, std::uint64_t line, std::string message) {
  return {.code = "LOG-COLUMNS",
          .message = std::move(message),
          .file = file,
          .line = line,
          .expected = "names as time_s, workingstep, line, x_mm, feed_mm_min, lag_mm in the first row",
          .hint = "name each column, in order, with --column"};
}

/// A note on columns that say nothing that is known, as "lag_mm" misspelt does.
void tell_unknown(const std::vector<std::string>& names, const std::string& file, std::uint64_t line,
                  Job& job) {
  if (names.empty()) return;
  constexpr std::size_t kNamed = 10;
  std::string text;
  for (std::size_t i = 0; i < std::min(kNamed, names.size()); ++i) {
    text += (i == 0 ? "'" : ", '") + names[i].substr(0, 40) + "'";
    const auto near = nearest_names(names[i], known_columns(), 1);
    if (!near.empty()) text += " (is it '" + near.front() + "'?)";
  }
  if (names.size() > kNamed) text += " and " + std::to_string(names.size() - kNamed) + " more";
  Diagnostic d = wrong_columns(file, line,
                               counted(names.size(), "column says", "columns say") +
                                   " nothing that is known, or in a unit of another kind, and " +
                                   (names.size() == 1 ? "is" : "are") + " passed over: " + text);
  d.severity = Severity::kNote;
  job.report(std::move(d));
}

Result<Columns> columns_of(const std::vector<std::string>& names, const LogUnits& units,
                           const std::string& file, std::uint64_t line, Job& job) {
  Columns out;
  std::vector<std::string> unknown;
  std::array<bool, index_of(Item::kTime) + 1> seen = {};
  for (const std::string& name : names) {
    const auto column = column_of(name, units);
    if (column && seen[index_of(column->item)]) {
      return fail(
          wrong_columns(file, line, "the column '" + name.substr(0, 40) + "' says what another does"));
    }
    if (column) seen[index_of(column->item)] = true;
    if (!column && !name.empty()) unknown.push_back(name);
    out.of.push_back(column);
  }
  if (!seen[index_of(Item::kTime)]) return fail(wrong_columns(file, line, "no column is the time"));
  tell_unknown(unknown, file, line, job);
  return out;
}

std::optional<std::string> read_row(const Columns& columns, const std::vector<std::string_view>& cells,
                                    bool& dated, Reading& r) {
  if (cells.size() != columns.of.size()) {
    return fmt::format("{} instead of {}", counted(cells.size(), "cell", "cells"), columns.of.size());
  }
  bool timed = false;
  for (std::size_t i = 0; i < cells.size(); ++i) {
    if (!columns.of[i]) continue;
    if (columns.of[i]->item == Item::kTime) {
      if (const auto date = seconds_of(cells[i])) {
        r.t_s = *date;
        dated = timed = true;
        continue;
      }
      timed = !cells[i].empty();
    }
    if (auto wrong = put(r, *columns.of[i], cells[i])) return wrong;
  }
  if (!timed) return "there is no time in it";
  return std::nullopt;
}

char separator_in(std::string_view line) {
  const char found = separator_of(line);
  return found == '\0' ? ' ' : found;
}

std::vector<std::string> texts(const std::vector<std::string_view>& cells) {
  return {cells.begin(), cells.end()};
}

// Reads the rows. `columns`: nothing, and the first row names them.
Result<LogEnd> read_rows(std::istream& in, const std::string& file, const LogUnits& units,
                         std::optional<Columns> columns, const Sink& sink, Job& job) {
  Lines lines(in, file);
  LostLines lost;
  LogEnd out;
  Clock clock;
  while (const auto line = lines.next()) {
    const std::string_view text = without_blanks(*line);
    if (text.empty() || text.starts_with('#') || text == "overrun") continue;
    if (!columns) {
      const char separator = separator_in(text);
      auto named = columns_of(texts(cells_of(text, separator)), units, file, lines.number(), job);
      if (!named) return tl::unexpected(named.error());
      columns = *std::move(named);
      columns->separator = separator;
      continue;
    }
    if (columns->separator == '\0') columns->separator = separator_in(text);
    Reading r{.line = lines.number()};
    const auto cells = cells_of(text, columns->separator);
    if (columns->least != 0 && cells.size() >= columns->least && cells.size() < columns->of.size())
      columns->of.resize(cells.size());
    columns->least = 0;
    auto wrong = read_row(*columns, cells, out.dated, r);
    if (!wrong) {
      r.t_s *= columns->time_factor;
      wrong = clock.step(r.t_s);
    }
    if (wrong) {
      lost.lose(lines.number(), *std::move(wrong));
      continue;
    }
    ++out.readings;
    out.says_running = out.says_running || r.running.has_value();
    sink(r);
  }
  const std::string expected =
      columns ? counted(columns->of.size(), "cell", "cells") + " of numbers and names" : "a row of names";
  return ended(lines, lost, out, expected, job);
}

}  // namespace

Result<LogEnd> read_table(std::istream& in, const std::string& file, const LogUnits& units,
                          std::span<const std::string> columns, const Sink& sink, Job& job) {
  std::optional<Columns> known;
  if (!columns.empty()) {
    auto named = columns_of({columns.begin(), columns.end()}, units, file, 0, job);
    if (!named) return tl::unexpected(named.error());
    known = *std::move(named);
  }
  return read_rows(in, file, units, std::move(known), sink, job);
}

Result<LogEnd> read_linuxcnc(std::istream& in, const std::string& file, const LogUnits& units,
                             std::span<const std::string> columns, double period_s, const Sink& sink,
                             Job& job) {
  constexpr const char *kMark = "", *kKind = "";  // say nothing of a cut, and no name is there to be mended
  std::vector<std::string> names = {"time"};
  if (columns.empty()) {
    names.insert(names.end(), {"x", "y", "z", "motion.current-vel", "motion.program-line", "spindle_rpm",
                               "tool", kMark, "lag", kKind});
  } else {
    names.insert(names.end(), columns.begin(), columns.end());
  }
  LogUnits own = units;
  own.mm_min = 60.0 * units.mm;  // HAL's velocities are per second
  auto known = columns_of(names, own, file, 0, job);
  if (!known) return tl::unexpected(known.error());
  constexpr std::size_t kLeast = 6;  // up to the line of the program
  if (columns.empty()) known->least = kLeast;
  known->separator = ' ';
  known->time_factor = period_s;
  return read_rows(in, file, own, *std::move(known), sink, job);
}

}  // namespace capstan::casebase::retain

#include "casebase/retain/inspection.h"

#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <map>
#include <optional>
#include <span>

#include "casebase/record/fields.h"
#include "casebase/retain/cells.h"
#include "casebase/retain/lines.h"
#include "planner/ground/base/no_number.h"
#include "planner/ground/base/number.h"
#include "planner/ground/base/tables/separated.h"
#include "planner/ground/vocabulary/unit_factors.h"

namespace capstan::casebase::retain {
namespace {

constexpr double kLengthMax = 1e5, kTimeMax = 1e7,
                 kPathMax = 1e9;  // against wrong units; defaults, unsourced

// A column by any of its names, with the units that a name may end in.
struct Suffix {
  std::string_view text;
  double factor;
};
constexpr double kMmPerUm = 1e-3;
constexpr std::array kLengths = {Suffix{"_mm", 1.0}, Suffix{"_in", kMmPerInch}, Suffix{"_um", kMmPerUm}};
constexpr std::array kTimes = {Suffix{"_s", 1.0}, Suffix{"_min", 60.0}, Suffix{"_h", 3600.0}};
constexpr std::array kFeeds = {Suffix{"_ipm", kMmPerInch}, Suffix{"_in_min", kMmPerInch},
                               Suffix{"_mm_min", 1.0}, Suffix{"_mm_s", 60.0}};

struct Found {
  std::size_t at = 0;
  double factor = 0.0;  // 0: the name says no unit
};

std::string lower(std::string_view text) {
  std::string out(without_blanks(text));
  for (char& c : out) {
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  }
  return out;
}

std::optional<Found> find(const std::vector<std::string>& head, std::span<const std::string_view> names,
                          std::span<const Suffix> suffixes) {
  for (std::size_t i = 0; i < head.size(); ++i) {
    const std::string cell = lower(head[i]);
    for (const std::string_view name : names) {
      if (cell == name) return Found{i, 0.0};
      for (const Suffix& s : suffixes) {
        if (cell == std::string(name) + std::string(s.text)) return Found{i, s.factor};
      }
    }
  }
  return std::nullopt;
}

using Names = std::span<const std::string_view>;
constexpr std::array<std::string_view, 4> kPart = {"part", "part_index", "part_number", "serial"};

Diagnostic no_column(const std::string& file, std::uint64_t line, const std::string& expected) {
  return {.code = "LOG-COLUMNS",
          .message = "a column is missing",
          .file = file,
          .line = line,
          .expected = expected,
          .hint = "the first row names the columns"};
}

// Reads rows by a function that says what is wrong with one.
template <class Row>
Result<std::vector<Row>> rows_of(
    const std::vector<SeparatedRow>& rows, const std::string& file, const std::string& expected, Job& job,
    const std::function<std::optional<std::string>(const std::vector<std::string>&, Row&)>& read) {
  std::vector<Row> out;
  LostLines lost;
  const std::size_t width = rows.front().cells.size();
  for (std::size_t i = 1; i < rows.size(); ++i) {
    Row row;
    row.line = rows[i].line;
    std::optional<std::string> wrong;
    if (rows[i].cells.size() != width) {
      wrong = counted(rows[i].cells.size(), "cell", "cells") + " instead of " + std::to_string(width);
    } else {
      wrong = read(rows[i].cells, row);
    }
    if (wrong) {
      lost.lose(rows[i].line, *std::move(wrong));
    } else {
      out.push_back(std::move(row));
    }
  }
  if (auto ok = lost.end(file, rows.size() - 1, expected, job); !ok) return tl::unexpected(ok.error());
  if (out.empty()) {
    return fail(Diagnostic{
        .code = "LOG-EMPTY", .message = "there is no row in it", .file = file, .expected = expected});
  }
  return out;
}

// A number within limits; nothing when the cell is empty. `wrong` is set when it is no number.
std::optional<double> number(const std::vector<std::string>& cells, const std::optional<Found>& column,
                             double factor, double most, std::optional<std::string>& wrong) {
  if (!column) return std::nullopt;
  const std::string_view cell = without_blanks(cells[column->at]);
  if (cell.empty()) return std::nullopt;
  const auto v = parse_double(cell);
  if (!v) {
    wrong = no_number(std::string(cell.substr(0, 40)));
    return std::nullopt;
  }
  const double value = *v * (column->factor > 0.0 ? column->factor : factor);
  if (std::abs(value) > most) {
    wrong = shortest(*v) + " is out of range";
    return std::nullopt;
  }
  return value;
}

Result<std::vector<SeparatedRow>> table_of(std::string_view text, const std::string& file,
                                           const std::string& expected) {
  const char separator = separator_of(text);
  auto rows = separated_rows(text, separator == '\0' ? ',' : separator, file, "LOG-TEXT", StrayQuotes::kKept);
  if (rows && rows->empty()) {
    return fail(Diagnostic{
        .code = "LOG-EMPTY", .message = "there is nothing in it", .file = file, .expected = expected});
  }
  return rows;
}

// mm of one unit of a word; nothing for a word that is no unit of length.
std::optional<double> length_unit(std::string_view word) {
  struct Unit {
    std::string_view word;
    double mm;
  };
  // The micro sign, and the small letter mu.
  constexpr std::array kUnits = {Unit{"mm", 1.0},
                                 Unit{"in", kMmPerInch},
                                 Unit{"inch", kMmPerInch},
                                 Unit{"um", kMmPerUm},
                                 Unit{"micron", kMmPerUm},
                                 Unit{"\xC2\xB5m", kMmPerUm},
                                 Unit{"\xCE\xBCm", kMmPerUm},
                                 Unit{"uin", 1e-6 * kMmPerInch}};
  for (const Unit& u : kUnits) {
    if (u.word == word) return u.mm;
  }
  return std::nullopt;
}

// What a row is about, by its type or by the remark at the end of its characteristic.
void say_what_is_measured(Inspected& row) {
  struct Word {
    std::string_view word;
    Measures kind;
    StatedSize stated = StatedSize::kUnsaid;
  };
  constexpr std::array kKinds = {Word{"diameter", Measures::kSize, StatedSize::kDiameter},
                                 Word{"dia", Measures::kSize, StatedSize::kDiameter},
                                 Word{"width", Measures::kSize, StatedSize::kWidth},
                                 Word{"length", Measures::kSize, StatedSize::kUnstated},
                                 Word{"size", Measures::kSize},
                                 Word{"depth", Measures::kDepth},
                                 Word{"height", Measures::kDepth, StatedSize::kUnstated},
                                 Word{"position", Measures::kPlace},
                                 Word{"true position", Measures::kPlace},
                                 Word{"ra", Measures::kRoughness},
                                 Word{"roughness", Measures::kRoughness},
                                 Word{"roughness ra", Measures::kRoughness},
                                 Word{"surface roughness", Measures::kRoughness}};
  const auto slash = row.characteristic.rfind('/');
  const std::string word = !row.type.empty()            ? lower(row.type)
                           : slash == std::string::npos ? std::string()
                                                        : lower(row.characteristic.substr(slash + 1));
  row.kind = row.type.empty() ? Measures::kSize : Measures::kOther;
  for (const Word& k : kKinds) {
    if (k.word != word) continue;
    row.kind = k.kind;
    row.stated = k.stated;
    return;
  }
}

// Why a deviation cannot be one of a case: beyond the limits of the field that keeps it.
std::optional<std::string> beyond(std::string_view field, double value, const std::string& text) {
  const Field& f = field_named(field);
  if (value >= f.low && value <= f.high) return std::nullopt;
  return text + " is out of range: " + shortest(f.low) + " to " + shortest(f.high) + " " +
         std::string(f.unit);
}
std::optional<std::string> beyond_what_is_kept(const Inspected& row) {
  const double off = row.has_nominal ? row.value_mm - row.nominal_mm : row.value_mm;
  const std::string text = "a deviation of " + shortest(off) + " mm";
  switch (row.kind) {
    case Measures::kRoughness:
      return beyond("surface_ra_um", row.ra_um, "a roughness of " + shortest(row.ra_um) + " um");
    case Measures::kPlace:
      return beyond("position_deviation_mm", row.has_nominal ? std::abs(off) : off, text);
    case Measures::kSize:
      return row.has_nominal ? beyond("size_deviation_mm", off, text) : std::nullopt;
    case Measures::kDepth:
      return row.has_nominal ? beyond("depth_deviation_mm", off, text) : std::nullopt;
    case Measures::kOther:
      break;
  }
  return std::nullopt;
}

}  // namespace

Result<std::vector<Inspected>> read_inspection(std::string_view text, const std::string& file, double unit_mm,
                                               Job& job) {
  constexpr std::array<std::string_view, 3> kCharacteristic = {"designator", "characteristic", "feature"};
  constexpr std::array<std::string_view, 1> kType = {"type"}, kNominal = {"nominal"}, kUnit = {"unit"};
  constexpr std::array<std::string_view, 3> kUpper = {"tol_plus", "upper", "upper_tolerance"},
                                            kLower = {"tol_minus", "lower", "lower_tolerance"},
                                            kValue = {"value", "actual", "measured"};
  const std::string expected =
      "columns part, characteristic and value; type, nominal, tol_plus, tol_minus, unit";
  const auto rows = table_of(text, file, expected);
  if (!rows) return tl::unexpected(rows.error());
  const auto& head = rows->front().cells;
  const auto part = find(head, kPart, {}), name = find(head, kCharacteristic, {}),
             value = find(head, kValue, kLengths), type = find(head, kType, {}),
             nominal = find(head, kNominal, kLengths), upper = find(head, kUpper, kLengths),
             low = find(head, kLower, kLengths), unit = find(head, kUnit, {});
  if (!part || !name || !value) return fail(no_column(file, rows->front().line, expected));
  return rows_of<Inspected>(
      *rows, file, expected, job,
      [&](const std::vector<std::string>& cells, Inspected& row) -> std::optional<std::string> {
        row.part = without_blanks(cells[part->at]);
        row.characteristic = without_blanks(cells[name->at]);
        if (type) row.type = without_blanks(cells[type->at]);
        if (row.part.empty() || row.characteristic.empty()) return "part or characteristic is empty";
        say_what_is_measured(row);
        const bool roughness = row.kind == Measures::kRoughness, other = row.kind == Measures::kOther;
        double factor = roughness ? kMmPerUm : unit_mm;
        bool said = false;  // by the row's own cell, which goes before the columns' names
        if (unit) {
          const std::string word = lower(cells[unit->at]);
          const auto mm = length_unit(word);
          if (!mm && !word.empty() && !other) {
            return "the unit '" + word.substr(0, 20) + "' is none of mm, in, um and uin";
          }
          said = !word.empty();
          factor = mm.value_or(factor);
        }
        std::optional<std::string> wrong;
        const auto length = [&](std::optional<Found> column) {
          if (column && said) column->factor = 0.0;
          return number(cells, column, factor, kLengthMax, wrong);
        };
        const auto v = length(value), n = length(nominal), u = length(upper), l = length(low);
        if (other) {
          // In whatever unit, one for the whole row: only whether it is beyond a limit is asked of it.
          constexpr double kNone = std::numeric_limits<double>::infinity();
          row.value_mm = v.value_or(0.0);
          row.has_nominal = n.has_value();
          row.nominal_mm = n.value_or(0.0);
          row.upper_mm = u.value_or(kNone);
          row.lower_mm = l.value_or(-kNone);
          row.toleranced = !wrong && v && (u || l) && row.lower_mm <= row.upper_mm;
          return std::nullopt;
        }
        if (wrong) return wrong;
        if (!v) return "there is no value";
        if (roughness) {
          row.ra_um = *v / kMmPerUm;
          if (n || u) row.ra_most = (n.value_or(0.0) + u.value_or(0.0)) / kMmPerUm;
          return beyond_what_is_kept(row);
        }
        row.value_mm = *v;
        row.has_nominal = n.has_value();
        row.nominal_mm = n.value_or(0.0);
        row.toleranced = u && (l || row.kind == Measures::kPlace);
        row.upper_mm = u.value_or(0.0);
        row.lower_mm = l.value_or(row.kind == Measures::kPlace ? -row.upper_mm : 0.0);
        if (row.toleranced && row.lower_mm > row.upper_mm) return "the lower limit is above the upper one";
        return beyond_what_is_kept(row);
      });
}

Result<std::vector<Timed>> read_times(std::string_view text, const std::string& file, Job& job) {
  constexpr std::array<std::string_view, 3> kTool = {"tool", "tool_number", "t"};
  constexpr std::array<std::string_view, 1> kStep = {"workingstep"};
  constexpr std::array<std::string_view, 2> kActive = {"executed_active_s", "active_s"},
                                            kMoving = {"executed_feeding_s", "moving_s"},
                                            kSpeed = {"spindle_rpm", "rpm"}, kFeed = {"main_feed", "feed"},
                                            kPath = {"feed_length", "path"},
                                            kBlocks = {"feed_blocks", "blocks"};
  const std::string expected = "columns part, tool or workingstep, executed_active_s or executed_feeding_s";
  const auto rows = table_of(text, file, expected);
  if (!rows) return tl::unexpected(rows.error());
  const auto& head = rows->front().cells;
  const auto part = find(head, kPart, {}), tool = find(head, kTool, {}), step = find(head, kStep, {}),
             active = find(head, kActive, {}), moving = find(head, kMoving, {}),
             speed = find(head, kSpeed, {}), feed = find(head, kFeed, kFeeds),
             path = find(head, kPath, kLengths), blocks = find(head, kBlocks, {});
  if (!part || (!tool && !step) || (!active && !moving)) {
    return fail(no_column(file, rows->front().line, expected));
  }
  for (const auto* column : {&feed, &path}) {
    if (*column && (*column)->factor <= 0.0) {
      return fail(Diagnostic{.code = "LOG-COLUMNS",
                             .message = "the unit of '" + head[(*column)->at].substr(0, 40) + "' is not said",
                             .file = file,
                             .line = rows->front().line,
                             .expected = "a name that ends in _mm, _in, _mm_min or _ipm"});
    }
  }
  return rows_of<Timed>(*rows, file, expected, job,
                        [&](const std::vector<std::string>& cells, Timed& row) -> std::optional<std::string> {
                          row.part = without_blanks(cells[part->at]);
                          if (row.part.empty()) return "the part is empty";
                          if (step) row.workingstep = without_blanks(cells[step->at]);
                          std::optional<std::string> wrong;
                          const double number_of_tool = number(cells, tool, 1.0, 1e6, wrong).value_or(0.0);
                          const double count = number(cells, blocks, 1.0, 1e9, wrong).value_or(0.0);
                          row.spindle_rpm = number(cells, speed, 1.0, 1e6, wrong).value_or(0.0);
                          row.feed_mm_min = number(cells, feed, 1.0, 1e6, wrong).value_or(0.0);
                          row.path_mm = number(cells, path, 1.0, kPathMax, wrong).value_or(0.0);
                          const auto all = number(cells, active, 1.0, kTimeMax, wrong);
                          const auto moved = number(cells, moving, 1.0, kTimeMax, wrong);
                          if (wrong) return wrong;
                          if (!all && !moved) return "there is no time";
                          row.tool = static_cast<int>(number_of_tool);
                          row.blocks = static_cast<int>(count);
                          row.active_s = all.value_or(0.0);
                          row.moving_s = moved.value_or(0.0);
                          const bool negative = row.active_s < 0.0 || row.moving_s < 0.0 ||
                                                row.path_mm < 0.0 || row.feed_mm_min < 0.0 ||
                                                number_of_tool < 0.0 || count < 0.0;
                          if (negative) return "a number is negative";
                          if (all && moved && row.moving_s > row.active_s + 0.01)
                            return "it moved for longer than it was active";
                          return std::nullopt;
                        });
}

Result<std::vector<Worn>> read_wear(std::string_view text, const std::string& file, double unit_mm,
                                    Job& job) {
  constexpr std::array<std::string_view, 6> kTest = {"part",   "part_index", "part_number",
                                                     "serial", "case",       "test"};
  constexpr std::array<std::string_view, 4> kEdge = {"edge", "tool_edge", "tool_serial", "insert"};
  constexpr std::array<std::string_view, 1> kStep = {"workingstep"};
  constexpr std::array<std::string_view, 3> kTool = {"tool", "tool_number", "t"};
  constexpr std::array<std::string_view, 2> kTime = {"time", "cutting_time"},
                                            kFeed = {"feed", "feed_per_turn"},
                                            kSpeed = {"spindle_rpm", "rpm"};
  constexpr std::array<std::string_view, 3> kWear = {"vb", "wear", "flank_wear"},
                                            kDepth = {"depth", "doc", "ap"};
  const std::string expected = "columns part or edge, time, and vb or wear; feed, depth, rpm, workingstep";
  const auto rows = table_of(text, file, expected);
  if (!rows) return tl::unexpected(rows.error());
  const auto& head = rows->front().cells;
  const auto part = find(head, kTest, {}), edge = find(head, kEdge, {}), step = find(head, kStep, {}),
             tool = find(head, kTool, {}), time = find(head, kTime, kTimes),
             wear = find(head, kWear, kLengths), feed = find(head, kFeed, kLengths),
             depth = find(head, kDepth, kLengths), speed = find(head, kSpeed, {});
  if ((!part && !edge) || !time || !wear) return fail(no_column(file, rows->front().line, expected));
  std::map<std::pair<std::string, std::string>, double> last;  // by part and edge, s
  return rows_of<Worn>(
      *rows, file, expected, job,
      [&](const std::vector<std::string>& cells, Worn& row) -> std::optional<std::string> {
        if (part) row.part = without_blanks(cells[part->at]);
        if (edge) row.edge = without_blanks(cells[edge->at]);
        if (row.part.empty() && row.edge.empty()) return "it names neither part nor edge";
        if (step) row.workingstep = without_blanks(cells[step->at]);
        std::optional<std::string> wrong;
        const double number_of_tool = number(cells, tool, 1.0, 1e6, wrong).value_or(0.0);
        const auto t = number(cells, time, 60.0, kTimeMax, wrong);
        row.wear_mm = number(cells, wear, unit_mm, kLengthMax, wrong);
        row.feed_per_turn_mm = number(cells, feed, unit_mm, kLengthMax, wrong).value_or(0.0);
        row.depth_mm = number(cells, depth, unit_mm, kLengthMax, wrong).value_or(0.0);
        row.rpm = number(cells, speed, 1.0, 1e6, wrong).value_or(0.0);
        if (wrong) return wrong;
        if (!t) return "there is no time";
        if (*t < 0.0 || number_of_tool < 0.0 || row.feed_per_turn_mm < 0.0 || row.depth_mm < 0.0 ||
            row.rpm < 0.0)
          return "a number is negative";
        if (row.wear_mm) {
          if (auto far =
                  beyond("wear_series_mm", *row.wear_mm, "a wear of " + shortest(*row.wear_mm) + " mm"))
            return far;
        }
        row.time_s = *t;
        row.tool = static_cast<int>(number_of_tool);
        // An edge keeps its clock from part to part; a part without a named edge has one of its own.
        const auto clock =
            row.edge.empty() ? std::pair(row.part, std::string()) : std::pair(std::string(), row.edge);
        const auto [at, fresh] = last.emplace(clock, *t);
        if (!fresh && *t <= at->second)
          return "the time goes back, from " + shortest(at->second) + " to " + shortest(*t) + " s";
        at->second = *t;
        return std::nullopt;
      });
}

}  // namespace capstan::casebase::retain

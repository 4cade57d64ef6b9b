#include "casebase/store/version_1.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>

#include "casebase/record/encoding.h"
#include "casebase/record/sha256.h"
#include "casebase/store/row.h"
#include "planner/ground/base/file.h"

namespace capstan::casebase {
namespace {

constexpr std::array<std::string_view, 7> kTexts = {
    "operation", "material_group", "tool_class", "machine_class", "verdict", "provenance", "source"};
constexpr std::array<std::string_view, 14> kNumbers = {
    "diameter_mm", "depth_mm", "width_mm", "tolerance_mm", "cutting_diameter_mm", "vc_m_min",     "fz_mm",
    "ap_mm",       "ae_mm",    "cycle_s",  "peak_force_n", "surface_ra_um",       "deviation_mm", "wear_mm"};
constexpr std::array<std::string_view, 2> kIntegers = {"teeth", "coolant"};

std::string columns(std::string_view text, std::string_view real, std::string_view integer) {
  std::string out;
  const auto put = [&](std::string_view name, std::string_view form) {
    out += ", ";
    out += fmt::format(fmt::runtime(form), name);
  };
  for (const auto name : kTexts) put(name, text);
  for (const auto name : kNumbers) put(name, real);
  for (const auto name : kIntegers) put(name, integer);
  return out;
}

std::string_view name_of(OldCell::Type type) {
  switch (type) {
    case OldCell::Type::kText:
      return "text";
    case OldCell::Type::kReal:
      return "a number";
    case OldCell::Type::kInteger:
      return "an integer";
    default:
      return "neither";
  }
}

/// The id of version 1: of all columns.
std::string old_id(std::span<const OldCell> cells) {
  std::string text = "capstan case 1\n";
  const auto put = [&](std::string_view name, std::string_view v) {
    text += name;
    text += ' ' + std::to_string(v.size()) + ' ';
    text += v;
    text += '\n';
  };
  std::size_t at = 1;
  for (const auto name : kTexts) put(name, cells[at++].text);
  for (const auto name : kNumbers) put(name, hex64(std::bit_cast<std::uint64_t>(cells[at++].real + 0.0)));
  for (const auto name : kIntegers) put(name, std::to_string(cells[at++].integer));
  return sha256(text).substr(0, 32);
}

/// Why the cells are no row of version 1 that was not altered.
std::optional<std::string> fault_of_cells(std::span<const OldCell> cells) {
  if (cells.size() != 1 + kTexts.size() + kNumbers.size() + kIntegers.size()) return "it has other columns";
  std::size_t at = 0;
  const auto typed = [&](std::string_view name, OldCell::Type type) -> std::optional<std::string> {
    const OldCell& cell = cells[at++];
    if (cell.type == type) return std::nullopt;
    return fmt::format("{} is {}", name, name_of(cell.type));
  };
  if (auto wrong = typed("id", OldCell::Type::kText)) return wrong;
  for (const auto name : kTexts) {
    if (auto wrong = typed(name, OldCell::Type::kText)) return wrong;
  }
  for (const auto name : kNumbers) {
    if (auto wrong = typed(name, OldCell::Type::kReal)) return wrong;
  }
  for (const auto name : kIntegers) {
    if (auto wrong = typed(name, OldCell::Type::kInteger)) return wrong;
  }
  if (old_id(cells) != cells[0].text) return "its hash does not fit what it holds: it was altered";
  return std::nullopt;
}

/// The same case in version 2. Zero was what version 1 had for a result that is not known.
std::optional<Case> case_of_cells(std::span<const OldCell> cells) {
  const auto text = [&](std::size_t i) { return cells[1 + i].text; };
  const auto number = [&](std::size_t i) { return cells[1 + kTexts.size() + i].real; };
  const auto integer = [&](std::size_t i) { return cells[1 + kTexts.size() + kNumbers.size() + i].integer; };
  Case c;
  c.asked = {
      .operation = text(0), .material_group = text(1), .tool_class = text(2), .machine_class = text(3)};
  const auto verdict = verdict_of(text(4));
  const auto origin = origin_of(text(5));
  if (!verdict || !origin) return std::nullopt;
  c.observed.verdict = *verdict;
  c.origin = *origin;
  c.from.source = text(6);
  c.asked.diameter_mm = number(0);
  c.asked.depth_mm = number(1);
  c.asked.width_mm = number(2);
  c.asked.tolerance_mm = number(3);
  c.asked.cutter_diameter_mm = number(4);
  c.asked.teeth = static_cast<int>(std::clamp<std::int64_t>(integer(0), -1, 1'000'000));
  c.asked.coolant = integer(1) != 0 ? Coolant::kFlood : Coolant::kDry;
  c.bound.vc_m_min = number(5);
  c.bound.fz_mm = number(6);
  c.bound.ap_mm = number(7);
  c.bound.ae_mm = number(8);
  std::size_t at = 9;
  for (std::optional<Figure>* figure :
       {&c.observed.time_s, &c.observed.peak_force_n, &c.observed.surface_ra_um,
        &c.observed.size_deviation_mm, &c.observed.wear_mm}) {
    const double v = number(at++);
    if (v != 0.0) *figure = Figure{v, 0.0, c.origin};
  }
  return c;
}

}  // namespace

std::string old_case_table() {
  return "CREATE TABLE capstan_case(id TEXT PRIMARY KEY NOT NULL" +
         columns("{} TEXT NOT NULL", "{} REAL NOT NULL", "{} INTEGER NOT NULL") + ") STRICT, WITHOUT ROWID";
}
std::string old_total_table() {
  return "CREATE TABLE capstan_total(one INTEGER PRIMARY KEY CHECK(one = 1), count INTEGER NOT NULL, "
         "ids TEXT NOT NULL) STRICT";
}
std::string old_select() { return "SELECT id" + columns("{}", "{}", "{}") + " FROM capstan_case"; }

void OldReader::append(RowKind kind, const Case& c, std::string body) {
  Head head;
  head.kind = kind;
  head.id = *id_of_digits(c.id);
  head.body = sum_of(body);
  head.verdict = c.observed.verdict;
  head.origin = c.origin;
  const std::string categories = categories_of(c.asked);
  head.categories = categories;
  head.key = key_of(c.asked);
  const auto number = static_cast<std::int64_t>(out_.rows.size() + 1);
  out_.rows.push_back({number, bytes_of(head, number), std::move(body)});
  out_.totals.count(out_.rows.back().head);
}

void OldReader::keep(Case c) {
  c.id = id_of(c);
  const auto [at, fresh] = kept_.emplace(*id_of_digits(c.id), c.observed.verdict);
  if (fresh) {
    append(RowKind::kCase, c, encoded(c));
  } else if (c.observed.verdict == Verdict::kBad && at->second != Verdict::kBad) {
    // Version 1 could hold one cut with two verdicts: the worse one counts.
    at->second = Verdict::kBad;
    append(RowKind::kJudgement, c, bytes_of(Remark{c.from.source, "", "a second verdict of version 1"}));
  }
}

void OldReader::row(std::span<const OldCell> cells, Job& job) {
  ++read_;
  std::optional<std::string> wrong = fault_of_cells(cells);
  std::optional<Case> c;
  if (!wrong) {
    c = case_of_cells(cells);
    wrong = c ? fault_of(*c) : "a word of it is unknown";
  }
  if (!wrong && !last_id_.empty() && last_id_ >= cells[0].text) wrong = "it is not in order, or there twice";
  if (!wrong) {
    last_id_ = cells[0].text;
    ++trusted_;
    const Id id = *id_of_digits(last_id_);
    ids_.high ^= id.high;
    ids_.low ^= id.low;
    keep(*std::move(c));
  } else if (++refused_ <= kReportedRows) {
    job.report(Diagnostic{.code = "CASE-ROW",
                          .severity = Severity::kWarning,
                          .message = fmt::format("case {} is left out: {}", read_, *wrong),
                          .file = file_});
  }
}

OldRows OldReader::end(Job& job) {
  const bool as_stated =
      out_.stated.count == static_cast<std::int64_t>(trusted_) && out_.stated.ids == digits_of(ids_);
  out_.damaged = refused_ != 0 || !as_stated;
  if (!as_stated) {
    job.report(Diagnostic{.code = "CASE-ROW",
                          .severity = Severity::kWarning,
                          .message = fmt::format("it should hold {} cases, and {} of them can be trusted",
                                                 out_.stated.count, trusted_),
                          .file = file_,
                          .hint = "restore the file from a copy; nothing is added to this one"});
  }
  return std::move(out_);
}

}  // namespace capstan::casebase

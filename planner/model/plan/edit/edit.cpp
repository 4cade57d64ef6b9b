#include "planner/model/plan/edit/edit.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "planner/ground/base/nearest_names.h"
#include "planner/ground/base/number.h"

namespace capstan::model {
namespace {

constexpr std::string_view kBlanks = " \t\r\n";
constexpr double kMostNumber = 1e6;  // mm, mm/min, 1/min: beyond what any machine has

constexpr unsigned bit(EditKind k) { return 1U << static_cast<unsigned>(k); }
constexpr unsigned kChosen = bit(EditKind::kSet) | bit(EditKind::kPin);

/// One attribute, and the kinds of edits that take it.
struct Row {
  EditOf of;
  std::string_view name, unit;
  unsigned kinds;
  bool number;    ///< else a name
  bool at_least;  ///< a limit may bound it from below
};
constexpr std::array kRows = {
    Row{EditOf::kTool, "tool", "", kChosen | bit(EditKind::kForbid), false, false},
    Row{EditOf::kFeed, "feed", "mm/min", kChosen | bit(EditKind::kLimit), true, false},
    Row{EditOf::kSpeed, "speed", "1/min", kChosen | bit(EditKind::kLimit), true, false},
    // No limit: entries go down past the levels, which alone would keep to it.
    Row{EditOf::kDepth, "depth", "mm", kChosen, true, false},
    Row{EditOf::kToolDiameter, "tool.diameter", "mm", bit(EditKind::kLimit), true, true},
    Row{EditOf::kToolStickOut, "tool.stick_out", "mm", bit(EditKind::kLimit), true, true},
    Row{EditOf::kToolTeeth, "tool.teeth", "", bit(EditKind::kLimit), true, true},
    Row{EditOf::kOperation, "operation", "", bit(EditKind::kForbid), false, false},
    Row{EditOf::kStrategy, "strategy", "", bit(EditKind::kForbid), false, false},
};

const Row& row_of(EditOf of) {
  return *std::find_if(kRows.begin(), kRows.end(), [&](const Row& r) { return r.of == of; });
}

std::string_view trimmed_text(std::string_view text) {
  const auto first = text.find_first_not_of(kBlanks);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(kBlanks) - first + 1);
}

std::string quoted(std::string_view text) { return "'" + std::string(text) + "'"; }

auto no_edit(EditKind kind, std::string_view text, std::string what) {
  static constexpr std::array kForms = {
      "[PATTERN/]tool=T5, or feed, speed or depth with a number", "[PATTERN/]tool, feed, speed or depth",
      "[PATTERN/]feed<=2000, or speed, tool.diameter, tool.stick_out, tool.teeth",
      "[PATTERN/]tool=NAME, operation=KIND or strategy=KIND", "PATTERN<PATTERN, features or workingsteps"};
  return fail({.code = "EDIT-SYNTAX",
               .message = quoted(text) + " is no " + std::string(to_text(kind)) + ": " + std::move(what),
               .expected = kForms.at(static_cast<std::size_t>(kind))});
}

/// The pattern and the attribute of the part before the sign.
Result<const Row*> take_attribute(EditKind kind, std::string_view left, Edit& into) {
  const auto slash = left.rfind('/');
  std::string_view name = left;
  if (slash != std::string_view::npos) {
    into.where = trimmed_text(left.substr(0, slash));
    name = trimmed_text(left.substr(slash + 1));
    if (into.where.empty()) return no_edit(kind, left, "nothing stands before the '/'");
  }
  std::vector<std::string> known;
  for (const Row& r : kRows) {
    if ((r.kinds & bit(kind)) == 0) continue;
    if (r.name == name) return &r;
    known.emplace_back(r.name);
  }
  Diagnostic d = unknown_name(std::string(to_text(kind)) + " of", name, known, "capstan plan --help");
  d.expected.clear();
  for (const std::string& k : known) d.expected += (d.expected.empty() ? "" : ", ") + k;
  return fail(std::move(d));
}

Status take_value(const Row& row, std::string_view text, Edit& into) {
  if (text.empty()) return no_edit(into.kind, text, "it has no value");
  into.of = row.of;
  into.value = text;
  if (!row.number) return {};
  const auto v = parse_double(text);
  if (!v || !(*v > 0.0) || *v > kMostNumber)
    return no_edit(into.kind, text,
                   std::string(row.name) + " wants a number above 0 and up to " + trimmed(kMostNumber, 0) +
                       (row.unit.empty() ? "" : " " + std::string(row.unit)) + ", decimals with a point");
  into.number = *v;
  return {};
}

Result<Edit> parse_order(std::string_view text, Edit out) {
  const auto sign = text.find('<');
  if (sign == std::string_view::npos) return no_edit(out.kind, text, "it has no '<'");
  out.where = trimmed_text(text.substr(0, sign));
  out.before = trimmed_text(text.substr(sign + 1));
  if (out.where.empty() || out.before.empty()) return no_edit(out.kind, text, "one side of the '<' is empty");
  if (out.before.find('<') != std::string::npos) return no_edit(out.kind, text, "it has more than one '<'");
  return out;
}

}  // namespace

std::string_view to_text(EditKind kind) {
  static constexpr std::array<std::string_view, 5> kWords = {"set", "pin", "limit", "forbid", "order"};
  return kWords.at(static_cast<std::size_t>(kind));
}

std::string_view word_of(EditOf of) { return row_of(of).name; }
std::string_view unit_of(EditOf of) { return row_of(of).unit; }

Result<Edit> parse_edit(EditKind kind, std::string_view text, std::string from) {
  Edit out;
  out.kind = kind;
  out.from = std::move(from);
  text = trimmed_text(text);
  if (text.empty()) return no_edit(kind, text, "it is empty");
  if (text.size() > kLongestEdit)
    return no_edit(kind, text.substr(0, 40), "it is longer than " + std::to_string(kLongestEdit) + " bytes");
  if (std::any_of(text.begin(), text.end(), [](char c) { return static_cast<unsigned char>(c) < 0x20; }))
    return no_edit(kind, "", "it holds a control character");
  if (kind == EditKind::kOrder) return parse_order(text, std::move(out));
  const bool limit = kind == EditKind::kLimit;
  std::size_t sign = text.find(limit ? "<=" : "="), end = sign + (limit ? 2 : 1);
  if (limit && sign == std::string_view::npos) {
    sign = text.find(">=");
    end = sign + 2;
    out.at_least = true;
  }
  if (sign == std::string_view::npos) {
    if (kind != EditKind::kPin)
      return no_edit(kind, text, limit ? "it has neither '<=' nor '>='" : "it has no '='");
    const auto row = take_attribute(kind, text, out);
    if (!row) return tl::unexpected(row.error());
    out.of = (*row)->of;
    return out;
  }
  const auto row = take_attribute(kind, trimmed_text(text.substr(0, sign)), out);
  if (!row) return tl::unexpected(row.error());
  if (out.at_least && !(*row)->at_least)
    return no_edit(kind, text, std::string((*row)->name) + " is bounded from above only, by '<='");
  if (auto ok = take_value(**row, trimmed_text(text.substr(end)), out); !ok)
    return tl::unexpected(ok.error());
  return out;
}

std::string text_of(const Edit& e) {
  if (e.kind == EditKind::kOrder) return e.where + "<" + e.before;
  std::string out = (e.where == "*" ? "" : e.where + "/") + std::string(word_of(e.of));
  if (e.value.empty()) return out;
  return out + (e.kind == EditKind::kLimit ? e.at_least ? ">=" : "<=" : "=") + e.value;
}

std::string words_of(const Edit& e) {
  return e.from + (e.from.empty() ? "" : ": ") + std::string(to_text(e.kind)) + " " + text_of(e);
}

bool names(std::string_view pattern, std::string_view name) {
  std::size_t p = 0, n = 0, star = std::string_view::npos, mark = 0;
  while (n < name.size()) {
    if (p < pattern.size() && pattern[p] == '*') {
      star = p++;
      mark = n;
    } else if (p < pattern.size() && (pattern[p] == '?' || pattern[p] == name[n])) {
      ++p;
      ++n;
    } else if (star != std::string_view::npos) {
      p = star + 1;
      n = ++mark;
    } else {
      return false;
    }
  }
  while (p < pattern.size() && pattern[p] == '*') ++p;
  return p == pattern.size();
}

}  // namespace capstan::model

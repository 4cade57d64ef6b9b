#include "planner/model/plan/edit/edit.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

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
    Row{EditOf::kCycles, "cycles", "", bit(EditKind::kSet), false, false},
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
      "[PATTERN/]tool=T5, feed, speed or depth with a number, or cycles=explicit",
      "[PATTERN/]tool, feed, speed or depth",
      "[PATTERN/]feed<=2000, or speed, tool.diameter, tool.stick_out, tool.teeth",
      "[PATTERN/]tool=NAME, operation=KIND or strategy=KIND", "PATTERN<PATTERN, features or workingsteps"};
  return fail({.code = "EDIT-SYNTAX",
               .message = quoted(text) + " is no " + std::string(to_text(kind)) + ": " + std::move(what),
               .expected = kForms.at(static_cast<std::size_t>(kind))});
}

constexpr const char* kNotClosed = "its quoted name is empty, or more text follows it, or it has no end";
constexpr char kQuote = '"', kEscape = '\\';
constexpr const char* kQuoting =
    "a name that holds = or <, or begins with a quote, goes into double quotes: \"A=B\"/feed=900";

/// Takes the double-quoted name that a text begins with off it; a backslash stands before a quote and before
/// a backslash within. Nothing: the quote is not closed, or holds nothing.
std::optional<std::string> take_quoted(std::string_view& text) {
  std::string out;
  for (std::size_t i = 1; i < text.size(); ++i) {
    if (text[i] == kQuote) {
      text = trimmed_text(text.substr(i + 1));
      return out.empty() ? std::nullopt : std::optional(out);
    }
    if (text[i] == kEscape && i + 1 < text.size() && (text[i + 1] == kQuote || text[i + 1] == kEscape)) ++i;
    out += text[i];
  }
  return std::nullopt;
}

bool is_quoted(std::string_view text) { return !text.empty() && text.front() == kQuote; }

/// A name as an edit's text has it: in quotes where one of `signs` in it, or a blank at an end, would be
/// taken for something else.
std::string as_name(std::string_view name, std::string_view signs) {
  const bool plain = !is_quoted(name) && trimmed_text(name).size() == name.size() &&
                     name.find_first_of(signs) == std::string_view::npos;
  if (plain) return std::string(name);
  std::string out(1, kQuote);
  for (const char c : name) {
    if (c == kQuote || c == kEscape) out += kEscape;
    out += c;
  }
  return out + kQuote;
}

/// The attribute of the part between pattern and sign. `rest`: what stands behind the sign.
Result<const Row*> take_attribute(EditKind kind, std::string_view left, std::string_view rest, Edit& into) {
  const auto slash = left.rfind('/');
  std::string_view name = left;
  if (slash != std::string_view::npos) {
    into.where = trimmed_text(left.substr(0, slash));
    name = trimmed_text(left.substr(slash + 1));
    if (into.where.empty()) return no_edit(kind, left, "nothing precedes the '/'");
  }
  std::vector<std::string> known;
  for (const Row& r : kRows) {
    if ((r.kinds & bit(kind)) == 0) continue;
    if (r.name == name) return &r;
    known.emplace_back(r.name);
  }
  Diagnostic d = unknown_name(std::string(to_text(kind)) + " of", name, known, "capstan plan --help");
  const std::string_view behind = rest.substr(std::min(rest.size(), rest.rfind('/') + 1));
  if (slash == std::string_view::npos && rest.find('/') != std::string_view::npos &&
      std::any_of(known.begin(), known.end(), [&](const std::string& k) { return behind.starts_with(k); }))
    d.message += std::string(". If '") + std::string(name) + "' is the beginning of a name: " + kQuoting;
  d.expected.clear();
  for (const std::string& k : known) d.expected += (d.expected.empty() ? "" : ", ") + k;
  return fail(std::move(d));
}

Status take_value(const Row& row, std::string_view text, Edit& into) {
  if (text.empty()) return no_edit(into.kind, text, "it has no value");
  into.of = row.of;
  into.value = text;
  if (!row.number) {
    if (!is_quoted(text)) return {};
    auto name = take_quoted(text);
    if (!name || !text.empty()) return no_edit(into.kind, into.value, kNotClosed);
    into.value = *std::move(name);
    return {};
  }
  const auto v = parse_double(text);
  if (!v || !(*v > 0.0) || *v > kMostNumber)
    return no_edit(into.kind, text,
                   std::string(row.name) + " wants a number above 0 and up to " + trimmed(kMostNumber, 0) +
                       (row.unit.empty() ? "" : " " + std::string(row.unit)) + ", decimals with a point");
  into.number = *v;
  return {};
}

/// The name up to a sign, or up to the end without one; quoted or not.
std::optional<std::string> take_name(std::string_view& text, std::string_view sign) {
  if (is_quoted(text)) return take_quoted(text);
  const auto end = std::min(text.size(), text.find(sign));
  std::string out(trimmed_text(text.substr(0, end)));
  text = text.substr(end);
  return out;
}

Result<Edit> parse_order(std::string_view text, Edit out) {
  constexpr std::string_view kSign = "<";
  const std::string_view all = text;
  const auto first = take_name(text, kSign);
  if (!first) return no_edit(out.kind, all, kNotClosed);
  if (!text.starts_with(kSign)) return no_edit(out.kind, all, "it has no '<'");
  text = trimmed_text(text.substr(kSign.size()));
  const auto second = take_name(text, kSign);
  if (!second) return no_edit(out.kind, all, kNotClosed);
  if (first->empty() || second->empty()) return no_edit(out.kind, all, "one side of the '<' is empty");
  if (!text.empty()) return no_edit(out.kind, all, std::string("it has more than one '<'; ") + kQuoting);
  out.where = *first;
  out.before = *second;
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
  const std::string_view all = text;
  if (is_quoted(text)) {
    auto name = take_quoted(text);
    if (!name) return no_edit(kind, all, kNotClosed);
    if (!text.starts_with('/')) return no_edit(kind, all, "no '/' follows its quoted name");
    text = trimmed_text(text.substr(1));
    if (text.find('/') < text.find_first_of("=<>"))
      return no_edit(kind, all, "its name is quoted in part; quote all of it");
    out.where = *std::move(name);
  }
  const bool limit = kind == EditKind::kLimit;
  std::size_t sign = text.find(limit ? "<=" : "="), end = sign + (limit ? 2 : 1);
  if (limit && sign == std::string_view::npos) {
    sign = text.find(">=");
    end = sign + 2;
    out.at_least = true;
  }
  if (sign == std::string_view::npos) {
    if (kind != EditKind::kPin)
      return no_edit(kind, all, limit ? "it has neither '<=' nor '>='" : "it has no '='");
    const auto row = take_attribute(kind, text, {}, out);
    if (!row) return tl::unexpected(row.error());
    out.of = (*row)->of;
    return out;
  }
  const std::string_view value = trimmed_text(text.substr(end));
  const auto row = take_attribute(kind, trimmed_text(text.substr(0, sign)), value, out);
  if (!row) return tl::unexpected(row.error());
  if (out.at_least && !(*row)->at_least)
    return no_edit(kind, all, std::string((*row)->name) + " is bounded from above only, by '<='");
  if (auto ok = take_value(**row, value, out); !ok) return tl::unexpected(ok.error());
  return out;
}

std::string text_of(const Edit& e) {
  if (e.kind == EditKind::kOrder) return as_name(e.where, "<") + "<" + as_name(e.before, "<");
  std::string out = (e.where == "*" ? "" : as_name(e.where, "=<>") + "/") + std::string(word_of(e.of));
  if (e.value.empty()) return out;
  return out + (e.kind == EditKind::kLimit ? e.at_least ? ">=" : "<=" : "=") + as_name(e.value, "");
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

#pragma once

#include <algorithm>
#include <cctype>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "planner/ground/base/number.h"
#include "tests/mutation/classes.h"

// What the classes are made of: lines of a program, their words, and the edit of one picked by the seed. A
// program without such a line gives nothing.

namespace capstan::mutation {

using Made = std::optional<Edit>;
using Lines = std::vector<std::string>;

inline Lines split(const std::string& text) {
  Lines out;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.find('\n', at), text.size());
    out.push_back(text.substr(at, end - at));
    at = end + 1;
  }
  return out;
}

inline std::string joined(const Lines& lines) {
  std::string out;
  for (const std::string& l : lines) out += l + "\n";
  return out;
}

inline bool starts(const std::string& l, const std::string& with) { return l.rfind(with, 0) == 0; }
inline bool holds(const std::string& l, const std::string& part) { return l.find(part) != std::string::npos; }
inline bool is_cut(const std::string& l) { return starts(l, "G1 ") || starts(l, "G2 ") || starts(l, "G3 "); }
inline bool is_arc(const std::string& l) { return starts(l, "G2 ") || starts(l, "G3 "); }
inline bool is_retract(const std::string& l) {
  return starts(l, "G53 G0 Z") || starts(l, "G0 G49 G53 Z") || starts(l, "G0 SUPA Z");
}
inline bool is_cycle(const std::string& l) { return starts(l, "G98 ") || starts(l, "MCALL CYCLE"); }
inline bool is_tapping(const std::string& l) {
  return starts(l, "G33.1") || (is_cycle(l) && (holds(l, "G84") || holds(l, "G74") || holds(l, "CYCLE84(")));
}
inline bool sets_length(const std::string& l) { return holds(l, "G43 H") || starts(l, "G0 D1 Z"); }
inline bool is_motion(const std::string& l) { return is_cut(l) || starts(l, "G0 "); }
inline bool is_start(const std::string& l) { return starts(l, "S") && (holds(l, " M3") || holds(l, " M4")); }
inline bool is_change(const std::string& l) { return starts(l, "T") && holds(l, " M6"); }
inline bool is_marker(const std::string& l) {
  return starts(l, "(CAPSTAN STEP") || starts(l, ";CAPSTAN STEP");
}
inline bool is_siemens(const Emitted& e) { return e.dialect == "siemens"; }
/// A wait of so many seconds.
inline std::string wait_of(const Emitted& e, const std::string& seconds) {
  return (is_siemens(e) ? "G4 F" : "G4 P") + seconds;
}
inline bool is_code(const std::string& l) {
  return !l.empty() && l.front() != '(' && l.front() != ';' && l.front() != '%' && l.front() != 'O';
}

using Is = bool (*)(const std::string&);

inline std::optional<std::size_t> pick(const Lines& lines, Random& random,
                                       const std::function<bool(std::size_t)>& is) {
  std::vector<std::size_t> all;
  for (std::size_t i = 0; i < lines.size(); ++i) {
    if (is(i)) all.push_back(i);
  }
  if (all.empty()) return std::nullopt;
  return all[random.below(all.size())];
}
/// Behind the first marker: what the header states, each step states again. Retracts and any block anywhere.
inline std::optional<std::size_t> pick(const Lines& lines, Random& random, Is is) {
  const auto first =
      static_cast<std::size_t>(std::find_if(lines.begin(), lines.end(), is_marker) - lines.begin());
  const bool anywhere = is == is_retract || is == is_code;
  return pick(lines, random, [&](std::size_t i) { return (anywhere || i > first) && is(lines[i]); });
}

inline std::string n(double v) { return trimmed(v, 4); }

/// Where a word's number stands in a line; npos for none.
struct Word {
  std::size_t at = std::string::npos, length = 0;
  double value = 0.0;
};
inline Word word(const std::string& l, char letter) {
  for (std::size_t i = 0; i + 1 < l.size() && l[i] != '('; ++i) {
    if (l[i] != letter || (i > 0 && l[i - 1] != ' ')) continue;
    std::size_t end = i + 1;
    while (end < l.size() && l[end] != ' ') ++end;
    const auto v = parse_double(l.substr(i + 1, end - i - 1));
    if (v) return {i + 1, end - i - 1, *v};
  }
  return {};
}
inline bool has(const std::string& l, char letter) { return word(l, letter).at != std::string::npos; }

inline std::string with(std::string l, char letter, double value) {
  const Word w = word(l, letter);
  return l.replace(w.at, w.length, n(value));
}

/// Replaces, inserts behind, or takes away one line that `is`.
template <class F>
Made changed(const Emitted& e, Random& r, Is is, F f) {
  Lines lines = split(e.text);
  const auto i = pick(lines, r, is);
  if (!i) return std::nullopt;
  lines[*i] = f(lines[*i]);
  return Edit{joined(lines), e.table};
}
template <class F>
Made behind(const Emitted& e, Random& r, Is is, F f) {
  Lines lines = split(e.text);
  const auto i = pick(lines, r, is);
  if (!i) return std::nullopt;
  lines.insert(lines.begin() + static_cast<long>(*i) + 1, f(lines[*i]));
  return Edit{joined(lines), e.table};
}
inline Made without(const Emitted& e, Random& r, Is is) {
  Lines lines = split(e.text);
  const auto i = pick(lines, r, is);
  if (!i) return std::nullopt;
  lines.erase(lines.begin() + static_cast<long>(*i));
  return Edit{joined(lines), e.table};
}
template <class F>
Made word_changed(const Emitted& e, Random& r, Is is, char letter, F f) {
  Lines lines = split(e.text);
  const auto i = pick(lines, r, [&](std::size_t k) { return is(lines[k]) && has(lines[k], letter); });
  if (!i) return std::nullopt;
  lines[*i] = with(lines[*i], letter, f(word(lines[*i], letter).value));
  return Edit{joined(lines), e.table};
}
template <class F>
Made table_changed(const Emitted& e, Random& r, F f) {
  Lines rows = split(e.table);
  if (rows.empty()) return std::nullopt;
  // Only tools that the program loads.
  const auto i = pick(rows, r, [&](std::size_t k) {
    return holds(e.text, "\n" + rows[k].substr(0, rows[k].find(' ')) + " M6\n");
  });
  if (!i) return std::nullopt;
  const std::string row = f(rows[*i]);
  if (row.empty()) {
    rows.erase(rows.begin() + static_cast<long>(*i));
  } else {
    rows[*i] = row;
  }
  return Edit{e.text, joined(rows)};
}

inline double moved(double v, Random& r, double lo, double hi) {
  return v + (r.below(2) == 0 ? 1.0 : -1.0) * r.between(lo, hi);
}

}  // namespace capstan::mutation

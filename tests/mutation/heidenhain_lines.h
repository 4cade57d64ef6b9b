#pragma once

#include "tests/mutation/lines.h"

// Lines of Heidenhain's conversational language, without the numbers of blocks.

namespace capstan::mutation::heidenhain {

inline bool fmax(const std::string& l) { return starts(l, "L ") && holds(l, " FMAX"); }
inline bool retracts(const std::string& l) { return fmax(l) && holds(l, " M91"); }
inline bool rapid(const std::string& l) { return fmax(l) && !holds(l, " M91"); }
inline bool fed(const std::string& l) { return starts(l, "L ") && !holds(l, " FMAX"); }
inline bool arc(const std::string& l) { return starts(l, "C ") || starts(l, "CP "); }
inline bool cuts(const std::string& l) { return fed(l) || arc(l); }
inline bool moves(const std::string& l) { return starts(l, "L ") || arc(l); }
inline bool marks(const std::string& l) { return starts(l, "; CAPSTAN STEP"); }
inline bool changes(const std::string& l) { return starts(l, "TOOL CALL ") && !starts(l, "TOOL CALL Z"); }
inline bool speeds(const std::string& l) { return starts(l, "TOOL CALL "); }
inline bool starts_spindle(const std::string& l) { return l == "M3" || l == "M4"; }
inline bool calls(const std::string& l) { return l == "CYCL CALL"; }
inline bool code(const std::string& l) { return !l.empty() && l.front() != ';'; }

/// Where the number behind such letters stands, "X" in "L X+5 R0".
inline Word number_at(const std::string& l, const std::string& letters) {
  for (std::size_t i = 0; i + letters.size() < l.size() && l[i] != ';'; ++i) {
    if (l.compare(i, letters.size(), letters) != 0 || (i > 0 && l[i - 1] != ' ')) continue;
    const std::size_t at = i + letters.size();
    std::size_t end = at;
    while (end < l.size() && l[end] != ' ') ++end;
    const auto v = parse_double(l.substr(l[at] == '+' ? at + 1 : at, end - (l[at] == '+' ? at + 1 : at)));
    if (v) return {at, end - at, *v};
  }
  return {};
}
inline bool says(const std::string& l, const std::string& letters) {
  return number_at(l, letters).at != std::string::npos;
}
inline std::string signed_text(double v) { return (v < 0.0 ? "" : "+") + n(v); }

using Test = std::function<bool(const std::string&)>;
/// Behind the first marker.
inline std::optional<std::size_t> one_of(const Lines& lines, Random& r, const Test& is) {
  const auto first =
      static_cast<std::size_t>(std::find_if(lines.begin(), lines.end(), marks) - lines.begin());
  return pick(lines, r, [&](std::size_t i) { return i > first && is(lines[i]); });
}
template <class F>
inline Made number_changed(const Emitted& e, Random& r, const Test& is, const std::string& letters, F f) {
  Lines lines = split(e.text);
  const auto i = one_of(lines, r, [&](const std::string& l) { return is(l) && says(l, letters); });
  if (!i) return std::nullopt;
  const Word w = number_at(lines[*i], letters);
  const bool has_sign = lines[*i][w.at] == '+' || lines[*i][w.at] == '-';
  lines[*i].replace(w.at, w.length, has_sign ? signed_text(f(w.value)) : n(f(w.value)));
  return Edit{joined(lines), e.table};
}
/// A parameter of a cycle of that number.
template <class F>
inline Made parameter_changed(const Emitted& e, Random& r, const std::string& cycle, const std::string& q,
                              F f) {
  Lines lines = split(e.text);
  std::string now;
  std::vector<std::size_t> all;
  for (std::size_t i = 0; i < lines.size(); ++i) {
    if (starts(lines[i], "CYCL DEF ")) now = lines[i].substr(9, 3);
    if (starts(lines[i], "  " + q + "=") && (cycle.empty() ? now != "247" : now == cycle)) all.push_back(i);
  }
  if (all.empty()) return std::nullopt;
  std::string& l = lines[all[r.below(all.size())]];
  const Word w = number_at(l, q + "=");
  l.replace(w.at, w.length, signed_text(f(w.value)));
  return Edit{joined(lines), e.table};
}
template <class F>
inline Made line_changed(const Emitted& e, Random& r, const Test& is, F f) {
  Lines lines = split(e.text);
  const auto i = one_of(lines, r, is);
  if (!i) return std::nullopt;
  lines[*i] = f(lines[*i]);
  return Edit{joined(lines), e.table};
}
template <class F>
inline Made put_behind(const Emitted& e, Random& r, const Test& is, F f) {
  return line_changed(e, r, is, [&](const std::string& l) { return l + "\n" + f(); });
}
inline Made removed(const Emitted& e, Random& r, const Test& is) {
  Lines lines = split(e.text);
  const auto i = one_of(lines, r, is);
  if (!i) return std::nullopt;
  lines.erase(lines.begin() + static_cast<long>(*i));
  return Edit{joined(lines), e.table};
}
inline std::string replaced(std::string l, const std::string& from, const std::string& to) {
  const std::size_t at = l.find(from);
  return at == std::string::npos ? l : l.replace(at, from.size(), to);
}

}  // namespace capstan::mutation::heidenhain

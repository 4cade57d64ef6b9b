#include <algorithm>
#include <cmath>
#include <map>

#include "planner/ground/base/number.h"
#include "tests/mutation/lines.h"
#include "tests/mutation/plans/plan_classes.h"

// Edits of a plan's Part 21 file: one parameter of one entity, the entity's keyword picked first, so that the
// many points of paths do not outweigh all else.

namespace capstan::mutation {
namespace {

using MadeText = std::optional<std::string>;

/// A parameter within a line: its place and length. One line is one entity, as the writer writes them.
struct Lexeme {
  std::size_t line = 0, at = 0, length = 0;
};
enum class Of { kNumber, kText, kTruth, kReference, kAny };

constexpr std::string_view kUnsealed[] = {"!CAPSTAN_SEAL", "!CAPSTAN_REASON", "!CAPSTAN_PROVENANCE", "FILE_"};

/// The keyword of an entity's line; empty: no entity, or one of words alone.
std::string keyword_of(const std::string& line) {
  const std::size_t begin = line.find_first_of("=!");
  if (line.empty() || (line[0] != '#' && line[0] != '!') || begin == std::string::npos) return {};
  const std::size_t from = line[begin] == '=' ? begin + 1 : begin;
  const std::string k = line.substr(from, line.find('(') - from);
  for (const auto w : kUnsealed) {
    if (k.rfind(w, 0) == 0) return {};
  }
  return k;
}

std::vector<Lexeme> lexemes(const std::string& line, std::size_t number, Of of) {
  std::vector<Lexeme> out;
  for (std::size_t i = line.find('('); i < line.size();) {
    const char c = line[i];
    std::size_t end = i + 1;
    bool wanted = false;
    if (c == '\'') {
      while (end < line.size() && !(line[end] == '\'' && line[end + 1] != '\''))
        end += line[end] == '\'' ? 2 : 1;
      ++end;
      wanted = of == Of::kText || of == Of::kAny;
    } else if (c == '-' || (c >= '0' && c <= '9')) {
      while (end < line.size() && std::string("+-.0123456789E").find(line[end]) != std::string::npos) ++end;
      wanted = of == Of::kNumber || of == Of::kAny;
    } else if (c == '#') {
      while (end < line.size() && std::isdigit(static_cast<unsigned char>(line[end])) != 0) ++end;
      wanted = of == Of::kReference || of == Of::kAny;
    } else if (c == '.') {
      end = line.find('.', end) + 1;
      wanted = of == Of::kTruth && (line.substr(i, end - i) == ".T." || line.substr(i, end - i) == ".F.");
    }
    if (wanted) out.push_back({number, i, end - i});
    i = end;
  }
  return out;
}

struct Group {
  const char* name;
  Kind kind;
  bool (*holds)(const std::string& keyword);
};
bool of_path(const std::string& k) {
  return k == "CARTESIAN_POINT" || k == "POLYLINE" || k == "COMPOSITE_CURVE" || k == "TRIMMED_CURVE" ||
         k == "CIRCLE" || k == "COMPOSITE_CURVE_SEGMENT" || k == "CUTTER_LOCATION_TRAJECTORY";
}
const Group kGroups[] = {
    {"records of tools, material, raw piece", Kind::kDangerous,
     [](const std::string& k) { return k[0] == '!' && k != "!CAPSTAN_BINDING" && k != "!CAPSTAN_IDENTITY"; }},
    {"records of decisions", Kind::kDifferent,
     [](const std::string& k) { return k == "!CAPSTAN_BINDING" || k == "!CAPSTAN_IDENTITY"; }},
    {"points and curves", Kind::kDangerous, [](const std::string& k) { return of_path(k); }},
    {"features, operations, tools", Kind::kDangerous,
     [](const std::string& k) { return k[0] != '!' && !of_path(k); }},
};

std::optional<Lexeme> pick(const Lines& lines, const Group& group, Of of, Random& r) {
  std::map<std::string, std::vector<std::size_t>> by_keyword;
  for (std::size_t i = 0; i < lines.size(); ++i) {
    const std::string k = keyword_of(lines[i]);
    if (!k.empty() && group.holds(k) && !lexemes(lines[i], i, of).empty()) by_keyword[k].push_back(i);
  }
  if (by_keyword.empty()) return std::nullopt;
  auto it = by_keyword.begin();
  std::advance(it, static_cast<long>(r.below(by_keyword.size())));
  const std::size_t line = it->second[r.below(it->second.size())];
  const auto all = lexemes(lines[line], line, of);
  return all[r.below(all.size())];
}

std::string at(const Lines& lines, const Lexeme& l) { return lines[l.line].substr(l.at, l.length); }

MadeText number(const std::string& file, const Group& g, double (*of)(double), Random& r) {
  Lines lines = split(file);
  const auto l = pick(lines, g, Of::kNumber, r);
  if (!l) return std::nullopt;
  const std::string was = at(lines, *l);
  const auto v = parse_double(was.back() == '.' ? was + "0" : was);
  if (!v) return std::nullopt;
  const double is = of(*v);
  if (is == *v || !std::isfinite(is)) return std::nullopt;
  const bool whole = was.find('.') == std::string::npos && is == std::trunc(is) && std::abs(is) < 1e9;
  lines[l->line].replace(l->at, l->length, whole ? trimmed(is, 0) : part21_real(is));
  return joined(lines);
}

MadeText swapped(const std::string& file, const Group& g, Of of, Random& r) {
  Lines lines = split(file);
  const auto a = pick(lines, g, of, r);
  const auto b = pick(lines, g, of, r);
  if (!a || !b || at(lines, *a) == at(lines, *b)) return std::nullopt;
  const std::string other = at(lines, *b);
  lines[a->line].replace(a->at, a->length, other);
  return joined(lines);
}

MadeText removed(const std::string& file, const Group& g, Random& r) {
  Lines lines = split(file);
  const auto l = pick(lines, g, Of::kAny, r);
  if (!l) return std::nullopt;
  lines[l->line].replace(l->at, l->length, "$");
  return joined(lines);
}

MadeText flipped(const std::string& file, const Group& g, Random& r) {
  Lines lines = split(file);
  const auto l = pick(lines, g, Of::kTruth, r);
  if (!l) return std::nullopt;
  lines[l->line].replace(l->at, l->length, at(lines, *l) == ".T." ? ".F." : ".T.");
  return joined(lines);
}

MadeText entity_gone(const std::string& file, const Group& g, Random& r) {
  Lines lines = split(file);
  const auto l = pick(lines, g, Of::kAny, r);
  if (!l) return std::nullopt;
  lines.erase(lines.begin() + static_cast<long>(l->line));
  return joined(lines);
}

// --- the same values ---

MadeText spaces(const std::string& file, Random& r) {
  Lines lines = split(file);
  for (std::string& l : lines) {
    const std::size_t begin = l.find('(');
    if (begin != std::string::npos && l.find('\'') == std::string::npos && r.below(3) == 0)
      l.insert(begin + 1, r.below(2) == 0 ? " " : "/* as agreed */\n  ");
  }
  return joined(lines);
}
MadeText reals_otherwise(const std::string& file, Random& r) {
  Lines lines = split(file);
  for (std::size_t i = 0; i < lines.size(); ++i) {
    if (keyword_of(lines[i]).empty()) continue;
    auto all = lexemes(lines[i], i, Of::kNumber);
    std::reverse(all.begin(), all.end());
    for (const Lexeme& l : all) {
      const std::string was = at(lines, l);
      if (was.find('.') == std::string::npos || was.find('E') != std::string::npos || r.below(2) == 0)
        continue;
      lines[i].replace(l.at, l.length, was + (r.below(2) == 0 ? "0" : "E0"));
    }
  }
  return joined(lines);
}
MadeText another_order(const std::string& file, Random& r) {
  Lines lines = split(file);
  const auto data = std::find(lines.begin(), lines.end(), "DATA;");
  const auto end = std::find(data, lines.end(), "ENDSEC;");
  if (data == lines.end() || end == lines.end()) return std::nullopt;
  const auto n = static_cast<std::size_t>(end - data) - 1;
  for (int i = 0; i < 20; ++i) {
    const auto a = static_cast<long>(1 + r.below(n)), b = static_cast<long>(1 + r.below(n));
    std::swap(data[a], data[b]);
  }
  return joined(lines);
}
MadeText other_author(const std::string& file, Random&) {
  std::string out = file;
  const auto at = out.find("'Capstan','Capstan'");
  if (at == std::string::npos) return std::nullopt;
  return out.replace(at, 19, "'an editor','a shop'");
}

}  // namespace

std::vector<PlanClass> part21_classes() {
  std::vector<PlanClass> out;
  for (const Group& group : kGroups) {
    const Group* g = &group;
    const auto add = [&](const std::string& what, auto make) {
      out.push_back({"Part 21, " + std::string(g->name) + ": " + what, Form::kPart21, g->kind, make});
    };
    for (const NumberEdit& e : number_edits())
      add(e.name, [g, of = e.of](const std::string& f, Random& r) { return number(f, *g, of, r); });
    add("a number by another",
        [g](const std::string& f, Random& r) { return swapped(f, *g, Of::kNumber, r); });
    add("a text by another", [g](const std::string& f, Random& r) { return swapped(f, *g, Of::kText, r); });
    add("a reference by another",
        [g](const std::string& f, Random& r) { return swapped(f, *g, Of::kReference, r); });
    add("a value removed", [g](const std::string& f, Random& r) { return removed(f, *g, r); });
    add("yes for no", [g](const std::string& f, Random& r) { return flipped(f, *g, r); });
    add("an entity removed", [g](const std::string& f, Random& r) { return entity_gone(f, *g, r); });
  }
  const auto benign = [&](const char* what, MadeText (*make)(const std::string&, Random&)) {
    out.push_back({std::string("Part 21: ") + what, Form::kPart21, Kind::kBenign, make});
  };
  benign("spaces and comments", spaces);
  benign("reals spelled otherwise", reals_otherwise);
  benign("entities in another order", another_order);
  benign("another author", other_author);
  return out;
}

}  // namespace capstan::mutation

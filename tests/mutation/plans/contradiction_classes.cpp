#include <algorithm>
#include <nlohmann/json.hpp>

#include "planner/ground/base/number.h"
#include "tests/mutation/lines.h"
#include "tests/mutation/plans/plan_classes.h"

// Edits that leave a plan's file saying two things, or something wrong of the whole plan: which is meant
// nobody can tell, so that each must be an error, and not only told as an edit.

namespace capstan::mutation {
namespace {

using MadeText = std::optional<std::string>;
using Tree = nlohmann::ordered_json;

/// One of the lines that begin so.
std::optional<std::size_t> line_of(const Lines& lines, const std::string& begin, Random& r) {
  std::vector<std::size_t> all;
  for (std::size_t i = 0; i < lines.size(); ++i) {
    const auto at = begin.front() == '!' ? 0 : lines[i].find('=');
    if (at != std::string::npos && lines[i].compare(at, begin.size(), begin) == 0) all.push_back(i);
  }
  if (all.empty()) return std::nullopt;
  return all[r.below(all.size())];
}

MadeText records_swapped(const std::string& file, Random& r) {
  Lines lines = split(file);
  const auto a = line_of(lines, "!CAPSTAN_STEP(", r), b = line_of(lines, "!CAPSTAN_STEP(", r);
  if (!a || !b || *a == *b) return std::nullopt;
  std::swap(lines[*a], lines[*b]);
  return joined(lines);
}

MadeText elements_swapped(const std::string& file, Random& r) {
  Lines lines = split(file);
  const auto at = line_of(lines, "=WORKPLAN(", r);
  if (!at) return std::nullopt;
  std::string& l = lines[*at];
  const std::size_t begin = l.find("(#") + 1, end = l.find(')', begin);
  std::vector<std::string> names;
  for (std::size_t i = begin; i < end;) {
    const std::size_t comma = std::min(l.find(',', i), end);
    names.push_back(l.substr(i, comma - i));
    i = comma + 1;
  }
  if (names.size() < 2) return std::nullopt;
  const std::size_t a = r.below(names.size()), b = r.below(names.size());
  if (a == b) return std::nullopt;
  std::swap(names[a], names[b]);
  std::string list;
  for (const std::string& n : names) list += (list.empty() ? "" : ",") + n;
  l.replace(begin, end - begin, list);
  return joined(lines);
}

/// One number of a record, half as much again.
MadeText record_number(const std::string& file, const char* keyword, Random& r) {
  Lines lines = split(file);
  const auto at = line_of(lines, keyword, r);
  if (!at) return std::nullopt;
  std::string& l = lines[*at];
  std::vector<std::pair<std::size_t, std::size_t>> numbers;
  bool text = false;
  for (std::size_t i = 0; i < l.size(); ++i) {
    if (l[i] == '\'') text = !text;
    if (text || (l[i - (i > 0 ? 1 : 0)] != '(' && l[i - (i > 0 ? 1 : 0)] != ',')) continue;
    const std::size_t end = l.find_first_of(",)", i);
    const std::string word = l.substr(i, end - i);
    if (word.find('.') == std::string::npos || word.front() == '.' ||
        word.find_first_not_of("-+.0123456789E") != std::string::npos)
      continue;
    const auto v = parse_double(word.back() == '.' ? word + "0" : word);
    if (v && *v != 0.0) numbers.emplace_back(i, end - i);
  }
  if (numbers.empty()) return std::nullopt;
  const auto [from, length] = numbers[r.below(numbers.size())];
  const std::string word = l.substr(from, length);
  const auto v = parse_double(word.back() == '.' ? word + "0" : word);
  l.replace(from, length, part21_real(*v * 1.5));
  return joined(lines);
}

/// A tool once more, under its own name, standing out otherwise.
MadeText tool_twice(const std::string& file, Random& r) {
  Lines lines = split(file);
  const auto at = line_of(lines, "!CAPSTAN_CUTTER(", r);
  if (!at) return std::nullopt;
  const auto other = record_number(lines[*at] + "\n", "!CAPSTAN_CUTTER(", r);
  if (!other) return std::nullopt;
  lines.insert(lines.begin() + static_cast<long>(*at), split(*other).front());
  return joined(lines);
}

/// The n-th parameter of an instance leads to nothing, or to what cannot stand there.
MadeText wrong_reference(const std::string& file, const char* keyword, int parameter, Random& r) {
  Lines lines = split(file);
  // The workpiece that is made comes first, its raw piece behind it.
  const auto at = std::find_if(lines.begin(), lines.end(), [&](const std::string& l) {
    return l.find(std::string("=") + keyword) != std::string::npos;
  });
  const auto kind = line_of(lines, "=MILLING_TOOL_DIMENSION(", r);
  if (at == lines.end() || !kind) return std::nullopt;
  std::size_t i = at->find('(') + 1;
  int depth = 0;
  for (int n = 0; n < parameter && i < at->size(); ++i) {
    depth += (*at)[i] == '(' ? 1 : (*at)[i] == ')' ? -1 : 0;
    n += depth == 0 && (*at)[i] == ',' ? 1 : 0;
  }
  i += i < at->size() && (*at)[i] == '(' ? 1 : 0;
  if (i >= at->size() || (*at)[i] != '#') return std::nullopt;
  const std::string to = r.below(2) == 0 ? "#999999" : lines[*kind].substr(0, lines[*kind].find('='));
  at->replace(i, at->find_first_of(",)", i) - i, to);
  return joined(lines);
}

// --- JSON ---

MadeText json_steps_swapped(const std::string& file, Random& r) {
  Tree tree = Tree::parse(file);
  Tree& steps = tree["steps"];
  if (steps.size() < 2) return std::nullopt;
  const std::size_t a = r.below(steps.size()), b = r.below(steps.size());
  if (a == b) return std::nullopt;
  std::swap(steps[a], steps[b]);
  return tree.dump();
}

MadeText json_tool_twice(const std::string& file, Random& r) {
  Tree tree = Tree::parse(file);
  Tree& all = tree["cutters"];
  if (all.empty()) return std::nullopt;
  Tree other = all[r.below(all.size())];
  other["stick_out_mm"] = 1.5 * other["stick_out_mm"].get<double>();
  all.push_back(other);
  return tree.dump();
}

template <int kFactorOfTen>
MadeText json_stick_out(const std::string& file, Random& r) {
  Tree tree = Tree::parse(file);
  Tree& all = tree["cutters"];
  if (all.empty()) return std::nullopt;
  Tree& length = all[r.below(all.size())]["stick_out_mm"];
  length = 0.1 * kFactorOfTen * length.get<double>();
  return tree.dump();
}

MadeText json_list_number(const std::string& file, const char* part, const char* field) {
  Tree tree = Tree::parse(file);
  Tree& at = tree[part].is_array() ? tree[part][0] : tree[part];
  if (!at.contains(field) || !at[field].is_number() || at[field].get<double>() == 0.0) return std::nullopt;
  at[field] = 1.5 * at[field].get<double>();
  return tree.dump();
}

}  // namespace

std::vector<PlanClass> contradiction_classes(Form form) {
  std::vector<PlanClass> out;
  const auto add = [&](const std::string& what, auto make) {
    out.push_back({(form == Form::kJson ? "JSON, said twice: " : "Part 21, said twice: ") + what, form,
                   Kind::kDangerous, make, true});
  };
  if (form == Form::kJson) {
    add("the list of steps in another order", json_steps_swapped);
    add("a tool listed twice", json_tool_twice);
    add("a tool that does not stand out", json_stick_out<0>);
    add("a tool that stands out further", json_stick_out<15>);
    for (const auto& [part, field] :
         {std::pair{"material", "kc11_n_mm2"}, std::pair{"setups", "security_z_mm"},
          std::pair{"steps", "spindle_rpm"}, std::pair{"steps", "feed_mm_min"}})
      add(std::string(part) + "." + field,
          [part, field](const std::string& f, Random&) { return json_list_number(f, part, field); });
    return out;
  }
  add("the list of steps in another order", records_swapped);
  add("the workplan in another order", elements_swapped);
  add("a tool listed twice", tool_twice);
  for (const char* keyword :
       {"!CAPSTAN_MATERIAL(", "!CAPSTAN_STOCK(", "!CAPSTAN_SETUP(", "!CAPSTAN_STEP(", "!CAPSTAN_CUTTER("})
    add(std::string("a number of ") + keyword + "...)",
        [keyword](const std::string& f, Random& r) { return record_number(f, keyword, r); });
  struct Wrong {
    const char *keyword, *attribute;
    int parameter;
  };
  static constexpr Wrong kWrong[] = {{"WORKPIECE(", "its_material", 1},
                                     {"WORKPIECE(", "its_rawpiece", 3},
                                     {"WORKPLAN(", "its_setup", 3},
                                     {"SETUP(", "its_origin", 1},
                                     {"SETUP(", "its_secplane", 2},
                                     {"SETUP(", "its_workpiece_setup", 3},
                                     {"WORKPIECE_SETUP(", "its_workpiece", 0},
                                     {"WORKPIECE_SETUP(", "its_origin", 1}};
  for (const Wrong& w : kWrong)
    add(std::string(w.keyword) + "...)." + w.attribute + " leads elsewhere",
        [&w](const std::string& f, Random& r) { return wrong_reference(f, w.keyword, w.parameter, r); });
  return out;
}

}  // namespace capstan::mutation

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "planner/ground/base/number.h"
#include "tests/mutation/plans/plan_classes.h"

// Edits of a plan's JSON: a tree is read, one leaf of a part changed, and printed again.

namespace capstan::mutation {
namespace {

using Tree = nlohmann::ordered_json;
using Made = std::optional<std::string>;

struct Part {
  const char* name;
  Kind kind;
};
constexpr Part kParts[] = {
    {"machine", Kind::kDangerous},  {"material", Kind::kDangerous}, {"stock", Kind::kDangerous},
    {"cutters", Kind::kDangerous},  {"setups", Kind::kDangerous},   {"steps", Kind::kDangerous},
    {"objects", Kind::kDangerous},  {"paths", Kind::kDangerous},    {"schedules", Kind::kDangerous},
    {"sections", Kind::kDifferent}, {"summary", Kind::kDifferent},  {"decisions", Kind::kDifferent},
};

/// What no reader sees, and no check needs: where an object stood in its file, words, and the hash of a
/// decided value, which is computed anew where the seal of the decisions holds.
bool only_words(const std::string& key) {
  static const std::vector<std::string> kWords = {"@instance", "@line", "description", "source", "sources",
                                                  "names",     "text",  "pickup_text", "why",    "name",
                                                  "lexeme",    "of",    "value_hash"};
  return std::find(kWords.begin(), kWords.end(), key) != kWords.end();
}

template <class Is>
void leaves(Tree& t, std::vector<Tree*>& out, const Is& is) {
  if (t.is_object()) {
    for (auto& item : t.items()) {
      if (!only_words(item.key())) leaves(item.value(), out, is);
    }
  } else if (t.is_array()) {
    for (Tree& item : t) leaves(item, out, is);
  } else if (is(t)) {
    out.push_back(&t);
  }
}

/// A tenth of a whole number is the next whole number: a file with half a tooth is refused at once.
void set(Tree& leaf, double v) {
  if (leaf.is_number_integer() && v == std::trunc(v) && std::abs(v) < 1e15) {
    leaf = static_cast<std::int64_t>(v);
  } else {
    leaf = v;
  }
}

/// First one of the part's entries, then one of its leaves: long columns do not outweigh all else.
template <class Is>
Tree* pick(Tree& tree, const char* part, Random& r, const Is& is) {
  const auto it = tree.find(part);
  if (it == tree.end()) return nullptr;
  Tree* at = &*it;
  for (int i = 0; i < 2 && (at->is_object() || at->is_array()) && !at->empty(); ++i) {
    std::vector<Tree*> children;
    for (auto& item : at->items()) {
      if (!only_words(item.key())) children.push_back(&item.value());
    }
    std::vector<Tree*> with;
    for (Tree* c : children) {
      std::vector<Tree*> all;
      leaves(*c, all, is);
      if (!all.empty()) with.push_back(c);
    }
    if (with.empty()) return nullptr;
    at = with[r.below(with.size())];
  }
  std::vector<Tree*> all;
  leaves(*at, all, is);
  return all.empty() ? nullptr : all[r.below(all.size())];
}

bool is_number(const Tree& t) { return t.is_number(); }

Made number(const std::string& file, const char* part, double (*of)(double), Random& r) {
  Tree tree = Tree::parse(file);
  Tree* leaf = pick(tree, part, r, is_number);
  if (leaf == nullptr) return std::nullopt;
  const double was = leaf->get<double>();
  const double is = of(was);
  if (is == was || !std::isfinite(is)) return std::nullopt;
  set(*leaf, is);
  return tree.dump();
}

Made swapped(const std::string& file, const char* part, Random& r) {
  Tree tree = Tree::parse(file);
  Tree* a = pick(tree, part, r, is_number);
  Tree* b = pick(tree, part, r, is_number);
  if (a == nullptr || b == nullptr || *a == *b) return std::nullopt;
  std::swap(*a, *b);
  return tree.dump();
}

Made flipped(const std::string& file, const char* part, Random& r) {
  Tree tree = Tree::parse(file);
  Tree* leaf = pick(tree, part, r, [](const Tree& t) { return t.is_boolean(); });
  if (leaf == nullptr) return std::nullopt;
  *leaf = !leaf->get<bool>();
  return tree.dump();
}

Made other_text(const std::string& file, const char* part, Random& r) {
  Tree tree = Tree::parse(file);
  const auto is = [](const Tree& t) { return t.is_string(); };
  Tree* a = pick(tree, part, r, is);
  Tree* b = pick(tree, part, r, is);
  if (a == nullptr || b == nullptr || *a == *b) return std::nullopt;
  *a = *b;
  return tree.dump();
}

/// Takes one value out of an object or a list.
Made removed(const std::string& file, const char* part, Random& r) {
  Tree tree = Tree::parse(file);
  const auto it = tree.find(part);
  if (it == tree.end()) return std::nullopt;
  Tree* at = &*it;
  for (int i = 0; i < 6; ++i) {
    std::vector<Tree*> below;
    for (auto& item : at->items()) {
      if (item.value().is_structured() && !item.value().empty() && !only_words(item.key()))
        below.push_back(&item.value());
    }
    if (below.empty() || (i > 1 && r.below(2) == 0)) break;
    at = below[r.below(below.size())];
  }
  if (at->is_array()) {
    if (at->empty()) return std::nullopt;
    at->erase(r.below(at->size()));
  } else {
    std::vector<std::string> keys;
    for (const auto& item : at->items()) {
      if (!only_words(item.key()) && item.key() != "offsets_against_reference") keys.push_back(item.key());
    }
    if (keys.empty()) return std::nullopt;
    at->erase(keys[r.below(keys.size())]);
  }
  return tree.dump();
}

// --- the same values ---

Made in_lines(const std::string& file, Random& r) {
  return Tree::parse(file).dump(static_cast<int>(r.below(8)), r.below(2) == 0 ? ' ' : '\t');
}

void shuffle(Tree& t, Random& r) {
  if (t.is_array()) {
    for (Tree& item : t) shuffle(item, r);
  }
  if (!t.is_object()) return;
  std::vector<std::pair<std::string, Tree>> all;
  for (auto& item : t.items()) all.emplace_back(item.key(), std::move(item.value()));
  Tree out = Tree::object();
  while (!all.empty()) {
    const auto at = all.begin() + static_cast<long>(r.below(all.size()));
    shuffle(at->second, r);
    out[at->first] = std::move(at->second);
    all.erase(at);
  }
  t = std::move(out);
}
Made keys_in_another_order(const std::string& file, Random& r) {
  Tree tree = Tree::parse(file);
  shuffle(tree, r);
  return tree.dump();
}

/// 12 as 12.0 where a number need not be whole, 0.25 as 2.5e-1.
Made numbers_otherwise(const std::string& file, Random& r) {
  std::string out;
  bool text = false;
  for (std::size_t i = 0; i < file.size(); ++i) {
    const char c = file[i];
    if (c == '"') text = !text;
    if (text && c == '\\') out += file[i++];
    const bool begins = !text && (c == '-' || (c >= '0' && c <= '9'));
    if (!begins) {
      out += file[i];
      continue;
    }
    std::size_t end = i;
    while (end < file.size() && std::string("+-.0123456789eE").find(file[end]) != std::string::npos) ++end;
    const std::string lexeme = file.substr(i, end - i);
    // Of 0.25 and -3.5; not of whole numbers, which may be counts, nor of what has an exponent.
    const bool plain = lexeme.find('.') != std::string::npos && lexeme.find('e') == std::string::npos;
    out += lexeme + (plain && r.below(2) == 0 ? (r.below(2) == 0 ? "0" : "e0") : "");
    i = end - 1;
  }
  return out;
}

void reword(Tree& t, Random& r, int& left) {
  if (t.is_array()) {
    for (Tree& item : t) reword(item, r, left);
  }
  if (!t.is_object()) return;
  for (auto& item : t.items()) {
    const std::string& key = item.key();
    const bool words = key == "description" || key == "source" || key == "text" || key == "pickup_text";
    if (words && item.value().is_string() && left > 0 && r.below(4) == 0) {
      item.value() = item.value().get<std::string>() + " (as agreed)";
      --left;
    } else {
      reword(item.value(), r, left);
    }
  }
}
Made other_words(const std::string& file, Random& r) {
  Tree tree = Tree::parse(file);
  int left = 5;
  for (const char* part : {"machine", "cutters", "setups", "reasons", "provenance", "material"}) {
    if (!tree.contains(part)) continue;
    // The first reason is a name.
    const std::size_t from = std::string(part) == "reasons" ? 1 : 0;
    if (tree[part].is_array()) {
      for (std::size_t i = from; i < tree[part].size(); ++i) reword(tree[part][i], r, left);
    } else {
      reword(tree[part], r, left);
    }
  }
  tree["header_description"] = "edited by hand";
  return tree.dump();
}

/// Where the objects stood in a file that is long gone.
Made other_lines(const std::string& file, Random& r) {
  Tree tree = Tree::parse(file);
  for (auto& kind : tree["objects"].items()) {
    for (Tree& object : kind.value()) {
      if (object.contains("@line")) object["@line"] = 1 + r.below(1000);
    }
  }
  return tree.dump();
}

}  // namespace

const std::vector<NumberEdit>& number_edits() {
  static const std::vector<NumberEdit> kAll = {
      {"times ten", [](double v) { return 10.0 * v; }},
      {"a tenth", [](double v) { return 0.1 * v; }},
      {"zero", [](double) { return 0.0; }},
      {"the other sign", [](double v) { return -v; }},
      {"inches for millimetres", [](double v) { return v / 25.4; }},
      {"degrees for radians", [](double v) { return v * 57.295779513082323; }},
      {"seconds for minutes", [](double v) { return v / 60.0; }},
      {"a part in a thousand more", [](double v) { return v * 1.001; }},
      {"one more", [](double v) { return v + 1.0; }},
      {"far too large", [](double v) { return v < 0.0 ? -1e300 : 1e300; }},
      {"hardly above zero", [](double) { return 1e-320; }},
  };
  return kAll;
}

std::vector<PlanClass> json_classes() {
  std::vector<PlanClass> out;
  for (const Part& part : kParts) {
    const char* name = part.name;
    const auto add = [&](const std::string& what, auto make) {
      out.push_back({"JSON, " + std::string(name) + ": " + what, Form::kJson, part.kind, make});
    };
    for (const NumberEdit& e : number_edits()) {
      add(e.name, [name, of = e.of](const std::string& f, Random& r) { return number(f, name, of, r); });
    }
    add("two values swapped", [name](const std::string& f, Random& r) { return swapped(f, name, r); });
    add("a value removed", [name](const std::string& f, Random& r) { return removed(f, name, r); });
    add("a text by another", [name](const std::string& f, Random& r) { return other_text(f, name, r); });
    add("yes for no", [name](const std::string& f, Random& r) { return flipped(f, name, r); });
  }
  const auto benign = [&](const char* what, Made (*make)(const std::string&, Random&)) {
    out.push_back({std::string("JSON: ") + what, Form::kJson, Kind::kBenign, make});
  };
  benign("spaces and lines", in_lines);
  benign("names in another order", keys_in_another_order);
  benign("numbers spelled otherwise", numbers_otherwise);
  benign("words for people", other_words);
  benign("lines of the part's file", other_lines);
  return out;
}

}  // namespace capstan::mutation

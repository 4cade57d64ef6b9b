#include <algorithm>
#include <map>

#include "planner/files/exchange/ap238/read/reader.h"
#include "planner/model/nouns/arena/walk.h"

// Reports attributes of an application object that no row of the mapping uses: they do not reach the model.

namespace capstan::exchange::ap238 {

using p21::Kind;
using p21::Value;

namespace {

// FNV-1a, 32 bits, of an attribute's name.
std::uint32_t hash_of(std::string_view name) {
  std::uint32_t h = 2166136261U;
  for (const char c : name) h = (h ^ static_cast<unsigned char>(c)) * 16777619U;
  return h;
}

std::string_view bare_name(std::string_view attribute) {
  const auto dot = attribute.find('.');
  return dot == std::string_view::npos ? attribute : attribute.substr(dot + 1);
}

std::uint64_t attribute_key(Node n, std::string_view attribute) {
  return std::uint64_t{n} << 32 | hash_of(bare_name(attribute));
}

std::uint64_t reference_key(Node a, Node b) { return std::uint64_t{std::min(a, b)} << 32 | std::max(a, b); }

void sort_unique(std::vector<std::uint64_t>& keys) {
  std::sort(keys.begin(), keys.end());
  keys.erase(std::unique(keys.begin(), keys.end()), keys.end());
}

// Whether there is a text or a number in it. Not recursive beyond the parser's limit of depth.
bool says_something(const Value& v) {
  if (v.is(Kind::kString)) return !v.as_text().empty();
  if (v.is_number()) return true;
  if (!v.is(Kind::kList) && !v.is(Kind::kTyped)) return false;
  for (std::size_t i = 0; i < v.size(); ++i) {
    if (says_something(v[i])) return true;
  }
  return false;
}

}  // namespace

void Reader::consume_constraints(Node n, const std::vector<Constraint>& constraints) const {
  for (const Constraint& c : constraints) {
    if (!c.negated) read_attributes_.push_back(attribute_key(n, c.attribute));
  }
}

void Reader::consume(const std::vector<Step>& steps, const std::string& value_of, Node root,
                     const Terminal& t) const {
  Node before = root;
  for (std::size_t k = 0; k < t.trail.size() && k < steps.size(); ++k) {
    read_references_.push_back(reference_key(before, t.trail[k].node));
    before = t.trail[k].node;
    consume_constraints(before, steps[k].constraints);
  }
  if (!value_of.empty()) read_attributes_.push_back(attribute_key(t.node, value_of));
}

void Reader::note_unread() {
  sort_unique(read_attributes_);
  sort_unique(read_references_);
  const auto has = [](const std::vector<std::uint64_t>& keys, std::uint64_t key) {
    return std::binary_search(keys.begin(), keys.end(), key);
  };
  std::map<std::string, std::pair<std::size_t, Node>> unread;
  std::vector<Node> to;
  // Whether an object that was read at n holds one that was read at `other`.
  const auto held = [&](Node n, Node other) {
    bool found = false;
    const auto [first, last] = nouns_.equal_range(n);
    for (auto it = first; it != last; ++it) {
      model::for_each_reference(plan_.model, it->second,
                                [&](model::AnyRef r) { found = found || (r.set() && root_of(r) == other); });
    }
    return found;
  };
  // Values and names that codecs read from the instance itself.
  const auto by_code = [&](Node n) {
    return g_.is(n, g_.schema().find("MEASURE_WITH_UNIT")) ||
           g_.is(n, g_.schema().find("PROPERTY_DEFINITION"));
  };
  const auto look = [&](Node n, const express::Attribute& a, const Value& v) {
    if (v.is(Kind::kOmitted) || has(read_attributes_, attribute_key(n, a.name))) return;
    to.clear();
    g_.references(v, to);
    const bool lost = std::any_of(to.begin(), to.end(), [&](Node other) {
      if (claimed_[other] || has(read_references_, reference_key(n, other))) return false;
      // Part of some object's mapping: a codec found its own way there. An object: the model has it.
      return !owner_[other].set() && !held(n, other);
    });
    if (by_code(n) && (bare_name(a.name) == "unit_component")) return;
    if (!lost && (by_code(n) || !says_something(v))) return;
    std::string name = std::string(g_.schema().keyword(a.owner)) + "." + std::string(a.name);
    auto& entry = unread.emplace(std::move(name), std::pair(std::size_t{0}, n)).first->second;
    ++entry.first;
    entry.second = std::min(entry.second, n);
  };
  std::vector<Node> roots;
  for (const auto& [at, n] : root_) roots.push_back(n);
  std::sort(roots.begin(), roots.end());
  roots.erase(std::unique(roots.begin(), roots.end()), roots.end());
  for (const Node n : roots) {
    const auto i = g_.instance(n);
    if (g_.entity(n) != express::kNoEntity) {
      const auto slots = g_.schema().slots(g_.entity(n));
      const Value list = i.parameters();
      for (std::size_t k = 0; k < slots.size() && k < list.size(); ++k) look(n, *slots[k].attribute, list[k]);
      continue;
    }
    for (std::size_t p = 0; p < i.part_count(); ++p) {
      const EntityId part = g_.schema().find(i.part(p).keyword);
      if (part == express::kNoEntity) continue;
      const auto own = g_.schema().own(part);
      const Value list = i.part(p).parameters;
      for (std::size_t k = 0; k < own.size() && k < list.size(); ++k) look(n, own[k], list[k]);
    }
  }
  for (const auto& [name, entry] : unread) {
    const std::string others = entry.first == 1 ? "" : " (" + std::to_string(entry.first) + " instances)";
    about(entry.second,
          {.code = "EXC-UNREAD",
           .severity = Severity::kNote,
           .message = name + " says something that is not read and will not be written" + others});
  }
}

}  // namespace capstan::exchange::ap238

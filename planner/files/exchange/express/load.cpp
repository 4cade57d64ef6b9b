#include <algorithm>
#include <bit>
#include <charconv>
#include <limits>
#include <optional>
#include <stdexcept>

#include "planner/files/exchange/express/tables.h"
#include "planner/ground/base/stopping.h"

namespace capstan::exchange::express {
namespace {

constexpr char upper(char c) { return c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c; }

// FNV-1a of the name in upper case.
std::uint64_t hash(std::string_view name) {
  std::uint64_t h = 14695981039346656037ULL;
  for (const char c : name) h = (h ^ static_cast<unsigned char>(upper(c))) * 1099511628211ULL;
  return h ^ h >> 32;
}

bool same(std::string_view in_upper_case, std::string_view name) {
  return in_upper_case.size() == name.size() && std::equal(name.begin(), name.end(), in_upper_case.begin(),
                                                           [](char a, char b) { return upper(a) == b; });
}

[[noreturn]] void malformed(std::string_view line) {
  throw std::logic_error("malformed line in a dictionary table: " + std::string(line));
}

constexpr struct {
  std::string_view name;
  TypeKind kind;
} kBasic[] = {{"integer", TypeKind::kInteger}, {"real", TypeKind::kReal},
              {"number", TypeKind::kNumber},   {"string", TypeKind::kString},
              {"boolean", TypeKind::kBoolean}, {"logical", TypeKind::kLogical},
              {"binary", TypeKind::kBinary}};
constexpr struct {
  std::string_view name;
  AggregateKind kind;
} kAggregates[] = {{"list", AggregateKind::kList},
                   {"set", AggregateKind::kSet},
                   {"bag", AggregateKind::kBag},
                   {"array", AggregateKind::kArray}};

// The blank-separated words of a line.
class Words {
 public:
  explicit Words(std::string_view line) : line_(line), rest_(line) {}

  std::string_view peek() const { return rest_.substr(0, rest_.find(' ')); }
  bool done() const { return rest_.empty(); }
  std::string_view next() {
    if (done()) malformed(line_);
    const std::string_view word = peek();
    rest_.remove_prefix(std::min(word.size() + 1, rest_.size()));
    return word;
  }
  bool take(std::string_view word) {
    if (done() || peek() != word) return false;
    next();
    return true;
  }
  void want(std::string_view word) {
    if (!take(word)) malformed(line_);
  }
  std::string_view line() const { return line_; }

 private:
  std::string_view line_, rest_;
};

class Loader {
 public:
  explicit Loader(std::string_view table) : t_(std::make_unique<Dictionary::Tables>()) {
    t_->lower = table;
    t_->upper = table;
    std::transform(table.begin(), table.end(), t_->upper.begin(), upper);
  }

  std::unique_ptr<Dictionary::Tables> run() {
    names();
    for (const auto& b : kBasic) basic_.push_back(&t_->types.emplace_back(Type{.kind = b.kind}));
    for (std::size_t i = 0; i < lines_.size(); ++i) {
      tick(8);
      Words words(lines_[i]);
      words.next();
      words.next();
      if (i < t_->entities.size())
        entity(words, t_->entities[i]);
      else
        type(words, *own_[i]);
    }
    for (std::size_t i = 0; i < t_->entities.size(); ++i) {
      tick(8);
      order(i);
    }
    ancestors();
    for (Entity& e : t_->entities) {
      tick(8);
      slots(e);
    }
    admitted();
    return std::move(t_);
  }

 private:
  // The same text in upper case.
  std::string_view raised(std::string_view s) const {
    return std::string_view(t_->upper).substr(static_cast<std::size_t>(s.data() - t_->lower.data()),
                                              s.size());
  }

  // Every line gets a number and a Type, before any refers to another.
  void names() {
    std::string_view rest = t_->lower;
    std::vector<std::string_view> keywords;
    while (!rest.empty()) {
      const std::string_view line = rest.substr(0, rest.find('\n'));
      rest.remove_prefix(std::min(line.size() + 1, rest.size()));
      if (line.empty() || line.front() == '#') continue;
      tick();
      lines_.push_back(line);
      Words words(line);
      const std::string_view kind = words.next();
      const std::string_view keyword = raised(words.next());
      Type& type = t_->types.emplace_back();
      type.name = keyword;
      if (kind == "entity") {
        if (t_->entities.size() != keywords.size()) malformed(line);
        type.kind = TypeKind::kEntity;
        type.entity = EntityId{static_cast<std::uint16_t>(keywords.size())};
        t_->entities.emplace_back().keyword = keyword;
      } else {
        type.kind = kind == "enum"     ? TypeKind::kEnumeration
                    : kind == "select" ? TypeKind::kSelect
                                       : TypeKind::kDefined;
      }
      own_.push_back(&type);
      keywords.push_back(keyword);
    }
    t_->named.assign(own_.begin(), own_.end());
    t_->names.build(keywords);
  }

  const Type* named(std::string_view name, std::string_view line) const {
    for (std::size_t i = 0; i < basic_.size(); ++i) {
      if (kBasic[i].name == name) return basic_[i];
    }
    const std::uint32_t found = t_->names.find(name);
    if (found == Names::kNone) malformed(line);
    return t_->named[found];
  }

  // TYPE of the table's form.
  const Type* type_of(Words& words) {
    const std::string_view word = words.next();
    for (const auto& a : kAggregates) {
      if (a.name != word) continue;
      Type type{.kind = TypeKind::kAggregate, .aggregate = a.kind, .unique = a.kind == AggregateKind::kSet};
      bounds(words, type);
      while (true) {
        if (words.take("unique"))
          type.unique = true;
        else if (words.take("optional"))
          type.optional_elements = true;
        else
          break;
      }
      type.underlying = type_of(words);
      return &t_->types.emplace_back(std::move(type));
    }
    return named(word, words.line());
  }

  static void bounds(Words& words, Type& type) {
    const std::string_view text = words.next();
    const auto colon = text.find(':');
    if (colon == std::string_view::npos) malformed(words.line());
    const auto lower = text.substr(0, colon), upper = text.substr(colon + 1);
    std::from_chars(lower.data(), lower.data() + lower.size(), type.lower);
    if (upper != "?") std::from_chars(upper.data(), upper.data() + upper.size(), type.upper);
    if (type.aggregate != AggregateKind::kArray) return;
    // An array's bounds are its first and last index.
    if (type.upper != Type::kUnbounded) type.upper = type.upper + 1 - type.lower;
    type.lower = type.upper != Type::kUnbounded ? type.upper : 0;
  }

  // "[0,24)"; ? for no bound.
  static Range range(std::string_view text) {
    const auto comma = text.find(',');
    if (comma == std::string_view::npos || text.size() < 5) malformed(text);
    const auto number = [](std::string_view s, double none) {
      std::from_chars(s.data(), s.data() + s.size(), none);  // unchanged if there is no number
      return none;
    };
    constexpr double kInfinity = std::numeric_limits<double>::infinity();
    return {number(text.substr(1, comma - 1), -kInfinity),
            number(text.substr(comma + 1, text.size() - comma - 2), kInfinity), text.front() == '[',
            text.back() == ']', text};
  }

  void type(Words& words, Type& type) {
    words.want("=");
    if (type.kind == TypeKind::kDefined) {
      type.underlying = type_of(words);
      if (words.take("in")) type.range = range(words.next());
      return;
    }
    while (!words.done()) {
      const std::string_view item = words.next();
      if (type.kind == TypeKind::kEnumeration)
        type.enumerators.push_back(raised(item));
      else
        type.items.push_back(named(item, words.line()));
    }
  }

  void entity(Words& words, Entity& e) {
    e.abstract = words.take("abstract");
    words.want(":");
    const EntityId self{static_cast<std::uint16_t>(&e - t_->entities.data())};
    while (!words.done() && words.peek() != ";")
      e.supertypes.push_back(named(words.next(), words.line())->entity);
    while (words.take(";")) {
      if (words.take("!")) {
        auto& group = e.exclusive.emplace_back();
        while (!words.done() && words.peek() != ";")
          group.push_back(named(words.next(), words.line())->entity);
        continue;
      }
      const bool derived = words.take("*");
      const std::string_view name = words.next();
      const bool optional = words.take("?");
      const Type* type = derived ? nullptr : type_of(words);
      const auto bar = name.find('\\');
      if (bar == std::string_view::npos) {
        e.own.push_back({name, self, type, optional});
        continue;
      }
      const auto equals = name.find('=');
      const auto end = equals == std::string_view::npos ? name.size() : equals;
      later_.push_back({self, name.substr(0, bar), name.substr(bar + 1, end - bar - 1)});
      e.redeclared.push_back(
          {nullptr, equals == std::string_view::npos ? later_.back().attribute : name.substr(equals + 1),
           type, optional});
    }
  }

  // Supertypes in the order of the internal mapping; depth first with an explicit stack.
  void order(std::size_t root) {
    std::vector<bool> seen(t_->entities.size());
    std::vector<std::pair<std::size_t, std::size_t>> stack{{root, 0}};
    seen[root] = true;
    auto& out = t_->entities[root].ancestors_first;
    while (!stack.empty()) {
      auto& [at, next] = stack.back();
      const auto& supers = t_->entities[at].supertypes;
      if (next == supers.size()) {
        out.push_back(EntityId{static_cast<std::uint16_t>(at)});
        stack.pop_back();
        continue;
      }
      const auto super = static_cast<std::size_t>(supers[next++]);
      if (seen.at(super)) continue;
      seen[super] = true;
      stack.emplace_back(super, 0);
    }
  }

  void ancestors() {
    const std::size_t n = t_->entities.size();
    t_->row = (n + 63) / 64;
    t_->ancestors.assign(n * t_->row, 0);
    for (std::size_t i = 0; i < n; ++i) {
      for (const EntityId a : t_->entities[i].ancestors_first) {
        const auto j = static_cast<std::size_t>(a);
        t_->ancestors[i * t_->row + j / 64] |= std::uint64_t{1} << (j % 64);
      }
    }
    // Redeclarations name a supertype that has the attribute, not always the one that declares it.
    std::vector<std::size_t> next(n);
    for (const auto& l : later_) {
      auto& redeclared = t_->entities[static_cast<std::size_t>(l.in)].redeclared;
      redeclared[next[static_cast<std::size_t>(l.in)]++].attribute = declared(l.supertype, l.attribute);
    }
  }

  const Attribute* declared(std::string_view supertype, std::string_view attribute) const {
    const Type* type = named(supertype, supertype);
    if (type->kind != TypeKind::kEntity) malformed(supertype);
    for (const EntityId a : t_->entities[static_cast<std::size_t>(type->entity)].ancestors_first) {
      const Entity& e = t_->entities[static_cast<std::size_t>(a)];
      for (const Attribute& own : e.own) {
        if (own.name == attribute) return &own;
      }
      for (const Redeclaration& r : e.redeclared) {
        if (r.name == attribute && r.attribute != nullptr) return r.attribute;
      }
    }
    malformed(attribute);
  }

  void slots(Entity& e) {
    for (const EntityId id : e.ancestors_first) {
      const Entity& a = t_->entities[static_cast<std::size_t>(id)];
      for (const Attribute& own : a.own) e.slots.push_back({&own, own.name, own.type, own.optional, false});
    }
    for (const EntityId id : e.ancestors_first)
      redeclare(t_->entities[static_cast<std::size_t>(id)], e.slots);
  }

  // Computes the entities allowed where an entity or select is required.
  void admitted() {
    const std::size_t n = t_->entities.size();
    subtypes_.assign(n * t_->row, 0);
    for (std::size_t i = 0; i < n; ++i) {
      for (const EntityId a : t_->entities[i].ancestors_first)
        subtypes_[static_cast<std::size_t>(a) * t_->row + i / 64] |= std::uint64_t{1} << (i % 64);
    }
    for (Type& type : t_->types) {
      if (type.kind != TypeKind::kEntity && type.kind != TypeKind::kSelect) continue;
      tick(8);
      type.admitted.assign(t_->row, 0);
      std::vector<const Type*> stack{&type}, seen{&type};
      while (!stack.empty()) {
        const Type* t = stack.back();
        stack.pop_back();
        if (t->kind == TypeKind::kEntity) admit(type, static_cast<std::size_t>(t->entity));
        if (t->kind != TypeKind::kEntity && t->kind != TypeKind::kSelect) type.values.push_back(t);
        const Type* behind = t;
        while (behind->kind == TypeKind::kDefined) behind = behind->underlying;
        if (behind->kind != TypeKind::kSelect) continue;
        for (const Type* item : behind->items) {
          if (std::find(seen.begin(), seen.end(), item) != seen.end()) continue;
          seen.push_back(item);
          stack.push_back(item);
        }
      }
    }
  }

  void admit(Type& type, std::size_t ancestor) const {
    for (std::size_t w = 0; w < t_->row; ++w) type.admitted[w] |= subtypes_[ancestor * t_->row + w];
  }

  struct Later {
    EntityId in;
    std::string_view supertype, attribute;
  };

  std::unique_ptr<Dictionary::Tables> t_;
  std::vector<std::string_view> lines_;
  std::vector<Type*> own_;  // of each line
  std::vector<const Type*> basic_;
  std::vector<Later> later_;
  std::vector<std::uint64_t> subtypes_;  // as Tables::ancestors, the other way round: entity times subtype
};

}  // namespace

void Names::build(const std::vector<std::string_view>& names) {
  names_ = names;
  slots_.assign(std::bit_ceil(names.size() * 4 + 1), kNone);
  for (std::uint32_t i = 0; i < names.size(); ++i) {
    if (find(names[i]) != kNone) malformed(names[i]);
    std::size_t at = hash(names[i]) & (slots_.size() - 1);
    while (slots_[at] != kNone) at = (at + 1) & (slots_.size() - 1);
    slots_[at] = i;
  }
}

std::uint32_t Names::find(std::string_view name) const {
  std::size_t at = hash(name) & (slots_.size() - 1);
  while (slots_[at] != kNone && !same(names_[slots_[at]], name)) at = (at + 1) & (slots_.size() - 1);
  return slots_[at];
}

void redeclare(const Entity& e, std::vector<Slot>& slots) {
  for (const Redeclaration& r : e.redeclared) {
    for (Slot& s : slots) {
      if (s.attribute != r.attribute) continue;
      if (r.type == nullptr) {
        s.derived = true;
        continue;
      }
      s.name = r.name;
      s.type = r.type;
      s.optional = r.optional;
    }
  }
}

std::unique_ptr<Dictionary::Tables> Dictionary::Tables::load(std::string_view table) {
  return Loader(table).run();
}

}  // namespace capstan::exchange::express

#include "planner/files/exchange/conformance/values.h"

#include <algorithm>
#include <string_view>
#include <utility>
#include <vector>

namespace capstan::exchange::conformance {
namespace {

using express::Slot;
using express::Type;
using express::TypeKind;
using p21::Kind;
using p21::Value;

// Types of the schema may hold themselves; the parser bounds what a file may nest, this bounds us.
constexpr int kMaxDepth = 200;

const Type& behind(const Type& type) {
  const Type* t = &type;
  while (t->kind == TypeKind::kDefined) t = t->underlying;
  return *t;
}

std::string spelled(const Value& v) {
  constexpr std::size_t kLongest = 40;
  switch (v.kind()) {
    case Kind::kOmitted:
      return "$";
    case Kind::kDerived:
      return "*";
    case Kind::kList:
      return "a list of " + std::to_string(v.size());
    case Kind::kTyped:
      return std::string(v.keyword()) + "(" + (v[0].is(Kind::kList) ? "..." : spelled(v[0])) + ")";
    case Kind::kString:
      return "'" + v.as_text().substr(0, kLongest) + "'";
    case Kind::kEnumeration:
      return "." + std::string(v.lexeme().substr(0, kLongest)) + ".";
    case Kind::kBinary:
      return "\"" + std::string(v.lexeme().substr(0, kLongest)) + "\"";
    default:
      return std::string(v.lexeme().substr(0, kLongest));
  }
}

// Points of cross-section curves. ISO 10303-238 wants them in seven dimensions (edition 2, 4.2.379.4), and
// the schema's CARTESIAN_POINT has room for three: there, the text of the standard goes before its EXPRESS.
std::vector<bool> section_points(const Population& p) {
  const auto& schema = p.dictionary();
  const express::EntityId shown = schema.find("ACTION_PROPERTY_REPRESENTATION");
  std::vector<bool> out(p.file().size(), false);
  const auto parameter = [&](const p21::Instance& i, std::size_t k) {
    const Value list = i.parameters();
    return list.is(Kind::kList) && k < list.size() ? list[k] : Value{};
  };
  const auto follow = [&](const Value& v) {
    return v.is(Kind::kReference) ? p.file().find(v.reference()) : std::nullopt;
  };
  for (const p21::Instance i : p.file()) {
    const Layout* layout = p.layout(i.index());
    if (layout == nullptr || layout->complex || !p.is_a(*layout, shown)) continue;
    const auto property = follow(parameter(i, 2)), representation = follow(parameter(i, 3));
    if (!property || !representation) continue;
    const Value name = parameter(*property, 0), items = parameter(*representation, 1);
    if (!name.is(Kind::kString) || name.as_text().rfind("cross section area", 0) != 0 ||
        !items.is(Kind::kList))
      continue;
    for (std::size_t k = 0; k < items.size(); ++k) {
      const auto curve = follow(items[k]);
      const Value points = curve && curve->keyword() == "POLYLINE" ? parameter(*curve, 1) : Value{};
      for (std::size_t n = 0; points.is(Kind::kList) && n < points.size(); ++n) {
        if (const auto point = follow(points[n])) out[point->index()] = true;
      }
    }
  }
  return out;
}

// Checks one parameter. Its place is kept for messages only.
class Checker {
 public:
  Checker(const Population& population, Faults& faults)
      : p_(population), faults_(faults), section_points_(section_points(population)) {}

  void run() {
    for (std::size_t i = 0; i < p_.file().size(); ++i) {
      const Layout* layout = p_.layout(i);
      if (layout == nullptr) continue;
      const p21::Instance instance = p_.file().instance(i);
      at_ = &instance;
      for (const Fault& f : layout->faults) faults_.add(instance, f);
      for (std::size_t part = 0; part < layout->slots.size(); ++part) {
        if (layout->known[part]) parameters(instance.part(part), layout->slots[part]);
      }
    }
  }

 private:
  void fault(const char* code, const std::string& message, const std::string& expected = {}) {
    faults_.add(*at_, {code, message, slot_ == nullptr ? std::string() : std::string(slot_->name), expected});
  }
  bool silent(const char* code) {
    if (faults_.wanted(code)) return false;
    faults_.count(code);
    return true;
  }

  void parameters(const p21::Record& record, const std::vector<Slot>& slots) {
    slot_ = nullptr;
    if (record.parameters.size() != slots.size()) {
      std::string names;
      for (const Slot& s : slots) names.append(names.empty() ? "" : ", ").append(s.name);
      fault("SCH-COUNT",
            std::string(record.keyword) + " has " + std::to_string(record.parameters.size()) + " parameters",
            std::to_string(slots.size()) + (slots.empty() ? "" : " (" + names + ")"));
      return;
    }
    for (std::size_t i = 0; i < slots.size(); ++i) {
      slot_ = &slots[i];
      const Value v = record.parameters[i];
      if (slot_->derived) {
        if (!v.is(Kind::kDerived))
          fault("SCH-DERIVED", spelled(v) + " is written where the value is derived", "*");
      } else if (v.is(Kind::kOmitted)) {
        if (!slot_->optional) fault("SCH-MANDATORY", "a mandatory value is missing", describe(*slot_->type));
      } else {
        value(*slot_->type, v, 0);
      }
    }
    slot_ = nullptr;
  }

  void mismatch(const Type& type, const Value& v) {
    if (silent("SCH-TYPE")) return;
    fault("SCH-TYPE", spelled(v) + " has the wrong type", describe(type));
  }

  void value(const Type& named, const Value& v, int depth) {
    if (depth > kMaxDepth) return fault("SCH-TYPE", "values are nested too deeply");
    if (v.is(Kind::kOmitted)) return fault("SCH-MANDATORY", "$ is inside a value", describe(named));
    if (v.is(Kind::kDerived))
      return fault("SCH-DERIVED", "* is written where nothing is derived", describe(named));
    const Type& type = behind(named);
    switch (type.kind) {
      case TypeKind::kInteger:
        if (!v.is(Kind::kInteger)) return mismatch(named, v);
        return range(named, v);
      case TypeKind::kReal:
        if (!v.is(Kind::kReal)) return mismatch(named, v);
        return range(named, v);
      case TypeKind::kNumber:
        if (!v.is_number()) return mismatch(named, v);
        return range(named, v);
      case TypeKind::kString:
        if (!v.is(Kind::kString)) mismatch(named, v);
        return;
      case TypeKind::kBinary:
        if (!v.is(Kind::kBinary)) mismatch(named, v);
        return;
      case TypeKind::kBoolean:
      case TypeKind::kLogical:
        return truth(named, type, v);
      case TypeKind::kEnumeration:
        return enumerator(named, type, v);
      case TypeKind::kEntity:
        if (!v.is(Kind::kReference)) return mismatch(named, v);
        return reference(named, type, v);
      case TypeKind::kSelect:
        return select(named, type, v, depth);
      case TypeKind::kAggregate:
        return aggregate(named, type, v, depth);
      case TypeKind::kDefined:
        return;
    }
  }

  void range(const Type& named, const Value& v) {
    const double x = v.as_real();
    for (const Type* t = &named; t->kind == TypeKind::kDefined; t = t->underlying) {
      if (t->range && !t->range->holds(x))
        return fault("SCH-BOUNDS", spelled(v) + " is outside the range of " + std::string(t->name),
                     describe(named));
    }
  }

  void truth(const Type& named, const Type& type, const Value& v) {
    if (!v.is(Kind::kEnumeration)) return mismatch(named, v);
    const std::string_view text = v.enumeration();
    if (text == "T" || text == "F" || (text == "U" && type.kind == TypeKind::kLogical)) return;
    fault("SCH-ENUM", spelled(v) + " is neither true nor false", describe(named));
  }

  void enumerator(const Type& named, const Type& type, const Value& v) {
    if (!v.is(Kind::kEnumeration)) return mismatch(named, v);
    const auto& all = type.enumerators;
    if (std::find(all.begin(), all.end(), v.enumeration()) != all.end()) return;
    fault("SCH-ENUM", spelled(v) + " is not a value of " + std::string(type.name), describe(named));
  }

  void reference(const Type& named, const Type& type, const Value& v) {
    const std::uint64_t id = v.reference();
    const auto target = p_.file().find(id);
    if (!target) {
      const auto& external = p_.file().external_ids();
      if (!std::binary_search(external.begin(), external.end(), id))
        fault("SCH-REFERENCE", "there is no instance #" + std::to_string(id), describe(named));
      return;
    }
    const Layout* layout = p_.layout(target->index());
    // An unknown entity has its own fault.
    if (layout == nullptr || layout->parts.empty() || p_.admits(type, *layout) || silent("SCH-TYPE")) return;
    std::string what(p_.dictionary().keyword(layout->parts.front()));
    if (layout->complex) {
      what.clear();
      for (const auto e : layout->parts)
        what.append(what.empty() ? "(" : " ").append(p_.dictionary().keyword(e));
      what += ")";
    }
    fault("SCH-TYPE", spelled(v) + " is a " + what, describe(named));
  }

  void select(const Type& named, const Type& type, const Value& v, int depth) {
    if (v.is(Kind::kReference)) return reference(named, type, v);
    if (!v.is(Kind::kTyped)) {
      if (silent("SCH-TYPE")) return;
      return fault("SCH-TYPE", spelled(v) + " does not say which type of the select it has", describe(named));
    }
    for (const Type* item : type.values) {
      if (item->name == v.keyword()) return value(*item, v[0], depth + 1);
    }
    mismatch(named, v);
  }

  void aggregate(const Type& named, const Type& type, const Value& v, int depth) {
    if (!v.is(Kind::kList)) return mismatch(named, v);
    const bool section =
        v.size() == 7 && section_points_[at_->index()] && at_->keyword() == "CARTESIAN_POINT";
    if ((v.size() < type.lower || v.size() > type.upper) && !section)
      fault("SCH-BOUNDS", "there are " + std::to_string(v.size()) + " elements", describe(named));
    for (std::size_t i = 0; i < v.size(); ++i) {
      const Value element = v[i];
      if (element.is(Kind::kOmitted) && type.optional_elements) continue;
      value(*type.underlying, element, depth + 1);
    }
    if (type.unique && v.size() > 1) unique(v);
  }

  // Numbers by value, other simple kinds by spelling.
  void unique(const Value& v) {
    std::vector<std::pair<double, std::string_view>> seen;
    seen.reserve(v.size());
    for (std::size_t i = 0; i < v.size(); ++i) {
      const Value e = v[i].is(Kind::kTyped) ? v[i][0] : v[i];
      if (e.is_number())
        seen.emplace_back(e.as_real(), v[i].is(Kind::kTyped) ? v[i].keyword() : std::string_view());
      else if (e.is(Kind::kReference))
        seen.emplace_back(0.0, e.lexeme());
      else if (e.is(Kind::kString) || e.is(Kind::kEnumeration))
        seen.emplace_back(1.0, e.lexeme());
    }
    std::sort(seen.begin(), seen.end());
    const auto twice = std::adjacent_find(seen.begin(), seen.end());
    if (twice == seen.end()) return;
    fault("SCH-BOUNDS",
          (twice->second.empty() ? std::string("a number") : std::string(twice->second)) + " is there twice",
          "no element twice");
  }

  const Population& p_;
  Faults& faults_;
  std::vector<bool> section_points_;
  const p21::Instance* at_ = nullptr;
  const Slot* slot_ = nullptr;
};

const char* plain(TypeKind kind) {
  switch (kind) {
    case TypeKind::kInteger:
      return "integer";
    case TypeKind::kReal:
      return "real";
    case TypeKind::kNumber:
      return "number";
    case TypeKind::kString:
      return "string";
    case TypeKind::kBoolean:
      return "boolean";
    case TypeKind::kLogical:
      return "logical";
    case TypeKind::kBinary:
      return "binary";
    default:
      return "";
  }
}

std::string list_of(const std::vector<std::string_view>& names) {
  constexpr std::size_t kShown = 8;
  std::string out;
  for (std::size_t i = 0; i < std::min(names.size(), kShown); ++i)
    out.append(i == 0 ? "" : ", ").append(names[i]);
  if (names.size() > kShown) out += ", and " + std::to_string(names.size() - kShown) + " more";
  return out;
}

std::string bounds(const Type& type) {
  if (type.lower == type.upper) return std::to_string(type.lower);
  if (type.upper != Type::kUnbounded) return std::to_string(type.lower) + " to " + std::to_string(type.upper);
  return type.lower == 0 ? "any number" : std::to_string(type.lower) + " or more";
}

}  // namespace

void check_values(const Population& population, Faults& faults) { Checker(population, faults).run(); }

std::string describe(const Type& type) {
  static constexpr const char* kAggregates[] = {"list", "set", "bag", "array"};
  switch (type.kind) {
    case TypeKind::kEnumeration:
      return "one of " + list_of(type.enumerators);
    case TypeKind::kEntity:
      return std::string(type.name);
    case TypeKind::kSelect: {
      std::vector<std::string_view> names;
      for (const Type* item : type.items) names.push_back(item->name);
      return std::string(type.name) + ": " + list_of(names);
    }
    case TypeKind::kAggregate:
      return std::string("a ") + kAggregates[static_cast<std::size_t>(type.aggregate)] + " of " +
             bounds(type) + ": " + describe(*type.underlying);
    case TypeKind::kDefined: {
      std::string range;
      for (const Type* t = &type; t->kind == TypeKind::kDefined; t = t->underlying) {
        if (t->range && range.empty()) range = " in " + t->range->text();
      }
      const Type& t = behind(type);
      const std::string under = *plain(t.kind) != '\0' ? plain(t.kind) : describe(t);
      return std::string(type.name) + " (" + under + range + ")";
    }
    default:
      return plain(type.kind);
  }
}

}  // namespace capstan::exchange::conformance

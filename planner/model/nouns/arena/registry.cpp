#include <algorithm>
#include <array>
#include <bitset>
#include <map>
#include <stdexcept>
#include <string>
#include <vector>

#include "planner/model/nouns/arena/attribute.h"
#include "planner/model/nouns/arena/kept.h"
#include "planner/model/nouns/descriptors/registry.h"

namespace capstan::model {
namespace {

/// The table with inherited attributes put in front, built once from the rows.
class Registry {
 public:
  Registry() {
    rows_[index(TypeId::kKeptInstance)] = NounRow{.type = TypeId::kKeptInstance,
                                                  .keyword = "KEPT_INSTANCE",
                                                  .parent = TypeId::kNone,
                                                  .abstract = false,
                                                  .in_iso14649 = true,
                                                  .own = {}};
    for (const auto rows : noun_rows()) {
      for (const NounRow& row : rows) rows_[index(row.type)] = row;
    }
    for (std::size_t i = 1; i < kTypeCount; ++i) {
      const NounRow& row = rows_[i];
      if (row.keyword.empty()) throw std::logic_error("a kind of object has no row in the descriptor table");
      collect(row.type, attributes_[i]);
      types_[i] = {row.keyword, row.parent, row.abstract, row.in_iso14649, attributes_[i]};
      by_keyword_.emplace(row.keyword, row.type);
      for (TypeId at = row.type; at != TypeId::kNone; at = rows_[index(at)].parent) is_a_[i].set(index(at));
    }
  }

  [[nodiscard]] const NounType& type(TypeId t) const { return types_[index(t)]; }
  [[nodiscard]] bool is_a(TypeId t, TypeId ancestor) const { return is_a_[index(t)][index(ancestor)]; }
  [[nodiscard]] std::optional<TypeId> find(std::string_view keyword) const {
    const auto it = by_keyword_.find(keyword);
    if (it == by_keyword_.end()) return std::nullopt;
    return it->second;
  }

 private:
  static std::size_t index(TypeId t) { return static_cast<std::size_t>(t); }

  void collect(TypeId t, std::vector<Attribute>& out) const {
    std::vector<TypeId> chain;
    for (TypeId at = t; at != TypeId::kNone; at = rows_[index(at)].parent) chain.push_back(at);
    std::reverse(chain.begin(), chain.end());
    for (const TypeId at : chain) {
      for (const Attribute& a : rows_[index(at)].own) out.push_back(a);
    }
  }

  std::array<NounRow, kTypeCount> rows_{};
  std::array<std::vector<Attribute>, kTypeCount> attributes_;
  std::array<NounType, kTypeCount> types_{};
  std::array<std::bitset<kTypeCount>, kTypeCount> is_a_;  ///< by kind: the kind and those above it
  std::map<std::string_view, TypeId> by_keyword_;
};

const Registry& registry() {
  static const Registry kRegistry;
  return kRegistry;
}

}  // namespace

const NounType& noun_type(TypeId t) {
  if (t == TypeId::kNone || t >= TypeId::kCount) throw std::logic_error("no such kind of object");
  static const Registry& kRegistry = registry();  // asked for each reference of each file: no call
  return kRegistry.type(t);
}

std::optional<TypeId> find_noun(std::string_view keyword) { return registry().find(keyword); }

bool is_a(TypeId t, TypeId ancestor) {
  static const Registry& kRegistry = registry();  // as above
  return kRegistry.is_a(t, ancestor);
}

const Attribute* find_attribute(TypeId t, std::string_view name) {
  for (const Attribute& a : noun_type(t).attributes) {
    if (a.name == name) return &a;
  }
  return nullptr;
}

std::string_view symbol(Unit u) {
  switch (u) {
    case Unit::kNone:
      return "";
    case Unit::kLength:
      return "mm";
    case Unit::kAngle:
      return "rad";
    case Unit::kSpeed:
      return "mm/min";
    case Unit::kRotSpeed:
      return "1/min";
    case Unit::kTime:
      return "s";
    case Unit::kRatio:
      return "1";
    case Unit::kPressure:
      return "N/mm2";
    case Unit::kVolume:
      return "mm3";
    case Unit::kPower:
      return "W";
    case Unit::kTorque:
      return "Nm";
  }
  return "";
}

double iso14649_factor(Unit u) {
  switch (u) {
    case Unit::kSpeed:
      return 60000.0;  // m/s -> mm/min
    case Unit::kRotSpeed:
      return 60.0;  // rev/s -> 1/min
    case Unit::kAngle:
      return 0.017453292519943295;  // degrees -> rad
    default:
      return 1.0;
  }
}

}  // namespace capstan::model

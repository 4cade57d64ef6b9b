#pragma once

#include <cstdint>
#include <deque>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "planner/files/exchange/express/dictionary.h"

/// How a Dictionary is kept; for the files of this folder alone.
namespace capstan::exchange::express {

/// Names in any case to small numbers; open addressing.
class Names {
 public:
  static constexpr std::uint32_t kNone = 0xFFFFFFFF;
  /// `names` in upper case; the i-th gets number i. Throws std::logic_error when one is there twice.
  void build(const std::vector<std::string_view>& names);
  [[nodiscard]] std::uint32_t find(std::string_view name) const;

 private:
  std::vector<std::string_view> names_;
  std::vector<std::uint32_t> slots_;  ///< number, or kNone; the size is a power of two
};

/// SELF\supertype.attribute in an entity.
struct Redeclaration {
  const Attribute* attribute = nullptr;
  std::string_view name;       ///< renamed to, or the attribute's
  const Type* type = nullptr;  ///< null when derived
  bool optional = false;
};

struct Entity {
  std::string_view keyword;
  bool abstract = false;
  std::vector<EntityId> supertypes;
  std::vector<Attribute> own;
  std::vector<Redeclaration> redeclared;
  std::vector<std::vector<EntityId>> exclusive;  ///< ONEOF groups of subtypes
  std::vector<EntityId>
      ancestors_first;  ///< all supertypes in the order of the internal mapping, and itself last
  std::vector<Slot> slots;
};

struct Dictionary::Tables {
  static std::unique_ptr<Tables> load(std::string_view table);

  std::string lower, upper;  ///< the table; names are views into them
  std::vector<Entity> entities;
  std::deque<Type> types;
  std::vector<const Type*> named;  ///< by number in `names`: of entities first, then of other names
  Names names;
  std::vector<std::uint64_t> ancestors;  ///< a bit matrix: entity times ancestor
  std::size_t row = 0;                   ///< its words per entity
};

/// Applies what `e` redeclares to those of the slots that it concerns.
void redeclare(const Entity& e, std::vector<Slot>& slots);

}  // namespace capstan::exchange::express

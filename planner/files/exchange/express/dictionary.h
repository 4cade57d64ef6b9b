#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

/// An EXPRESS schema as the rules for instances of an exchange file: entities, their attributes, and the
/// types allowed there.
namespace capstan::exchange::express {

/// An entity of the dictionary. Ids follow the alphabet of the keywords, as the parts of a complex instance
/// do.
enum class EntityId : std::uint16_t {};
inline constexpr EntityId kNoEntity{0xFFFF};

enum class TypeKind : std::uint8_t {
  kInteger,
  kReal,
  kNumber,  ///< integer or real
  kString,
  kBoolean,
  kLogical,
  kBinary,
  kEnumeration,
  kEntity,
  kDefined,  ///< a name for another type, e.g. LENGTH_MEASURE for a real
  kSelect,
  kAggregate,
};
enum class AggregateKind : std::uint8_t { kList, kSet, kBag, kArray };

/// The numbers that a WHERE rule of a defined type allows.
struct Range {
  double lower, upper;  ///< infinite where open to that side
  bool lower_included, upper_included;
  std::string_view spelling;  ///< "[0,24)"

  [[nodiscard]] bool holds(double x) const {
    return (lower_included ? x >= lower : x > lower) && (upper_included ? x <= upper : x < upper);
  }
  [[nodiscard]] std::string text() const { return std::string(spelling); }
};

/// The type of an attribute, an element or a select item.
struct Type {
  static constexpr std::size_t kUnbounded = static_cast<std::size_t>(-1);

  TypeKind kind = TypeKind::kInteger;
  std::string_view name = {};        ///< of entities, defined types, selects, enumerations; upper case
  EntityId entity = kNoEntity;       ///< of kEntity
  const Type* underlying = nullptr;  ///< of kDefined; of kAggregate: what the elements are
  AggregateKind aggregate = AggregateKind::kList;
  std::size_t lower = 0, upper = kUnbounded;    ///< number of elements (an array's bounds are turned into it)
  bool unique = false;                          ///< no element twice; true for sets
  bool optional_elements = false;               ///< of arrays: elements may be $
  std::vector<std::string_view> enumerators{};  ///< upper case
  std::vector<const Type*> items{};             ///< of kSelect: as declared, selects among them
  std::vector<const Type*> values{};      ///< of kSelect: all that is not an entity, through nested selects
  std::vector<std::uint64_t> admitted{};  ///< of kSelect, kEntity: bit per entity, subtypes included
  std::optional<Range> range{};           ///< of kDefined numbers
};

/// An explicit attribute, where it is declared.
struct Attribute {
  std::string_view name;  ///< lower case
  EntityId owner = kNoEntity;
  const Type* type = nullptr;
  bool optional = false;
};

/// One parameter of an instance, as the entity (or one of its supertypes) redeclares it.
struct Slot {
  const Attribute* attribute = nullptr;
  std::string_view name;  ///< the attribute's, or what a redeclaration renamed it to
  const Type* type = nullptr;
  bool optional = false;
  bool derived = false;  ///< the parameter is *
};

/// The entities and types of one schema.
///
/// Source         ISO 10303-238:2020 (edition 3), long form of the AIM, and edition4.exp; table made by
/// generate.py. Thread safety  immutable; members may be called from any number of threads. Views live as
/// long as the program.
class Dictionary {
 public:
  /// MODEL_BASED_INTEGRATED_MANUFACTURING_SCHEMA, of which INTEGRATED_CNC_SCHEMA is a subset. Built once.
  static const Dictionary& ap238();
  /// From a table in the form of generate.py; throws std::logic_error if it is malformed.
  explicit Dictionary(std::string_view table);
  ~Dictionary();
  Dictionary(const Dictionary&) = delete;
  Dictionary& operator=(const Dictionary&) = delete;

  struct Tables;  ///< how it is kept

  [[nodiscard]] std::size_t size() const;  ///< ids are 0 ... size() - 1
  /// Upper or lower case; kNoEntity if there is none. One hash and one comparison.
  [[nodiscard]] EntityId find(std::string_view keyword) const;
  /// A defined type, select or enumeration by its name, any case; null if there is none.
  [[nodiscard]] const Type* find_type(std::string_view name) const;
  [[nodiscard]] std::string_view keyword(EntityId e) const;  ///< upper case
  [[nodiscard]] bool abstract(EntityId e) const;
  /// Whether e is `ancestor` or a subtype of it. One bit looked up; false for kNoEntity.
  [[nodiscard]] bool is_a(EntityId e, EntityId ancestor) const;
  /// True if a reference to an instance of e is allowed where `type` (entity, select, or a name for one) is
  /// required.
  [[nodiscard]] bool admits(const Type& type, EntityId e) const;

  /// Groups of its subtypes of which an instance may be only one (ONEOF).
  [[nodiscard]] std::span<const std::vector<EntityId>> exclusive(EntityId e) const;

  /// The leaves and all their supertypes, in alphabetical order: the parts of an external mapping.
  [[nodiscard]] std::vector<EntityId> closure(std::span<const EntityId> leaves) const;
  /// Declared here, in order, without redeclarations: the parameters of this part of an external mapping.
  [[nodiscard]] std::span<const Attribute> own(EntityId e) const;
  /// The parameters of an instance of e (internal mapping): those of its supertypes in the order of SUBTYPE
  /// OF, each supertype once, then its own.
  [[nodiscard]] std::span<const Slot> slots(EntityId e) const;
  /// The parameters of `part` in a complex instance of `parts`, with what the other parts redeclare.
  [[nodiscard]] std::vector<Slot> part_slots(EntityId part, std::span<const EntityId> parts) const;
  /// Position of an attribute in slots(e). `attribute` in lower case, alone (the first of that name) or as
  /// "shape_aspect.name" if several supertypes have one of that name.
  [[nodiscard]] std::optional<std::size_t> position(EntityId e, std::string_view attribute) const;
  /// The entity, e or a supertype, that declares the attribute at position(e, attribute); kNoEntity if none
  /// does.
  [[nodiscard]] EntityId owner(EntityId e, std::string_view attribute) const;

 private:
  const Tables* tables_;
};

}  // namespace capstan::exchange::express

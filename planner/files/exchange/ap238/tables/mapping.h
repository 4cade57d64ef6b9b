#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "planner/files/exchange/express/dictionary.h"
#include "planner/model/nouns/arena/attribute.h"

/// @file The mapping between application objects and the instances of ISO 10303-238, as data. The tables are
/// the files of `mapping/`; their language is described in mapping/README.md. Reader and writer interpret
/// the same rows.

namespace capstan::exchange::ap238 {

using express::EntityId;

/// `attribute = value` (demanded when reading, set when writing) or `attribute := value` (only set). A
/// demanded
/// `@name` must be an instance such as the shared one.
struct Constraint {
  enum class Kind : std::uint8_t { kPlain, kShared, kOrdinal, kDescription };
  std::string attribute;  ///< lower case, may be qualified: "shape_aspect.name"
  bool demanded = false;
  bool negated = false;   ///< `!=`: demanded not to be so; never set
  bool fallback = false;  ///< `?=`: set in the end, where nothing else has set it
  Kind kind = Kind::kPlain;
  std::vector<std::string> texts;  ///< Part 21 spellings that do; the first is written. kShared: its name
};

/// From one instance to the next: along an attribute, or against one.
struct Step {
  bool inverse = false;
  bool fan = false;                     ///< one per element of the list
  bool own = false;                     ///< not shared with other attributes of the object
  bool exact = false;                   ///< of this very entity, no subtype and no complex instance
  EntityId owner = express::kNoEntity;  ///< inverse: what holds the attribute
  std::string attribute;
  std::uint32_t index = 0;         ///< forward: only this element of the list, from 1; 0: any
  std::string wrapper;             ///< typed parameter around the list, e.g. LIST_REPRESENTATION_ITEM
  std::vector<EntityId> entities;  ///< entities at this step: one, or the leaves of a complex instance
  std::vector<EntityId> also;      ///< entities accepted there instead when reading
  std::vector<Constraint> constraints;
  std::uint32_t prefix = 0;  ///< identifies the way up to here, the same for rows that share it
};

struct Row {
  model::TypeId noun = model::TypeId::kNone;
  std::vector<std::string> attribute;  ///< "its_tool_body.dimension.diameter"; empty: structure without value
  /// For each of them but the last: what is made there when the path finds something; kNone: nothing.
  std::vector<model::TypeId> made;
  /// For each of them but the last: the required kind, else the row is skipped; kNone: any.
  std::vector<model::TypeId> only;
  std::vector<Step> steps;
  std::string value_of;            ///< the value is this attribute of the last instance
  std::vector<std::string> texts;  ///< spelling of true and false, or of each enumerator
  std::string codec;               ///< a value that needs code, by name
  std::string when;                ///< writes only values of this form: text, real, ref, or a noun
  std::string unless;              ///< written only where this attribute of the same object is unset
  bool written = true;             ///< false: an older or other form, read only
  std::string place;               ///< "operation.map:12", for messages and tests
};

struct ObjectRow {
  model::TypeId noun = model::TypeId::kNone;
  Step root;                ///< entities and constraints
  std::vector<Step> guard;  ///< what must be there for an instance to be this
  std::vector<std::pair<std::vector<std::string>, model::TypeId>> with;  ///< objects inside, made with it
  std::vector<std::string> unless;  ///< dotted attribute that must be unset to write so
  std::vector<std::pair<std::vector<std::string>, model::TypeId>>
      when;  ///< attributes and their required kinds for writing this row
  bool written = true;
  std::string place;
};

struct SharedRow {
  std::string name;
  Step root;
};

class Mapping {
 public:
  /// The tables of the program, parsed once. Throws std::logic_error when one of them is wrong.
  static const Mapping& instance();
  /// Of tables given as (name, text). For tests.
  explicit Mapping(std::span<const std::pair<std::string, std::string>> tables);

  [[nodiscard]] std::span<const ObjectRow> objects() const { return objects_; }
  /// Rows for which an instance of that entity may be the root, in order; indices into objects().
  [[nodiscard]] std::span<const std::uint32_t> objects_at(EntityId e) const;
  /// Rows by which a noun is written, in order; indices into objects().
  [[nodiscard]] std::span<const std::uint32_t> objects_of(model::TypeId t) const;
  /// Rows of a noun and of what it is derived from, in order.
  [[nodiscard]] std::span<const Row* const> rows_of(model::TypeId t) const;
  [[nodiscard]] std::span<const Row> rows() const { return rows_; }
  [[nodiscard]] const SharedRow* shared(std::string_view name) const;
  [[nodiscard]] std::string_view prefix_text(std::uint32_t prefix) const { return prefixes_[prefix]; }

 private:
  friend class Parser;
  Mapping() = default;
  void index();
  std::vector<ObjectRow> objects_;
  std::vector<Row> rows_;
  std::vector<SharedRow> shared_;
  std::vector<std::string> prefixes_;
  std::vector<std::vector<std::uint32_t>> at_, of_;
  std::vector<std::vector<const Row*>> rows_of_;
};

}  // namespace capstan::exchange::ap238

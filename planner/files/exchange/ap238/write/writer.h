#pragma once

#include <deque>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <unordered_map>
#include <vector>

#include "planner/files/exchange/ap238/tables/mapping.h"
#include "planner/files/exchange/records/seal.h"
#include "planner/model/plan/plan.h"

namespace capstan::exchange::ap238 {

struct Unlisted;  // placement.h

/// An instance being written, by its number.
using Id = std::uint32_t;
inline constexpr Id kNoId = 0;

/// Numbers of instances by object: there may be millions of points.
class IdsOfObjects {
 public:
  /// Nothing: not met yet.
  [[nodiscard]] std::optional<Id> find(model::AnyRef at) const {
    const auto type = static_cast<std::size_t>(at.type);
    if (type >= of_type_.size() || at.index >= of_type_[type].size()) return std::nullopt;
    const Id id = of_type_[type][at.index];
    return id == kNotMet ? std::nullopt : std::optional(id);
  }
  void set(model::AnyRef at, Id id) {
    const auto type = static_cast<std::size_t>(at.type);
    if (type >= of_type_.size()) of_type_.resize(type + 1);
    if (at.index >= of_type_[type].size()) of_type_[type].resize(std::size_t{at.index} + 1, kNotMet);
    of_type_[type][at.index] = id;
  }

 private:
  static constexpr Id kNotMet = 0xFFFFFFFF;
  std::vector<std::vector<Id>> of_type_;
};

/// Builds the instances of a plan by the rows of the mapping, then prints them. One per file.
class Writer {
 public:
  Writer(const model::Plan& plan, const Mapping& mapping, std::vector<std::string>& losses);

  /// Makes the instances. `unlisted`: what `to_ap238` gave.
  void run(const std::vector<Unlisted>& unlisted);
  /// After run(), once: appends the data section, one instance per line, and lists what is lost. `sealed`
  /// gets the points and the lines through them, which are printed as seals spell them (records/seal.h);
  /// `unsealed` the text of the others.
  void print(std::string& out, Seals& sealed, std::string& unsealed);
  /// After run(): about how many bytes `print` will append.
  [[nodiscard]] std::size_t bytes() const;
  /// After run(): the file's reference to an object, "$" if it has none.
  [[nodiscard]] std::string reference_text(model::AnyRef r);

  // Access for codecs.
  [[nodiscard]] const model::Model& model() const { return m_; }
  [[nodiscard]] const model::Plan& plan() const { return plan_; }
  [[nodiscard]] const express::Dictionary& schema() const { return schema_; }
  /// The instance of an application object, geometry or kept instance; its rows are written later.
  /// kNoId when AP238 has no place for it (and it is listed as lost).
  Id instance_of(model::AnyRef at);
  /// Geometry under the name that its role demands ("'orientation'").
  Id instance_named(model::AnyRef at, const std::string& name);
  /// A new instance; attributes unset.
  Id make(std::vector<EntityId> leaves);
  Id make(std::string_view entity);  ///< "a&b" for a complex one
  Id shared(std::string_view name);
  /// Sets an attribute to a spelling ("'text'", ".T.", "#12"); appends to an aggregate.
  void set(Id at, std::string_view attribute, std::string spelling);
  /// Makes an instance something more: another leaf of a complex instance, or a subtype of what it is.
  void become(Id at, std::string_view entity);
  /// Makes an instance another entity, one that has the attributes set so far.
  void turn_into(Id at, std::string_view entity);
  /// A text as it is spelled.
  [[nodiscard]] static std::string quoted(std::string_view text);
  void link(Id from, std::string_view attribute, Id to) { set(from, attribute, "#" + std::to_string(to)); }
  /// Follows the row's steps from the object's instance and returns the last instance but `leave` steps.
  Id walk(const Row& row, model::AnyRef owner, Id root, std::size_t leave, std::uint32_t ordinal);
  /// Connects the target of the row's last step.
  void connect(const Step& last, Id from, Id to, std::uint32_t ordinal, model::AnyRef owner);
  /// A measure with unit as a representation item.
  Id measure(double value, model::Unit unit, std::string_view name, std::span<const EntityId> entities);
  Id description(std::string_view name, std::string_view text);
  void lose(const std::string& what) { ++lost_[what]; }
  /// The instance of a written object; kNoId for others, and for objects without an instance of their own.
  [[nodiscard]] Id written(model::AnyRef at) const;
  /// Whether AP238 has no place for the object.
  [[nodiscard]] bool is_lost(model::AnyRef at) const;

 private:
  struct Value {
    const express::Attribute* attribute;
    bool aggregate = false;
    std::string wrapper;
    std::vector<std::string> items;
  };
  struct Made {
    std::vector<EntityId> leaves;  ///< empty: `noun` is written as it is
    model::AnyRef noun;
    std::string name;  ///< of geometry whose role fixes it, as spelled; else empty
    std::vector<Value> values;
  };
  static constexpr std::uint32_t kAsItIs = 0xFFFFFFFF;
  /// An instance: one of `made_`, or a noun that is written as it is, of which there may be millions.
  struct Instance {
    std::uint32_t made = kAsItIs;
    model::AnyRef noun;
  };
  Id add(Made made);
  Id add_as_it_is(model::AnyRef noun);
  void skip_reserved();
  [[nodiscard]] Made& made_of(Id at);
  struct MemoKey {
    model::AnyRef owner;
    std::uint32_t prefix, ordinal;
    std::uint32_t copy = 0;  ///< of an object that is written more than once
    friend auto operator<=>(const MemoKey&, const MemoKey&) = default;
  };
  struct Task {
    model::AnyRef at;
    Id root;
    std::uint32_t copy = 0;
  };

  [[nodiscard]] const ObjectRow* object_row(model::AnyRef at) const;
  void begin(model::AnyRef at, const ObjectRow& row, Id id, std::uint32_t copy);
  [[nodiscard]] bool is_taken(Id at, std::string_view attribute, Id by) const;
  Id copy_of(model::AnyRef at);
  void write_rows(const Task& t);
  void write_value(const Row& row, model::AnyRef owner, const model::Attribute& a, const void* data, Id root);
  void write_reference(const Row& row, model::AnyRef owner, model::AnyRef to, Id root, std::uint32_t ordinal);
  void write_leaf(const Row& row, model::AnyRef owner, Id root, std::uint32_t ordinal, Id leaf);
  /// What all objects of a kind that is written as its entity of geometry have in common.
  struct Geometry {
    bool plain = false;  ///< the kind is written so, and no row says otherwise
    EntityId entity;     ///< kNoEntity: AP238 has none
    bool refers = false;
    bool of_points = false;   ///< texts, numbers and references only
    bool of_numbers = false;  ///< a name and one more attribute, without references
    struct Slot {
      bool derived = false, name = false;
      const model::Attribute* attribute = nullptr;
      std::string nothing;  ///< is written where there is no value
    };
    std::vector<Slot> slots;
  };
  [[nodiscard]] const Geometry& geometry_of(model::TypeId type);
  [[nodiscard]] static bool is_geometry(model::AnyRef at);
  void require(model::AnyRef at);
  [[nodiscard]] std::string resolved(const std::string& spelling);
  void write_text(const Row& row, model::AnyRef owner, Id root, std::uint32_t ordinal,
                  const std::string& text);
  void write_measure(const Row& row, model::AnyRef owner, Id root, std::uint32_t ordinal, double v,
                     model::Unit u);
  void constrain(Id at, const std::vector<Constraint>& constraints, std::uint32_t ordinal,
                 model::AnyRef owner);
  void fall_back();
  void note_unmapped(model::AnyRef at, const ObjectRow* row);
  Id unit(model::Unit u);
  void print(const Made& made, std::string& out);
  void print_as_it_is(model::AnyRef noun, const std::string& name, std::string& out);
  void print_geometry(model::AnyRef at, const std::string& name, std::string& out);
  [[nodiscard]] char* print_numbers(model::AnyRef noun, const Geometry& geometry, char* to) const;
  void append_references(const std::vector<model::AnyRef>& items, std::string& out);
  void append_attribute(const model::Attribute& a, const void* data, std::string& out);
  void print_kept(const model::KeptInstance& kept, std::string& out);
  [[nodiscard]] std::string slot_text(const Made& made, const express::Slot& slot) const;
  [[nodiscard]] std::string select_text(const model::SelectValue& v);
  [[nodiscard]] std::string attribute_text(const model::Attribute& a, const void* data);

  const model::Plan& plan_;
  const model::Model& m_;
  const Mapping& map_;
  const express::Dictionary& schema_;
  std::vector<std::string>& losses_;
  std::deque<Made> made_;
  std::set<std::uint64_t> reserved_;  ///< numbers that kept text mentions and no instance has
  IdsOfObjects ids_;
  std::map<model::TypeId, Geometry> geometry_;
  std::map<std::pair<model::AnyRef, std::string>, Id> named_;
  std::map<model::AnyRef, std::string> descriptions_;
  std::map<MemoKey, Id> memo_;
  std::map<std::string_view, std::uint32_t> prefix_of_text_;
  std::map<std::string, Id, std::less<>> shared_;
  std::map<model::Unit, Id> units_;
  std::deque<Task> tasks_;
  std::uint32_t copy_ = 0;  ///< which copy of its object is being written; 0: the first
  std::uint32_t copies_ = 0;
  std::vector<std::pair<Id, const Constraint*>> fallbacks_;
  std::deque<model::AnyRef> to_scan_;
  std::map<std::string, std::size_t> lost_;
  std::vector<Instance> instances_;                            ///< by number, from 1
  std::pair<model::TypeId, const Geometry*> geometry_before_;  ///< that was asked for last
};

}  // namespace capstan::exchange::ap238

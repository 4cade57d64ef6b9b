#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "planner/ground/vocabulary/noun_kind.h"

namespace capstan::model {

struct Noun {};       ///< the root of every application object
struct CutterPath;    // columnar geometry, planner/model/plan/cutter_path.h
struct KeptInstance;  // planner/model/nouns/arena/kept.h

/// A handle to an application object of any kind: which arena, which slot. Unset by default.
struct AnyRef {
  TypeId type = TypeId::kNone;
  std::uint32_t index = 0;
  [[nodiscard]] bool set() const { return type != TypeId::kNone; }
  explicit operator bool() const { return set(); }
  friend auto operator<=>(const AnyRef&, const AnyRef&) = default;
};

/// A handle to a T or something derived from it. `Model::get` turns it into an object.
template <class T>
struct Ref : AnyRef {
  Ref() = default;
  explicit Ref(AnyRef r) : AnyRef(r) {}
  template <class U>
  requires std::is_base_of_v<T, U> Ref(Ref<U> other)
      : AnyRef(other) {}  // NOLINT: upcasts are safe and wanted
};

/// A handle to one of several kinds: an EXPRESS select of entities.
template <class... Ts>
struct OneOf : AnyRef {
  OneOf() = default;
  explicit OneOf(AnyRef r) : AnyRef(r) {}
  template <class U>
  requires(std::is_base_of_v<Ts, U> || ...) OneOf(Ref<U> other)
      : AnyRef(other) {}  // NOLINT: upcasts are safe and wanted
};

/// A select that may also be a plain value: trimming_select, toolpath_speedprofile.
/// Exactly one of: ref set; real set (`type` names the measure, e.g. "PARAMETER_VALUE"); text (an
/// enumerator).
struct SelectValue {
  AnyRef ref;
  std::string type;
  std::optional<double> real;
  std::string text;
  [[nodiscard]] bool set() const { return ref.set() || real.has_value() || !text.empty(); }
  friend bool operator==(const SelectValue&, const SelectValue&) = default;
};

/// The type-erased half of an enumeration attribute: -1 is absent.
struct AnyEnum {
  std::int8_t code = -1;
  [[nodiscard]] bool set() const { return code >= 0; }
  friend bool operator==(AnyEnum, AnyEnum) = default;
};
template <class E>
struct Enumerated : AnyEnum {
  Enumerated() = default;
  Enumerated(E e) : AnyEnum{static_cast<std::int8_t>(e)} {}  // NOLINT: meant to read as the enumerator
  [[nodiscard]] E value() const { return static_cast<E>(code); }
  [[nodiscard]] E value_or(E other) const { return set() ? value() : other; }
  friend bool operator==(Enumerated a, E b) { return a.set() && a.value() == b; }
};

/// Lists know whether they were given at all: `()` is empty, `$` is absent.
struct AnyRefList {
  std::vector<AnyRef> items;
  bool given = false;
  [[nodiscard]] std::size_t size() const { return items.size(); }
  [[nodiscard]] bool empty() const { return items.empty(); }
  friend bool operator==(const AnyRefList&, const AnyRefList&) = default;
};
template <class T>
struct RefList : AnyRefList {
  void push_back(Ref<T> r) {
    items.push_back(r);
    given = true;
  }
  [[nodiscard]] Ref<T> operator[](std::size_t i) const { return Ref<T>(items[i]); }
};
/// A list whose items are of one of several kinds.
template <class... Ts>
struct OneOfList : AnyRefList {
  OneOfList() = default;
  template <class T>
  requires(std::is_same_v<Ts, T> || ...) OneOfList(RefList<T> other)
      : AnyRefList(std::move(other)) {}  // NOLINT: upcasts are safe and wanted
  template <class U>
  requires(std::is_base_of_v<Ts, U> || ...) void push_back(Ref<U> r) {
    items.push_back(r);
    given = true;
  }
  [[nodiscard]] AnyRef operator[](std::size_t i) const { return items[i]; }
};
struct SelectList {
  std::vector<SelectValue> items;
  bool given = false;
  friend bool operator==(const SelectList&, const SelectList&) = default;
};
template <class T>
struct ValueList {
  std::vector<T> items;
  bool given = false;
  friend bool operator==(const ValueList&, const ValueList&) = default;
};
using RealList = ValueList<double>;
using IntegerList = ValueList<std::int64_t>;
using TextList = ValueList<std::string>;
using RealTable = ValueList<std::vector<double>>;
struct RefTable {
  std::vector<std::vector<AnyRef>> items;
  bool given = false;
  friend bool operator==(const RefTable&, const RefTable&) = default;
};

using Real = std::optional<double>;
using Integer = std::optional<std::int64_t>;
using Boolean = std::optional<bool>;
using Text = std::optional<std::string>;
enum class Logical3 : std::int8_t { kFalse, kTrue, kUnknown };
using Logical = Enumerated<Logical3>;
using PathHandle = std::shared_ptr<const CutterPath>;

/// How an attribute is stored; each value names exactly one of the types above.
enum class Storage : std::uint8_t {
  kReal,
  kInteger,
  kBoolean,
  kText,
  kEnum,
  kRef,
  kRefList,
  kRefTable,
  kSelect,
  kSelectList,
  kRealList,
  kIntegerList,
  kTextList,
  kRealTable,
  kPath,
};

/// What a number means. In the model: mm, rad, mm/min, 1/min, s, ratio (0.75, never 75), N/mm2, mm3, W, Nm.
enum class Unit : std::uint8_t {
  kNone,
  kLength,
  kAngle,
  kSpeed,
  kRotSpeed,
  kTime,
  kRatio,
  kPressure,
  kVolume,
  kPower,
  kTorque
};

/// The unit's symbol in the model, e.g. "mm/min".
[[nodiscard]] std::string_view symbol(Unit u);

/// Model value = file value x factor: ISO 14649 writes m/s, rev/s and degrees.
[[nodiscard]] double iso14649_factor(Unit u);

/// One attribute of one kind of object. The table of these drives both exchanges, JSON and its schema,
/// `inspect`, diff and hashing.
struct Attribute {
  std::string_view name;  ///< ISO 14649 / AP238 name, e.g. "its_boss"
  Storage storage;
  Unit unit = Unit::kNone;
  bool required = false;    ///< mandatory in the standard; still absent when the file says `$`
  bool in_iso14649 = true;  ///< false: AP238's or the plan's own; an ISO 14649 file cannot hold it
  std::span<const TypeId> targets = {};                ///< kinds a reference may point to (or below)
  std::span<const std::string_view> enumerators = {};  ///< upper case, in order of the codes
  void* (*at)(void* object) = nullptr;                 ///< address of the attribute's storage
  [[nodiscard]] const void* in(const void* object) const { return at(const_cast<void*>(object)); }
};

/// One kind of application object.
struct NounType {
  std::string_view keyword;  ///< upper case, as in Part 21: "ROUND_HOLE"
  TypeId parent = TypeId::kNone;
  bool abstract = false;
  bool in_iso14649 = true;
  std::span<const Attribute> attributes = {};  ///< all, inherited first, in the order of Part 21 parameters
};

/// The row for a kind. Needs a TypeId below kCount.
[[nodiscard]] const NounType& noun_type(TypeId t);
/// By keyword, upper case; nothing when there is no such kind.
[[nodiscard]] std::optional<TypeId> find_noun(std::string_view keyword);
/// Whether `t` is `ancestor` or below it.
[[nodiscard]] bool is_a(TypeId t, TypeId ancestor);
/// The attribute of that name, or null.
[[nodiscard]] const Attribute* find_attribute(TypeId t, std::string_view name);

}  // namespace capstan::model

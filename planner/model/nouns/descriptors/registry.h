#pragma once

#include <span>
#include <string_view>
#include <type_traits>
#include <vector>

#include "planner/model/nouns/arena/attribute.h"
#include "planner/model/nouns/enumerations.h"

// How the descriptor table is written: one `kRows` per header of nouns, one `row` per attribute.

namespace capstan::model {

/// A kind with its own attributes only; the registry puts the inherited ones in front.
struct NounRow {
  TypeId type;
  std::string_view keyword;
  TypeId parent;
  bool abstract;
  bool in_iso14649;
  std::span<const Attribute> own;
};

template <class E>
struct EnumNames;

template <>
struct EnumNames<AheadOrBehind> {
  static constexpr std::string_view kNames[] = {"AHEAD", "EXACT", "BEHIND"};
};
template <>
struct EnumNames<FittingType> {
  static constexpr std::string_view kNames[] = {"SHAFT", "HOLE"};
};
template <>
struct EnumNames<TrimmingPreference> {
  static constexpr std::string_view kNames[] = {"CARTESIAN", "PARAMETER", "UNSPECIFIED"};
};
template <>
struct EnumNames<TransitionCode> {
  static constexpr std::string_view kNames[] = {"DISCONTINUOUS", "CONTINUOUS", "CONT_SAME_GRADIENT",
                                                "CONT_SAME_GRADIENT_SAME_CURVATURE"};
};
template <>
struct EnumNames<BSplineCurveForm> {
  static constexpr std::string_view kNames[] = {"POLYLINE_FORM", "CIRCULAR_ARC",   "ELLIPTIC_ARC",
                                                "PARABOLIC_ARC", "HYPERBOLIC_ARC", "UNSPECIFIED"};
};
template <>
struct EnumNames<BSplineSurfaceForm> {
  static constexpr std::string_view kNames[] = {
      "PLANE_SURF",    "CYLINDRICAL_SURF",         "CONICAL_SURF", "SPHERICAL_SURF",
      "TOROIDAL_SURF", "SURF_OF_REVOLUTION",       "RULED_SURF",   "GENERALISED_CONE",
      "QUADRIC_SURF",  "SURF_OF_LINEAR_EXTRUSION", "UNSPECIFIED"};
};
template <>
struct EnumNames<KnotType> {
  static constexpr std::string_view kNames[] = {"UNIFORM_KNOTS", "QUASI_UNIFORM_KNOTS",
                                                "PIECEWISE_BEZIER_KNOTS", "UNSPECIFIED"};
};
template <>
struct EnumNames<BottomOrSide> {
  static constexpr std::string_view kNames[] = {"BOTTOM", "SIDE", "BOTTOM_AND_SIDE"};
};
template <>
struct EnumNames<ToolReferencePoint> {
  static constexpr std::string_view kNames[] = {"TCP", "CCP"};
};
template <>
struct EnumNames<PathmodeType> {
  static constexpr std::string_view kNames[] = {"FORWARD", "ZIGZAG"};
};
template <>
struct EnumNames<CutmodeType> {
  static constexpr std::string_view kNames[] = {"CLIMB", "CONVENTIONAL"};
};
template <>
struct EnumNames<LeftOrRight> {
  static constexpr std::string_view kNames[] = {"LEFT", "RIGHT"};
};
template <>
struct EnumNames<StrokeConnectionStrategy> {
  static constexpr std::string_view kNames[] = {"STRAGHTLINE", "LIFT_SHIFT_PLUNGE", "DEGOUGE", "LOOP_BACK"};
};
template <>
struct EnumNames<RotDirection> {
  static constexpr std::string_view kNames[] = {"CW", "CCW"};
};
template <>
struct EnumNames<Hand> {
  static constexpr std::string_view kNames[] = {"LEFT", "RIGHT", "NEUTRAL"};
};
template <>
struct EnumNames<ToolpathType> {
  static constexpr std::string_view kNames[] = {"APPROACH",    "LIFT",    "CONNECT",
                                                "NON_CONTACT", "CONTACT", "TRAJECTORY_PATH"};
};
template <>
struct EnumNames<ContactType> {
  static constexpr std::string_view kNames[] = {"SIDE", "FRONT"};
};

template <>
struct EnumNames<AreaUnitType> {
  static constexpr std::string_view kNames[] = {"SPHERICAL", "CYLINDRICAL", "RECTANGULAR", "SQUARE",
                                                "CIRCULAR"};
};
template <>
struct EnumNames<AngleRelator> {
  static constexpr std::string_view kNames[] = {"SMALL", "LARGE", "EQUAL"};
};

template <>
struct EnumNames<Logical3> {
  static constexpr std::string_view kNames[] = {"F", "T", "U"};
};

namespace detail {

template <class T>
struct StorageOf;
template <>
struct StorageOf<Real> {
  static constexpr auto kValue = Storage::kReal;
};
template <>
struct StorageOf<Integer> {
  static constexpr auto kValue = Storage::kInteger;
};
template <>
struct StorageOf<Boolean> {
  static constexpr auto kValue = Storage::kBoolean;
};
template <>
struct StorageOf<Text> {
  static constexpr auto kValue = Storage::kText;
};
template <>
struct StorageOf<RefTable> {
  static constexpr auto kValue = Storage::kRefTable;
};
template <>
struct StorageOf<SelectValue> {
  static constexpr auto kValue = Storage::kSelect;
};
template <>
struct StorageOf<SelectList> {
  static constexpr auto kValue = Storage::kSelectList;
};
template <>
struct StorageOf<RealList> {
  static constexpr auto kValue = Storage::kRealList;
};
template <>
struct StorageOf<IntegerList> {
  static constexpr auto kValue = Storage::kIntegerList;
};
template <>
struct StorageOf<TextList> {
  static constexpr auto kValue = Storage::kTextList;
};
template <>
struct StorageOf<RealTable> {
  static constexpr auto kValue = Storage::kRealTable;
};
template <>
struct StorageOf<PathHandle> {
  static constexpr auto kValue = Storage::kPath;
};

// What a reference may point to, and what an enumeration may say.
template <class T>
struct Shape {
  static constexpr auto kStorage = StorageOf<T>::kValue;
  static constexpr std::span<const TypeId> kTargets = {};
  static constexpr std::span<const std::string_view> kNames = {};
};
template <class... Ts>
struct TargetList {
  static constexpr TypeId kItems[] = {Ts::kType...};
};
template <class T>
struct Shape<Ref<T>> {
  static constexpr auto kStorage = Storage::kRef;
  static constexpr std::span<const TypeId> kTargets = TargetList<T>::kItems;
  static constexpr std::span<const std::string_view> kNames = {};
};
template <class... Ts>
struct Shape<OneOf<Ts...>> {
  static constexpr auto kStorage = Storage::kRef;
  static constexpr std::span<const TypeId> kTargets = TargetList<Ts...>::kItems;
  static constexpr std::span<const std::string_view> kNames = {};
};
template <>
struct Shape<RefList<Noun>> {
  static constexpr auto kStorage = Storage::kRefList;
  static constexpr std::span<const TypeId> kTargets = {};
  static constexpr std::span<const std::string_view> kNames = {};
};
template <class T>
struct Shape<RefList<T>> {
  static constexpr auto kStorage = Storage::kRefList;
  static constexpr std::span<const TypeId> kTargets = TargetList<T>::kItems;
  static constexpr std::span<const std::string_view> kNames = {};
};
template <class... Ts>
struct Shape<OneOfList<Ts...>> {
  static constexpr auto kStorage = Storage::kRefList;
  static constexpr std::span<const TypeId> kTargets = TargetList<Ts...>::kItems;
  static constexpr std::span<const std::string_view> kNames = {};
};
template <class E>
struct Shape<Enumerated<E>> {
  static constexpr auto kStorage = Storage::kEnum;
  static constexpr std::span<const TypeId> kTargets = {};
  static constexpr std::span<const std::string_view> kNames = EnumNames<E>::kNames;
};

// The slice of a type-erased object that the generic walkers see: the non-template base of the storage.
template <class T>
struct Erased {
  using Type = T;
};
template <class T>
struct Erased<Ref<T>> {
  using Type = AnyRef;
};
template <class... Ts>
struct Erased<OneOf<Ts...>> {
  using Type = AnyRef;
};
template <class T>
struct Erased<RefList<T>> {
  using Type = AnyRefList;
};
template <class... Ts>
struct Erased<OneOfList<Ts...>> {
  using Type = AnyRefList;
};
template <class E>
struct Erased<Enumerated<E>> {
  using Type = AnyEnum;
};

template <class C, class M, M C::*Member>
void* address(void* object) {
  typename Erased<M>::Type* storage = &(static_cast<C*>(object)->*Member);
  return storage;
}

template <auto Member>
struct MemberOf;
template <class C, class M, M C::*Member>
struct MemberOf<Member> {
  using Value = M;
  static constexpr auto kAddress = &address<C, M, Member>;
};

}  // namespace detail

enum Optionality : bool { kOptional = false, kRequired = true };

template <auto Member>
constexpr Attribute row(std::string_view name, Optionality optionality, Unit unit = Unit::kNone) {
  using Shape = detail::Shape<typename detail::MemberOf<Member>::Value>;
  return {.name = name,
          .storage = Shape::kStorage,
          .unit = unit,
          .required = optionality == kRequired,
          .in_iso14649 = true,
          .targets = Shape::kTargets,
          .enumerators = Shape::kNames,
          .at = detail::MemberOf<Member>::kAddress};
}

/// An attribute that ISO 14649 has no place for.
template <auto Member>
constexpr Attribute plan_row(std::string_view name, Optionality optionality, Unit unit = Unit::kNone) {
  Attribute a = row<Member>(name, optionality, unit);
  a.in_iso14649 = false;
  return a;
}

/// The rows of all files of this folder: NAME.cpp gives its own by `std::span<const NounRow> NAME_rows()`,
/// which the build finds by the file's name (planner/model/CMakeLists.txt).
[[nodiscard]] std::vector<std::span<const NounRow>> noun_rows();

}  // namespace capstan::model

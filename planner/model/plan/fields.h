#pragma once

#include <array>
#include <concepts>
#include <cstddef>
#include <string>
#include <string_view>
#include <tuple>
#include <type_traits>
#include <utility>

#include "planner/model/nouns/arena/attribute.h"

/// @file The table of fields of a plain struct of the plan: one row per field. Plan JSON, the records of Part
/// 21 files, the tool store, the own tool list, diff and the keys that compare cutters visit it; none of them
/// names fields itself. The tables stand beside the structs (cutter/cutter_fields.h, resources/*_fields.h),
/// apart from them, so that only these forms are compiled anew when a column changes.

namespace capstan::model {

/// A piece of a struct's record in a Part 21 file. A record is its pieces in order, a piece its fields in the
/// table's order.
struct RecordPart {
  bool opens = false;   ///< a group begins before its fields
  bool closes = false;  ///< that group ends behind its fields
  int since = 1;        ///< the version of the record that has it; files of earlier versions end before it
};

/// A row of the table.
template <class S, class T>
struct Field {
  const char* name;  ///< as JSON writes it, and `sources` and messages call it; wears its unit
  T S::*member;
  Unit unit = Unit::kNone;  ///< that the forms convert
  const char* in_record = nullptr;
  std::size_t part = 0;            ///< of RecordPart, by its place
  const char* own_key = nullptr;   ///< in the own tool list; nullptr: it has none
  int own_place = 0;               ///< by which the own list is written, least first
  const char* not_own = nullptr;   ///< why the own list has no such key
  const char* not_told = nullptr;  ///< why two that differ in it alone are the same to diff
  bool is_sourced = false;         ///< `sources` says where its value is from, even one that a form fills in
  bool is_load = false;            ///< forces or bending depend on it
  bool is_repeated = false;        ///< a text that many of a library share: the store keeps it once

  /// What the record calls it, and in which piece it is.
  [[nodiscard]] constexpr Field record(const char* called, std::size_t in_part = 0) const {
    Field out = *this;
    out.in_record = called, out.part = in_part;
    return out;
  }
  [[nodiscard]] constexpr Field own(const char* key, int place) const {
    Field out = *this;
    out.own_key = key, out.own_place = place;
    return out;
  }
  [[nodiscard]] constexpr Field no_own(const char* why) const {
    Field out = *this;
    out.not_own = why;
    return out;
  }
  [[nodiscard]] constexpr Field untold(const char* why) const {
    Field out = *this;
    out.not_told = why;
    return out;
  }
  [[nodiscard]] constexpr Field sourced() const {
    Field out = *this;
    out.is_sourced = true;
    return out;
  }
  [[nodiscard]] constexpr Field load() const {
    Field out = *this;
    out.is_load = true;
    return out;
  }
  [[nodiscard]] constexpr Field repeated() const {
    Field out = *this;
    out.is_repeated = true;
    return out;
  }
};

template <class S, class T>
[[nodiscard]] constexpr Field<S, T> field(const char* name, T S::*member, Unit unit = Unit::kNone) {
  return {name, member, unit};
}

struct NoFields {};
/// The table of a struct: a tuple of rows, in the order of JSON.
template <class S>
inline constexpr auto kFields = NoFields{};
/// The pieces of its record.
template <class S>
inline constexpr auto kRecordParts = std::array{RecordPart{}};

template <class S>
concept HasFields = !std::same_as<std::remove_cv_t<decltype(kFields<std::remove_cv_t<S>>)>, NoFields>;

/// Calls `visit(row, value)` for each field, in order; `x` may be const.
template <HasFields S, class Visit>
constexpr void for_each_field(S& x, Visit&& visit) {
  std::apply([&](const auto&... row) { (visit(row, x.*row.member), ...); }, kFields<std::remove_cv_t<S>>);
}

/// Stands for a value of any type where members are counted; never made.
struct AnyValue {
  template <class T>
  operator T() const;  // NOLINT: implicit on purpose
};
template <class S, std::size_t... I>
[[nodiscard]] constexpr bool takes(std::index_sequence<I...>) {
  return requires { S{(static_cast<void>(I), AnyValue{})...}; };
}
/// How many members an aggregate has: it takes so many values in braces, and not one more.
template <class S, std::size_t N = 0>
[[nodiscard]] constexpr std::size_t member_count() {
  if constexpr (takes<S>(std::make_index_sequence<N + 1>{})) {
    return member_count<S, N + 1>();
  } else {
    return N;
  }
}

/// Whether the table has as many rows as the struct has members, and no name twice. As the rows are of
/// distinct members (a member under two names is two rows too many), none is missing.
template <class S>
[[nodiscard]] constexpr bool has_row_per_member() {
  constexpr auto names =
      std::apply([](const auto&... row) { return std::array{std::string_view(row.name)...}; }, kFields<S>);
  for (std::size_t i = 0; i < names.size(); ++i) {
    for (std::size_t k = 0; k < i; ++k) {
      if (names[i] == names[k]) return false;
    }
  }
  return names.size() == member_count<S>();
}

}  // namespace capstan::model

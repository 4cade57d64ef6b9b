#pragma once

#include <concepts>
#include <string_view>

#include "planner/model/nouns/arena/attribute.h"
#include "planner/model/plan/cutter/cutter.h"
#include "planner/model/plan/fields.h"

namespace capstan::json {

/// What the schema says of a number by the name of its field, where no table states its unit: the unit, which
/// names wear at their end ("feed_mm_min"), or words where it is a ratio, or has the unit of another field.
/// Empty: the name says nothing.
[[nodiscard]] std::string_view meaning_of(std::string_view name);

/// The same where a table may state the unit: that comes first, but for a ratio, whose name says of what.
[[nodiscard]] std::string_view meaning_of(std::string_view name, model::Unit unit);

/// The same of an attribute of a kind of object.
[[nodiscard]] std::string_view meaning_of(model::TypeId owner, const model::Attribute& a);

/// What the value of a word of a tool table is in.
inline constexpr std::string_view kOfTableWord = "mm of lengths; other numbers as the tool table writes them";

/// The same of a field of a plain struct.
template <class S, class T>
[[nodiscard]] std::string_view meaning_of(const model::Field<S, T>& row) {
  if constexpr (std::same_as<S, model::ToolTableWord> && std::same_as<T, double>) {
    return kOfTableWord;
  } else {
    return meaning_of(row.name, row.unit);
  }
}

}  // namespace capstan::json

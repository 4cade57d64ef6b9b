#pragma once

#include <functional>
#include <span>
#include <vector>

#include "planner/model/nouns/arena/model.h"

namespace capstan::model {

/// Calls `visit` for each reference the object holds, in the order of its attributes; kept instances
/// included.
void for_each_reference(const Model& model, AnyRef object, const std::function<void(AnyRef)>& visit);

/// Everything the roots reach, each once, roots first in their order, depth first. Not recursive.
[[nodiscard]] std::vector<AnyRef> reachable(const Model& model, std::span<const AnyRef> roots);

/// Typed views of an attribute's storage. Need the matching `storage`.
template <class T>
[[nodiscard]] const T& value_of(const Attribute& a, const void* object) {
  return *static_cast<const T*>(a.in(object));
}

/// Whether the attribute has a value: lists count when given, enumerations when set.
[[nodiscard]] bool has_value(const Attribute& a, const void* object);

}  // namespace capstan::model

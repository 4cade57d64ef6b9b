#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "planner/model/nouns/arena/attribute.h"

namespace capstan::json {

/// "round_hole" of ROUND_HOLE.
[[nodiscard]] std::string kind_name(model::TypeId t);
[[nodiscard]] std::optional<model::TypeId> kind_from_name(std::string_view name);
/// "round_hole:3" of the third round hole.
[[nodiscard]] std::string object_id(model::AnyRef r);
/// Back again; the object need not exist.
[[nodiscard]] std::optional<model::AnyRef> object_from_id(std::string_view id);
/// "path:3" of number 2.
[[nodiscard]] std::string shared_id(std::string_view what, std::size_t index);
[[nodiscard]] std::optional<std::size_t> shared_from_id(std::string_view what, std::string_view id);

/// Moves as one letter each.
inline constexpr std::string_view kMoveKinds = "RLWCD";  ///< rapid, line, clockwise, counter-clockwise, dwell
inline constexpr std::string_view kMoveRoles =
    "APMCLRDT";  ///< approach, plunge, ramp, cut, link, retract, drill, tap

}  // namespace capstan::json

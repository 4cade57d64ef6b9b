#pragma once

#include <cstddef>
#include <optional>
#include <string_view>

#include "planner/model/nouns/arena/attribute.h"

namespace capstan::exchange {

/// Meaning of a keyword at the published level.
struct Spelling {
  model::TypeId type = model::TypeId::kNone;
  bool draft = false;  ///< the 2001 draft's (or a misspelt) keyword
};

/// The kind of object for a keyword of either level; nothing for abstract kinds, kinds that are not in ISO
/// 14649, and unknown keywords. FILE_SCHEMA does not distinguish the levels; keywords and counts do.
[[nodiscard]] std::optional<Spelling> kind_of(std::string_view keyword);

/// Number of Part 21 parameters of a kind at the published level.
[[nodiscard]] std::size_t parameter_count(model::TypeId type);

/// Whether the draft wrote this kind with `count` parameters: then missing ones at the end are `$`, and
/// one more at the end is dropped.
[[nodiscard]] bool is_draft_count(model::TypeId type, std::size_t count);

/// Kinds that are abstract at the published level, yet instantiated in draft files.
[[nodiscard]] bool is_draft_kind(model::TypeId type);

}  // namespace capstan::exchange

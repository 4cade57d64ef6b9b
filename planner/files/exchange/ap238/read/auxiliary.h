#pragma once

#include <charconv>
#include <optional>
#include <string>

#include "planner/model/nouns/arena/kept.h"

namespace capstan::exchange::ap238 {

/// Which instance of an object's mapping: the way to it from the object's own, and the list element.
struct Part {
  std::string path;
  std::uint32_t ordinal = 0;
};

/// Stands in the model for an instance that belongs to the mapping of an application object, so that kept
/// instances stay connected to it. Kept instances refer to it; it is never written itself.
[[nodiscard]] inline model::KeptInstance auxiliary_instance(model::AnyRef owner, const Part& part) {
  model::KeptInstance out;
  out.schema = model::KeptSchema::kAp238;
  out.keyword = "&" + std::to_string(part.ordinal) + " " + part.path;
  out.pieces.emplace_back(owner);
  return out;
}

/// The owner and part of such an instance; nothing for any other kept instance.
[[nodiscard]] inline std::optional<std::pair<model::AnyRef, Part>> auxiliary_part(
    const model::KeptInstance& k) {
  if (k.keyword.empty() || k.keyword.front() != '&' || k.pieces.size() != 1) return std::nullopt;
  const auto* owner = std::get_if<model::AnyRef>(&k.pieces.front());
  const auto space = k.keyword.find(' ');
  if (owner == nullptr || space == std::string::npos) return std::nullopt;
  Part part;
  std::from_chars(k.keyword.data() + 1, k.keyword.data() + space, part.ordinal);
  part.path = k.keyword.substr(space + 1);
  return std::pair(*owner, part);
}

}  // namespace capstan::exchange::ap238

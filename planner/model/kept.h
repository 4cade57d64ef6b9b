#pragma once

#include <string>
#include <variant>
#include <vector>

#include "planner/model/attribute.h"

namespace capstan::model {

/// An instance that no noun describes, kept as it was read: pieces of Part 21 text, and between them
/// references that stay connected when instances are renumbered. Written back in the same order.
struct KeptInstance : Noun {
  static constexpr TypeId kType = TypeId::kKeptInstance;
  std::string keyword;  ///< as written, or the keywords of a complex instance
  std::vector<std::variant<std::string, AnyRef>> pieces;  ///< the text after `#n=` up to the `;`
};

}  // namespace capstan::model

#pragma once

#include <cstdint>
#include <string>
#include <variant>
#include <vector>

#include "planner/model/nouns/arena/attribute.h"

namespace capstan::model {

/// The standard that a kept instance's text is of; a file of the other one has no place for it.
enum class KeptSchema : std::uint8_t { kIso14649, kAp238 };
/// Where it stood: an instance, or all of an ANCHOR or REFERENCE section of Part 21 edition 3.
enum class KeptSection : std::uint8_t { kData, kAnchor, kReference };

/// An instance that no noun describes, kept as it was read: pieces of Part 21 text, and between them
/// references that stay connected when instances are renumbered. Written back in the same order.
struct KeptInstance : Noun {
  static constexpr TypeId kType = TypeId::kKeptInstance;
  std::string keyword;  ///< as written, or the keywords of a complex instance
  std::vector<std::variant<std::string, AnyRef>> pieces;  ///< the text after `#n=` up to the `;`
  KeptSchema schema = KeptSchema::kIso14649;
  KeptSection section = KeptSection::kData;  ///< a section: the text between its keyword and its ENDSEC
};

}  // namespace capstan::model

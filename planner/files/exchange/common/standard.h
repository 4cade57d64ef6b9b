#pragma once

#include <cstdint>
#include <string_view>

#include "planner/files/p21/file.h"

namespace capstan::exchange {

/// What a Part 21 file is about.
enum class Standard : std::uint8_t {
  kIso14649,  ///< a plan: ISO 14649
  kAp238,     ///< a plan: ISO 10303-238
  kShapes,    ///< a CAD model: ISO 10303-203, -214, -242, or another schema with faces in it
  kOther,
};

/// By the names in FILE_SCHEMA; where none is known, by whether an instance is a face.
[[nodiscard]] Standard standard_of(const p21::File& file);

/// The same from bytes, of which only the header is parsed. kOther where that fails: whoever reads the file
/// then tells why.
[[nodiscard]] Standard standard_of(std::string_view bytes);

}  // namespace capstan::exchange

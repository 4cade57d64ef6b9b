#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "planner/files/exchange/brep/brep.h"
#include "planner/ground/base/result.h"

namespace capstan::exchange {

/// What the helper process says of a file: its geometry with remarks, or remarks of which one is an error.
struct BrepMessage {
  std::vector<Diagnostic> remarks;  ///< without file, line and path: the caller knows them
  std::optional<Brep> brep;
  friend bool operator==(const BrepMessage&, const BrepMessage&) = default;
};

/// The message as bytes.
///
/// Shape   "CAPSTANB", u32 version, u64 number of bytes behind it, then the fields in the order of the tables
///         in message.cpp: lists and texts as u64 length and elements. Little endian, numbers as IEEE 754
///         binary64.
[[nodiscard]] std::string encoded(const BrepMessage& message);

/// Reads what `encoded` wrote, and nothing else. No list is made longer than the bytes at hand can fill.
///
/// Fails   BREP-MESSAGE: not a message of this version, cut short, bytes too many, a number that is not
///         finite, an index that leads nowhere, bodies or triangles that do not stand one behind the other,
///         or neither a brep nor an error. The message tells which, at which byte.
/// Cost    linear in the bytes.
[[nodiscard]] Result<BrepMessage> decoded(std::string_view bytes);

}  // namespace capstan::exchange

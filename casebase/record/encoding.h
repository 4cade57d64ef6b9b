#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "casebase/record/case.h"

namespace capstan::casebase {

/// A case as stored bytes: the version, then each field that is known, by rising tag. Equal cases have equal
/// bytes, and a field that is added later changes no bytes of cases that lack it. The id is not in it.
///
/// Shape   u8 version; per field u8 tag, then a text as u16 length and bytes; a number as 8 bytes; a count as
///         4; a word as a text; a figure as value, standard deviation, u8 origin; a series as u8 origin, u32
///         length, and pairs of numbers. Little endian, numbers as IEEE 754 binary64; -0 is written as 0.
[[nodiscard]] std::string encoded(const Case& c);

/// Reads what `encoded` wrote, and nothing else: not a tag out of order, not a byte too many. The limits are
/// not looked at: `fault_of` is. Nothing on any fault.
[[nodiscard]] std::optional<Case> decoded(std::string_view bytes);

}  // namespace capstan::casebase

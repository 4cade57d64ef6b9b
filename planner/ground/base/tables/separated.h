#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "planner/ground/base/result.h"

namespace capstan {

/// One row of a table of separated values.
struct SeparatedRow {
  std::uint64_t line = 0;  ///< where it begins, 1-based
  std::vector<std::string> cells;
};

/// What a quote may do that RFC 4180 does not allow: stand within a cell without quotes, be followed by text.
enum class StrayQuotes : std::uint8_t { kKept, kRefused };

/// Rows of a text with a separator (RFC 4180: cells in double quotes may hold it, line ends, and "" for a
/// quote). A mark of byte order is passed over, blank lines are left out.
/// Fails  `code` with file and line (an open or stray quote, NUL bytes, UTF-16); FILE-TOO-LARGE.
[[nodiscard]] Result<std::vector<SeparatedRow>> separated_rows(std::string_view text, char separator,
                                                               const std::string& file, const char* code,
                                                               StrayQuotes stray);
/// The one of , ; and tab that the first line with words has most of, outside quotes; NUL when none.
[[nodiscard]] char separator_of(std::string_view text);
/// A cell as it is written: in quotes where it must be.
[[nodiscard]] std::string separated_cell(std::string_view text, char separator);

}  // namespace capstan

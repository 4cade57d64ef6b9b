#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "planner/ground/base/result.h"

namespace capstan::tooling::csv {

struct Row {
  std::uint64_t line = 0;  ///< where it begins, 1-based
  std::vector<std::string> cells;
};

/// Rows of a text with a separator (RFC 4180: cells in double quotes may hold it, line ends and "" for a
/// quote). Empty lines are left out.
/// Fails  CSV-SYNTAX (an open quote, NUL bytes, UTF-16), FILE-TOO-LARGE.
[[nodiscard]] Result<std::vector<Row>> parse_rows(std::string_view text, char separator,
                                                  const std::string& file);
/// The one of , ; and tab that the first line with words has most of, outside quotes; NUL when none.
[[nodiscard]] char separator_of(std::string_view text);
/// In quotes where it must be.
[[nodiscard]] std::string cell(std::string_view text, char separator);

}  // namespace capstan::tooling::csv

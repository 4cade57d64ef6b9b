#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace capstan::json {

/// An array of numbers that was taken out of a text.
struct Column {
  std::size_t array = 0;  ///< which of the document's arrays, counted from 0 as they open
  /// The first number that is spelled with a point or an exponent.
  std::optional<std::size_t> not_whole = std::nullopt;
  std::vector<std::uint8_t> bytes;  ///< the doubles, one after the other
};

/// A document without its long columns.
struct Columns {
  std::string rest;  ///< the text; of each column only the brackets and the line ends in them are left
  std::vector<Column> columns;
  int deepest = 0;  ///< levels of nesting in `rest`
};

/// Takes the arrays out in which a plan's columns stand: those of the fourth level ({"paths": [{"x": [), that
/// hold numbers only, at least kLeastColumn of them.
///
/// Accuracy  each number is the nearest double, as the general parser gives it.
/// Fails     never: what is no such array, or is wrong, stays in the text for the general parser to judge.
/// Cost      linear.
[[nodiscard]] Columns take_columns(std::string_view text);

inline constexpr std::size_t kLeastColumn = 16;  ///< shorter ones cost the general parser little

}  // namespace capstan::json

#pragma once

#include <cstddef>
#include <cstring>
#include <string>
#include <vector>

#include "planner/files/json/tree/columns.h"

// The document as a tree of the JSON library's values. A column (columns.h) is one binary value in it: no
// text makes such a value otherwise. Tree is the library's value, which stays in sources.

namespace capstan::json {

/// Why a text has no tree; `byte` of the text without its columns.
struct TreeFault {
  std::string too_large;  ///< a number that no double holds, as it is spelled; else empty
  std::size_t byte = 0;
};

/// The tree of a document whose columns were taken out; these are moved into it. False: `fault` says why.
template <class Tree>
[[nodiscard]] bool make_tree(Columns taken, Tree& tree, TreeFault& fault);

/// The numbers of a column.
template <class Tree>
[[nodiscard]] std::vector<double> numbers_of(const Tree& column) {
  const auto& bytes = column.get_binary();
  std::vector<double> out(bytes.size() / sizeof(double));
  if (!out.empty()) std::memcpy(out.data(), bytes.data(), bytes.size());
  return out;
}
/// 1: all numbers are spelled as whole ones; else 2 and more, by the first that is not.
[[nodiscard]] inline std::size_t subtype_of(const std::optional<std::size_t>& not_whole) {
  return not_whole ? 2 + *not_whole : 1;
}
/// Whether all its numbers are spelled as whole ones.
template <class Tree>
[[nodiscard]] bool is_whole(const Tree& column) {
  return column.get_binary().subtype() == subtype_of(std::nullopt);
}
/// A column as the library would have read it.
template <class Tree>
[[nodiscard]] Tree expanded(const Tree& column) {
  Tree out = Tree::array();
  const std::vector<double> numbers = numbers_of(column);
  const std::size_t whole =
      is_whole(column) ? numbers.size() : static_cast<std::size_t>(column.get_binary().subtype()) - 2;
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    const double v = numbers[i];
    if (i < whole && v >= 0.0) {
      out.push_back(static_cast<std::uint64_t>(v));
    } else if (i < whole) {
      out.push_back(static_cast<std::int64_t>(v));
    } else {
      out.push_back(v);
    }
  }
  return out;
}

}  // namespace capstan::json

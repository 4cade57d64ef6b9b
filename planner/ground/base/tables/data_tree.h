#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace capstan {

/// A data file as a tree: YAML, and therefore JSON. Scalars keep their spelling.
struct DataNode {
  enum class Kind : std::uint8_t { kNull, kScalar, kList, kMap };
  Kind kind = Kind::kNull;
  std::string text = {};   ///< of a scalar
  std::uint64_t line = 0;  ///< 1-based
  std::vector<DataNode> items = {};
  std::vector<std::pair<std::string, DataNode>> entries = {};  ///< in file order

  /// The first entry of that key; null when there is none.
  [[nodiscard]] const DataNode* find(std::string_view key) const;
  friend bool operator==(const DataNode&, const DataNode&) = default;
};

/// The documents of a file in the form in which data files are compiled in: `unpack` copies it and parses
/// nothing.
[[nodiscard]] std::string pack(const std::vector<DataNode>& documents);

/// Needs  what `pack` gave, whole: the build made it, so that it is not judged again.
[[nodiscard]] std::vector<DataNode> unpack(std::string_view packed);

}  // namespace capstan

#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "planner/p21/file.h"

/// How a File is kept; for the files of this room alone.
namespace capstan::p21::detail {

/// What a node is: the kinds in their order, then two that only the store tells apart.
enum class Tag : std::uint8_t {
  kOmitted,
  kDerived,
  kInteger,
  kReal,
  kString,  ///< needs no decoding
  kEnumeration,
  kBinary,
  kReference,
  kList,           ///< children are contiguous from `start`
  kTyped,          ///< two nodes at `start`: the keyword and the parameter
  kEscapedString,  ///< holds '', an escape or a byte outside printable ASCII
  kKeyword,
};

inline constexpr std::uint64_t kMaxLength = (std::uint64_t{1} << 28) - 1;
inline constexpr std::size_t kMaxBytes = std::numeric_limits<std::uint32_t>::max() - 1U;

[[nodiscard]] constexpr Node make_node(Tag tag, std::uint64_t start, std::uint64_t length) {
  return start | length << 32 | static_cast<std::uint64_t>(tag) << 60;
}
[[nodiscard]] constexpr Tag tag_of(Node n) { return static_cast<Tag>(n >> 60); }
[[nodiscard]] constexpr std::size_t start_of(Node n) { return n & 0xFFFFFFFFU; }
[[nodiscard]] constexpr std::size_t length_of(Node n) { return n >> 32 & kMaxLength; }

struct Part {
  std::uint32_t keyword_start = 0;
  std::uint32_t keyword_length = 0;
  Node parameters = 0;
};

struct Entity {
  std::uint64_t id = 0;
  std::uint32_t line = 0;
  std::uint32_t part : 31 = 0;  ///< its first; the next entity's is one past its last
  std::uint32_t complex : 1 = 0;
};

struct Section {
  std::size_t keyword_start = 0, keyword_length = 0, start = 0, length = 0;
  std::uint64_t line = 0;
};

/// Numbers to positions: an array where the numbers are dense, sorted pairs where they are sparse.
class IdIndex {
 public:
  /// Returns the positions of entities whose number an earlier one has.
  std::vector<std::size_t> build(const std::vector<Entity>& entities, std::size_t count);
  [[nodiscard]] std::optional<std::uint32_t> find(std::uint64_t id) const;

 private:
  std::vector<std::uint32_t> dense_;  ///< position + 1; 0 for none
  std::vector<std::pair<std::uint64_t, std::uint32_t>> sparse_;
};

struct Store {
  std::string name;
  std::string text;
  std::vector<Node> nodes;
  std::vector<Part> parts;
  std::vector<Entity> header;    ///< and one past the last
  std::vector<Entity> entities;  ///< and one past the last
  std::vector<Section> sections;
  std::vector<VerbatimSection> verbatim;
  std::vector<DataSection> data;
  std::vector<std::uint64_t> external_ids;
  IdIndex index;

  [[nodiscard]] std::string_view view(std::size_t start, std::size_t length) const {
    return {text.data() + start, length};
  }
  [[nodiscard]] std::string_view view(Node n) const { return view(start_of(n), length_of(n)); }
};

}  // namespace capstan::p21::detail

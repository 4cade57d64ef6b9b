#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "planner/files/p21/buffer.h"
#include "planner/files/p21/file.h"

/// How a File is kept; for the files of this room alone.
namespace capstan::p21::detail {

inline constexpr std::size_t kMaxBytes = std::numeric_limits<std::uint32_t>::max() - 1U;

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
  std::vector<std::size_t> build(const Buffer<Entity>& entities, std::size_t count);
  [[nodiscard]] std::optional<std::uint32_t> find(std::uint64_t id) const;

 private:
  Buffer<std::uint32_t> dense_;  ///< position + 1; 0 for none
  std::vector<std::pair<std::uint64_t, std::uint32_t>> sparse_;
};

struct Store {
  Arena arena;  ///< of `text` and `nodes`, once they no longer grow
  std::string name;
  std::string text;
  Buffer<Node> nodes;
  Buffer<Part> parts;
  Buffer<Entity> header;    ///< and one past the last
  Buffer<Entity> entities;  ///< and one past the last
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

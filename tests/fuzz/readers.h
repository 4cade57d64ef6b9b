#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace capstan::fuzz {

/// A reader of something that somebody else wrote. It takes any bytes: what it cannot use it refuses with a
/// message; it never throws, hangs, or takes memory without bound.
struct Reader {
  std::string_view name;  ///< its seeds stand in tests/fuzz/seeds/NAME
  void (*read)(std::string bytes);
  std::vector<std::string> seeds;  ///< further ones: files from the root, "corpus/..." of the corpus
};

/// Every reader but those of Part 21 and AP238, which have targets of their own.
[[nodiscard]] const std::vector<Reader>& readers();
[[nodiscard]] const Reader* find_reader(std::string_view name);

}  // namespace capstan::fuzz

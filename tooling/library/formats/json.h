#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "planner/ground/base/result.h"

namespace capstan::tooling {

inline constexpr std::size_t kJsonDepthCap = 64;
inline constexpr std::size_t kJsonNodesCap = 20'000'000;

/// A JSON text as a tree that keeps what a number was spelled like, the order of keys, and lines.
struct Json {
  enum class Kind : std::uint8_t { kNull, kBool, kNumber, kString, kList, kMap };
  Kind kind = Kind::kNull;
  std::string text = {};   ///< of strings (unescaped), numbers (as spelled), "true", "false"
  std::uint64_t line = 0;  ///< 1-based
  std::vector<Json> items = {};
  std::vector<std::pair<std::string, Json>> entries = {};  ///< keys unique

  [[nodiscard]] const Json* find(std::string_view key) const;
  /// The text of a scalar entry, empty when absent or not a scalar.
  [[nodiscard]] std::string text_of(std::string_view key) const;
  [[nodiscard]] bool is(Kind k) const { return kind == k; }

  static Json string(std::string_view text);
  static Json number(std::string_view spelled);
  static Json truth(bool value);
  static Json list();
  static Json map();
  /// Of a map: puts or replaces.
  Json& set(std::string_view key, Json value);
};

/// One document, read without recursion.
/// Fails  JSON-SYNTAX (also NaN, leading zeros, broken UTF-16 escapes, text behind the document), JSON-DEPTH,
///        DATA-DUPLICATE for a key given twice, FILE-TOO-LARGE; each with file and line.
[[nodiscard]] Result<Json> parse_json(std::string_view text, const std::string& file);

/// `indent` 0: one line. Keys in the order of the tree.
[[nodiscard]] std::string json_text(const Json& value, int indent = 0);
/// A string with its quotes.
[[nodiscard]] std::string json_quoted(std::string_view text);
/// Sorts the keys of all maps.
void sort_keys(Json& value);

}  // namespace capstan::tooling

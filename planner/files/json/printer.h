#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace capstan::json {

/// Prints JSON as it comes, without a tree: containers in lines of their own, or within one line.
class Printer {
 public:
  void open(char bracket, bool in_lines);  ///< '{' or '['; within a one-line container all is in that line
  void close();
  void key(std::string_view name);
  void text(std::string_view bytes);  ///< as a JSON string; see `quoted`
  void number(double v);              ///< shortest; needs a finite value
  void integer(std::int64_t v);
  void natural(std::uint64_t v);
  /// An array in one line: as `number` or `natural` for each, without a call for each.
  void numbers(std::span<const double> column);
  void naturals(std::span<const std::uint32_t> column);
  void boolean(bool v);
  void null();
  [[nodiscard]] std::string take();

 private:
  struct Level {
    char close;
    bool in_lines;
    bool empty = true;
  };
  void next();

  std::string out_;
  std::vector<Level> levels_;
  bool after_key_ = false;
};

/// A JSON string, quotes included. Bytes that are not UTF-8 become U+10FF00 + byte, and so do the bytes of
/// such characters themselves, so that `unquoted_bytes` gives every byte back.
[[nodiscard]] std::string quoted(std::string_view bytes);
/// The bytes of a text that a JSON parser has already unescaped.
[[nodiscard]] std::string unquoted_bytes(std::string_view text);

}  // namespace capstan::json

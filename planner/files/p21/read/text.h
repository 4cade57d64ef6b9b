#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

namespace capstan::p21::detail {

/// The first thing wrong with a string of either weight.
struct TextIssue {
  const char* message = nullptr;  ///< nullptr: nothing
  std::size_t offset = 0;
};
struct TextIssues {
  TextIssue warning;  ///< readable, not as the standard says
  TextIssue error;    ///< what was meant is not known
};

/// Appends the UTF-8 of what stands between the quotes of a Part 21 string.
///
/// `''` and `\\` halve; `\S\c` is c + 128 in the page set by `\P?\` (ISO 8859-1 to -9, A to I);
/// `\X\hh`, `\X2\hhhh...\X0\`, `\X4\hhhhhhhh...\X0\`; `\N\` and `\F\` and line breaks are dropped.
/// Bytes above 127 are UTF-8 (edition 3) or, with a warning, ISO 8859-1. An unknown escape stays as it
/// is written, with a warning. Source: ISO 10303-21:2016 clause 6.4.3.
void decode_text(std::string_view raw, std::string& out, TextIssues& issues);

/// The length of the well-formed UTF-8 sequence at `at` (RFC 3629), 0 if there is none; sets `code`.
[[nodiscard]] std::size_t utf8_at(std::string_view text, std::size_t at, std::uint32_t& code);

}  // namespace capstan::p21::detail

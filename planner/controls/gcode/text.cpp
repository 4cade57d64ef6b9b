#include "planner/controls/gcode/text.h"

#include <algorithm>

#include "planner/ground/base/file.h"
#include "planner/ground/base/number.h"

namespace capstan::controls::gcode {
namespace {

// Characters of a line that a comment's text leaves free; default, unsourced.
constexpr std::size_t kFree = 12;
/// Of lines that go on with a comment: no such line begins as what the check reads (program.h of its room).
constexpr std::string_view kIndent = "   ";
constexpr std::size_t kLongestMarker = 160;
constexpr std::string_view kHex = "0123456789ABCDEF";

}  // namespace

std::string plain_text(std::string_view text) {
  std::string out;
  for (const char c : text) {
    const auto u = static_cast<unsigned char>(c);
    if ((u & 0xC0U) == 0x80U) continue;  // continues a character of UTF-8
    if (c == '(') {
      out += '[';
    } else if (c == ')') {
      out += ']';
    } else if (c == '\n' || c == '\r' || c == '\t') {
      out += ' ';
    } else {
      out += u < 0x20 || u > 0x7E ? '?' : c;
    }
  }
  return out;
}

std::vector<std::string> comment_lines(std::string_view text, std::size_t longest_line) {
  const std::size_t longest = std::max(kIndent.size() + 1, longest_line - std::min(kFree, longest_line));
  std::string rest = plain_text(text);
  std::vector<std::string> out;
  while (rest.size() > longest) {
    // At the last blank that is no indent, else within a word that is longer than a line.
    std::size_t end = rest.rfind(' ', longest);
    if (end == std::string::npos || rest.find_first_not_of(' ') > end) end = longest;
    out.push_back(rest.substr(0, end));
    const std::size_t next = std::min(rest.find_first_not_of(' ', end), rest.size());
    rest = std::string(kIndent) + rest.substr(next);
  }
  if (out.empty() || rest.size() > kIndent.size()) out.push_back(std::move(rest));
  return out;
}

std::string shortened(const std::string& text, std::size_t longest) {
  constexpr std::string_view kMore = "...";
  if (text.size() <= longest) return text;
  const std::size_t room = longest - std::min(longest, kMore.size());
  const std::size_t end = text.rfind(' ', room);
  return text.substr(0, end == std::string::npos || end == 0 ? room : end) + std::string(kMore);
}

std::string marker_text(std::string_view text) {
  std::string out;
  for (const char c : text) {
    const auto u = static_cast<unsigned char>(c);
    if (u <= 0x20 || u > 0x7E || std::string_view("\"%();").find(c) != std::string_view::npos) {
      out += '%';
      out += kHex[u >> 4U];
      out += kHex[u & 15U];
    } else {
      out += c;
    }
  }
  // The hash replaces an id that is too long for a line.
  if (out.size() > kLongestMarker) out = "fnv1a:" + hex64(fnv1a(text));
  return out;
}

}  // namespace capstan::controls::gcode

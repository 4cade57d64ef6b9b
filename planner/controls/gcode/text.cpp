#include "planner/controls/gcode/text.h"

#include <algorithm>

#include "planner/ground/base/file.h"
#include "planner/ground/base/number.h"

namespace capstan::controls::gcode {
namespace {

// Characters of a line that a comment's text leaves free; default, unsourced.
constexpr std::size_t kFree = 12;
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

std::string comment_text(std::string_view text, std::size_t longest_line) {
  return plain_text(text).substr(0, longest_line - std::min(kFree, longest_line));
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

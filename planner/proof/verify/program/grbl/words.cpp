#include "planner/proof/verify/program/grbl/words.h"

#include <algorithm>
#include <cmath>

#include "planner/ground/base/number.h"

// Lines as Grbl takes them in (protocol.c, nuts_bolts.c read_float): blanks and comments away, letters in
// capitals, a number of sign, digits and one point. Some characters never reach a line: Grbl takes them out
// of its input as commands, in comments too (serial.c).

namespace capstan::verify::grbl {
namespace {

/// What such a character does; null: nothing.
const char* command_of(char c) {
  switch (c) {
    case '?':
      return "asks for the state";
    case '!':
      return "holds the feed";
    case '~':
      return "starts what is held";
    case 0x18:
      return "resets the control";
    default:
      return static_cast<unsigned char>(c) >= 0x80 ? "is an override or another command" : nullptr;
  }
}

std::string shown(char c) {
  const auto u = static_cast<unsigned char>(c);
  if (u > 0x20 && u < 0x7F) return std::string("'") + c + "'";
  constexpr std::string_view kHex = "0123456789ABCDEF";
  return std::string("the byte 0x") + kHex[u >> 4U] + kHex[u & 15U];
}

/// Comments out of the text, and what is left of it.
std::string kept(std::string_view text, Line& out) {
  std::string code;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (c == ';') {
      out.comments.emplace_back(text.substr(i + 1));
      break;
    }
    if (c == '(') {
      const std::size_t end = text.find(')', i);
      if (end == std::string_view::npos) {
        out.fault = "a comment is not closed: Grbl passes over all behind it";
        break;
      }
      out.comments.emplace_back(text.substr(i + 1, end - i - 1));
      i = end;
    } else if (c == '/') {
      out.skips = true;
    } else if (c > ' ') {
      code += c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c;
    }
  }
  return code;
}

}  // namespace

Line split_line(std::string_view text) {
  Line out;
  if (!text.empty() && text.back() == '\r') text.remove_suffix(1);
  for (const char c : text) {
    if (const char* what = command_of(c); what != nullptr && out.fault.empty())
      out.fault = shown(c) + " " + what + " wherever it stands, in comments too: take it out";
  }
  const std::string code = kept(text, out);
  out.length = code.size();
  std::string_view rest = code;
  while (out.fault.empty() && !rest.empty()) {
    const char letter = rest.front();
    if (letter < 'A' || letter > 'Z') {
      out.fault = shown(letter) + " is not a word";
      break;
    }
    const std::size_t end = std::min(rest.find_first_not_of("+-.0123456789", 1), rest.size());
    std::string_view digits = rest.substr(1, end - 1);
    const bool sign = !digits.empty() && digits.front() == '+';
    if (sign) digits.remove_prefix(1);
    const auto value = parse_double(digits);
    if (!value || !std::isfinite(*value) || (sign && (digits.front() == '+' || digits.front() == '-'))) {
      out.no_number = true;
      out.fault = std::string(1, letter) + " is not followed by a number (\"" +
                  std::string(rest.substr(1, 12)) + "\")";
      break;
    }
    out.words.push_back({letter, *value});
    rest.remove_prefix(end);
  }
  return out;
}

}  // namespace capstan::verify::grbl

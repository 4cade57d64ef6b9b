#include "planner/ground/base/text.h"

#include <numbers>

#include "planner/ground/base/number.h"

namespace capstan {
namespace {

unsigned char byte_at(std::string_view s, std::size_t i) {
  return i < s.size() ? static_cast<unsigned char>(s[i]) : 0;
}
bool continues(unsigned char c) { return (c & 0xC0U) == 0x80U; }

}  // namespace

std::size_t utf8_length(std::string_view s, std::size_t i) {
  if (i >= s.size()) return 0;
  const unsigned char a = byte_at(s, i);
  const unsigned char b = byte_at(s, i + 1);
  if (a < 0x80) return 1;
  if (a >= 0xC2 && a <= 0xDF) return continues(b) ? 2 : 0;
  if (!continues(byte_at(s, i + 2)) || !continues(b)) return 0;
  if (a >= 0xE0 && a <= 0xEF) {
    const bool overlong = a == 0xE0 && b < 0xA0;
    const bool surrogate = a == 0xED && b > 0x9F;
    return overlong || surrogate ? 0 : 3;
  }
  if (a < 0xF0 || a > 0xF4 || !continues(byte_at(s, i + 3))) return 0;
  return (a == 0xF0 && b < 0x90) || (a == 0xF4 && b > 0x8F) ? 0 : 4;
}

bool is_utf8(std::string_view text) {
  for (std::size_t i = 0; i < text.size();) {
    const std::size_t n = utf8_length(text, i);
    if (n == 0) return false;
    i += n;
  }
  return true;
}

std::string utf8_text(std::string_view text, std::size_t most) {
  std::string out;
  for (std::size_t i = 0; i < text.size();) {
    const std::size_t n = utf8_length(text, i);
    const std::size_t end = i + (n == 0 ? 1 : n);
    if (end > most) break;
    if (n == 0) {
      out += "\xEF\xBF\xBD";
    } else {
      out += text.substr(i, n);
    }
    i = end;
  }
  return out;
}

std::string lower_text(std::string_view text) {
  std::string out(text);
  for (char& c : out) c = c >= 'A' && c <= 'Z' ? static_cast<char>(c + ('a' - 'A')) : c;
  return out;
}

std::string xml_escaped(std::string_view text) {
  std::string out;
  for (const char c : text) {
    if (c == '&') {
      out += "&amp;";
    } else if (c == '<') {
      out += "&lt;";
    } else if (c == '>') {
      out += "&gt;";
    } else if (c == '"') {
      out += "&quot;";
    } else {
      out.push_back(c);
    }
  }
  return out;
}

std::string xml_text(std::string_view text) {
  std::string out = xml_escaped(utf8_text(text));
  for (char& c : out) {
    if (static_cast<unsigned char>(c) < 0x20) c = ' ';
  }
  for (const std::string_view none : {"\xEF\xBF\xBE", "\xEF\xBF\xBF"}) {
    for (std::size_t at = out.find(none); at != std::string::npos; at = out.find(none, at))
      out.replace(at, none.size(), "\xEF\xBF\xBD");
  }
  return out;
}

std::string mm_text(double value, int decimals) { return trimmed(value, decimals) + " mm"; }

std::string deg_text(double rad, int decimals) {
  return trimmed(rad * 180.0 / std::numbers::pi, decimals) + " deg";
}

}  // namespace capstan

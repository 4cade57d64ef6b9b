#include <string>
#include <string_view>

#include "planner/controls/fanuc/fanuc.h"

namespace capstan::controls::fanuc {
namespace {

bool is_small(char c) { return c >= 'a' && c <= 'z'; }
bool is_capital(char c) { return c >= 'A' && c <= 'Z'; }
char capital(char c) { return is_small(c) ? static_cast<char>(c - 'a' + 'A') : c; }

/// What stands between quotes, where `%20` and the like stand for one character.
std::string quoted(std::string_view text, bool capitals) {
  std::string out;
  bool small = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    const bool escapes = c == '%' && i + 2 < text.size();
    // What is no letter is the same in both.
    const bool letter = !escapes && (is_small(c) || is_capital(c));
    const bool is = letter ? capitals && is_small(c) : small;
    if (is != small) out += is ? '<' : '>';
    small = is;
    if (escapes) {
      out += '$';
      out += text.substr(i + 1, 2);
      i += 2;
    } else if (c == '$') {
      out += "$24";
    } else if (c == '<') {
      out += "$3C";
    } else if (c == '>') {
      out += "$3E";
    } else {
      out += capitals ? capital(c) : c;
    }
  }
  return small ? out + '>' : out;
}

}  // namespace

std::string comment_text(std::string_view text, bool capitals) {
  std::string out;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const std::size_t end = text[i] == '"' ? text.find('"', i + 1) : std::string_view::npos;
    if (end != std::string_view::npos) {
      out += '"' + quoted(text.substr(i + 1, end - i - 1), capitals) + '"';
      i = end;
    } else if (text[i] == '%') {
      out += capitals ? "PERCENT" : "percent";
    } else if (text[i] == ';') {
      out += ',';
    } else {
      out += capitals ? capital(text[i]) : text[i];
    }
  }
  return out;
}

}  // namespace capstan::controls::fanuc

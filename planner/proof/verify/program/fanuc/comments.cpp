#include <string>
#include <string_view>

#include "planner/proof/verify/program/fanuc/reader.h"

// Comments in capitals, made into what read_comment (program.h) takes.

namespace capstan::verify::fanuc {
namespace {

std::string small(std::string_view text) {
  std::string out(text);
  for (char& c : out) c = c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  return out;
}

/// `<FINISH>$20A` is `finish%20A`.
std::string unquoted(std::string_view text) {
  std::string out;
  bool lowers = false;
  for (const char c : text) {
    if (c == '<' || c == '>') {
      lowers = c == '<';
    } else if (c == '$') {
      out += '%';
    } else {
      out += lowers ? small(std::string_view(&c, 1)) : std::string(1, c);
    }
  }
  return out;
}

/// `ID="<A>"` is `id="a"`, `TWIST_DRILL` is `twist_drill`; `T1` and `H1` stay.
std::string token(std::string_view text) {
  const std::size_t equals = text.find('=');
  if (equals == std::string_view::npos) {
    const bool number = text.size() > 1 && text[1] >= '0' && text[1] <= '9';
    return number ? std::string(text) : small(text);
  }
  const std::string_view value = text.substr(equals + 1);
  const bool quotes = value.size() > 1 && value.front() == '"' && value.back() == '"';
  return small(text.substr(0, equals + 1)) +
         (quotes ? '"' + unquoted(value.substr(1, value.size() - 2)) + '"' : std::string(value));
}

}  // namespace

std::string plain_comment(std::string_view text) {
  if (text.starts_with("STOCK: ")) return small(text);
  for (const std::string_view kind : {"CAPSTAN STEP ", "CAPSTAN SETUP ", "CAPSTAN TOOL "}) {
    if (!text.starts_with(kind)) continue;
    std::string out(kind);
    for (std::size_t at = kind.size(); at < text.size();) {
      const std::size_t end = std::min(text.find(' ', at), text.size());
      out += (at == kind.size() ? "" : " ") + token(text.substr(at, end - at));
      at = end + 1;
    }
    return out;
  }
  return std::string(text);
}

}  // namespace capstan::verify::fanuc

#include "planner/ground/base/text.h"

#include <numbers>

#include "planner/ground/base/number.h"

namespace capstan {

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

std::string mm_text(double value, int decimals) { return trimmed(value, decimals) + " mm"; }

std::string deg_text(double rad, int decimals) {
  return trimmed(rad * 180.0 / std::numbers::pi, decimals) + " deg";
}

}  // namespace capstan

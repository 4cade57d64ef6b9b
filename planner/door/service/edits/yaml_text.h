#pragma once

#include <string>
#include <string_view>

namespace capstan::service {

/// A scalar that YAML reads back as the text. Needs a text without control characters.
[[nodiscard]] inline std::string yaml_text(std::string_view text) {
  std::string out = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') out += '\\';
    out += c;
  }
  return out + '"';
}

}  // namespace capstan::service

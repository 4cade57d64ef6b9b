#pragma once

#include <algorithm>
#include <array>
#include <cctype>
#include <sstream>
#include <string>
#include <string_view>

// The standard's example 2 with some of its parts left out.

namespace capstan::corpus {

/// "COMPOUND_FEATURE" of "#100= COMPOUND_FEATURE('...".
inline std::string keyword_of(std::string_view line) {
  const auto equals = line.find('=');
  if (line.empty() || line.front() != '#' || equals == std::string_view::npos) return {};
  const auto from = line.find_first_not_of(' ', equals + 1);
  const auto to = line.find('(', from);
  return to == std::string_view::npos ? std::string() : std::string(line.substr(from, to - from));
}

/// Without its holes, and without operations: what is milled, for rules to propose.
inline std::string without_holes(const std::string& text) {
  static constexpr std::array<std::string_view, 6> kGone{
      "ROUND_HOLE", "COMPOUND_FEATURE", "GENERAL_PATTERN", "MACHINING_WORKINGSTEP", "THREAD", "WORKPLAN"};
  std::istringstream in(text);
  std::string out, line;
  while (std::getline(in, line)) {
    const std::string keyword = keyword_of(line);
    const bool main = line.find("'MAIN WORKPLAN'") != std::string::npos;
    if (main) {
      const auto from = line.find("(#"), to = line.find(')', from);
      line.replace(from, to - from + 1, "()");
    }
    if (main || std::find(kGone.begin(), kGone.end(), keyword) == kGone.end()) out += line + "\n";
  }
  return out;
}

}  // namespace capstan::corpus

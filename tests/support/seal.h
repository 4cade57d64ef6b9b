#pragma once

#include <regex>
#include <string>

namespace capstan::testing {

/// A Part 21 file as another system would bring it, without Capstan's seal: its toolpaths count.
inline std::string without_seal(const std::string& file) {
  return std::regex_replace(file, std::regex("!CAPSTAN_SEAL[^\n]*\n"), "");
}

}  // namespace capstan::testing

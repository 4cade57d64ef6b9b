#pragma once

#include <cstdint>
#include <string>

namespace capstan::rules {

/// The line of a character with which no value of a YAML text can begin (for example a "," at the top); 0:
/// there is none. Call it before loading all documents: yaml-cpp makes an empty document of such a file
/// without reading on, for ever. The loader reports all other faults.
[[nodiscard]] std::uint64_t stray_sign(const std::string& text);

}  // namespace capstan::rules

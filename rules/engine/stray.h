#pragma once

#include <cstdint>
#include <string>

namespace capstan::rules {

/// The line of a sign that no value of a YAML text begins with (a "," at the top, for one); 0: there is none.
/// yaml-cpp makes an empty document of it without reading it, and again, without end: to be asked before all
/// documents are loaded. What is wrong otherwise, loading tells.
[[nodiscard]] std::uint64_t stray_sign(const std::string& text);

}  // namespace capstan::rules

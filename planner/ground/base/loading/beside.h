#pragma once

#include <string>
#include <vector>

namespace capstan {

/// Where a file of Capstan's own that is opened or run while it works may lie, best first: in the folder of
/// the program, in `libexec/capstan` beside that folder, and the same of the library that this code is in.
/// Absolute paths; no folder that a caller or its environment names.
[[nodiscard]] std::vector<std::string> places_beside(const std::string& file);

}  // namespace capstan

#pragma once

#include <string>
#include <vector>

namespace capstan {

/// Where a file of Capstan's own that is opened or run while it works may lie, best first: where this code is
/// in a library, in the folder of that and in `libexec/capstan` as it is installed with it; then the same of
/// the program. Absolute paths; no folder that a caller or its environment names.
[[nodiscard]] std::vector<std::string> places_beside(const std::string& file);

}  // namespace capstan

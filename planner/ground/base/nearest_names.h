#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "planner/ground/base/result.h"

namespace capstan {

/// Those of `known` that `asked` may have meant, nearest first, at most `most`. Nearness counts edits: a
/// letter put in, left out, replaced, or two neighbours exchanged; letter case and everything but letters and
/// digits do not count; equally near ones in the order of `known`, of several that differ only in case and
/// punctuation the first. A name of several words is also compared word by word, which counts as one edit
/// more. Further away than half of the letters asked for is not near.
[[nodiscard]] std::vector<std::string> nearest_names(std::string_view asked,
                                                     const std::vector<std::string>& known,
                                                     std::size_t most = 3);

/// The code of `unknown_name`: what the command ends with as wrong usage.
inline constexpr std::string_view kUnknownName = "NAME-UNKNOWN";

/// "unknown material 'steeel'. Did you mean 'mild steel'?; `capstan materials list` shows all".
///
/// what      "material", "machine", "fixture", ...
/// list_by   the command that lists what is known
[[nodiscard]] Diagnostic unknown_name(std::string_view what, std::string_view asked,
                                      const std::vector<std::string>& known, std::string_view list_by);

/// Whether a text that names no file can only be meant as a name: no folder, no ending.
[[nodiscard]] bool only_a_name(std::string_view text);

}  // namespace capstan

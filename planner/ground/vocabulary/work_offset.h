#pragma once

#include <array>
#include <string_view>

namespace capstan::model {

/// The work offsets of RS-274 controls (G54 ...; NIST RS274/NGC 3.5.13), in the order in which set-ups get
/// them.
inline constexpr std::array<std::string_view, 9> kWorkOffsets = {"G54", "G55",   "G56",   "G57",  "G58",
                                                                 "G59", "G59.1", "G59.2", "G59.3"};

}  // namespace capstan::model

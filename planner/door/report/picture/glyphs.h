#pragma once

#include <array>
#include <cstdint>
#include <string_view>
#include <vector>

namespace capstan::report::picture {

/// A character as five columns of dots, from the left; bit 0 is the upper dot, bit 6 that on the base line.
using Glyph = std::array<std::uint8_t, 5>;

/// A glyph per character of UTF-8; what is no printable character of ASCII, and each byte that is no UTF-8,
/// is a box.
[[nodiscard]] std::vector<Glyph> glyphs_of(std::string_view text);

}  // namespace capstan::report::picture

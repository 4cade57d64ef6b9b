#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace capstan::report::picture {

/// Pixels by rows from the upper left corner, three bytes each: red, green, blue.
struct Pixels {
  std::size_t wide = 0, high = 0;
  std::vector<std::uint8_t> rgb;  ///< wide * high * 3 bytes
};

/// The pixels as PNG of 8 bits per channel, without any other data. Needs wide, high > 0. Same pixels, same
/// bytes.
///
/// Source  PNG (ISO/IEC 15948): chunks, CRC; RFC 1950, RFC 1951: one block of the fixed Huffman code.
[[nodiscard]] std::string png_bytes(const Pixels& pixels);

}  // namespace capstan::report::picture

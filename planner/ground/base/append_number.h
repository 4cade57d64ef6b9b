#pragma once

#include <cstddef>
#include <span>
#include <string>

namespace capstan {

/// The printer of numbers where there are millions: `shortest` and `part21_real` of number.h, the same bytes,
/// without a string for each.

/// Room that one number needs, in characters.
inline constexpr std::size_t kNumberRoom = 32;

/// Writes `shortest(value)`, or `part21_real(value)`, to `to` and gives the end. Needs kNumberRoom characters
/// there and a finite value.
[[nodiscard]] char* print_shortest(char* to, double value);
[[nodiscard]] char* print_part21_real(char* to, double value);

/// Appends them.
void append_shortest(std::string& out, double value);
void append_part21_real(std::string& out, double value);
/// Appends `part21_real` of each, with commas between them.
void append_part21_reals(std::string& out, std::span<const double> values);

}  // namespace capstan

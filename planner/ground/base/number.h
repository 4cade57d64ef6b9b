#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace capstan {

/// 2^53: whole numbers up to it are exact as doubles; beyond, doubles are more than 1 apart (IEEE 754).
inline constexpr double kExactWhole = 9007199254740992.0;

/// The one printer of numbers. Locale-free, no `-0`, same value same bytes.

/// Shortest text that reads back to the same double, e.g. "0.1", "1e+30". Needs a finite value.
[[nodiscard]] std::string shortest(double value);

/// Fixed notation with at most `decimals` decimals, trailing zeros kept: fixed(1.5, 3) == "1.500".
[[nodiscard]] std::string fixed(double value, int decimals);

/// As `fixed`, trailing zeros and a trailing point removed: trimmed(1.5, 3) == "1.5".
[[nodiscard]] std::string trimmed(double value, int decimals);

/// A Part 21 REAL: always a point, upper-case E: "5.", "1.5", "1.E+30". Needs a finite value.
[[nodiscard]] std::string part21_real(double value);

/// The value that `fixed(value, decimals)` reads back to: round first, then verify what was rounded.
[[nodiscard]] double rounded(double value, int decimals);

/// The whole text as a finite double, locale-free; nothing when it is not exactly one number.
[[nodiscard]] std::optional<double> parse_double(std::string_view text);

/// "3 findings", "1 finding", "no finding".
[[nodiscard]] std::string counted(std::size_t n, const std::string& one, const std::string& many);

/// The shortest decimal d for which d * factor == value (bit for bit), so that a converted unit is
/// written as it was read: unconverted(720.0, 60.0) == 12.0. Falls back to value / factor.
[[nodiscard]] double unconverted(double value, double factor);

}  // namespace capstan

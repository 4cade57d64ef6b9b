#pragma once

#include <cstdint>
#include <string_view>

/// Numbers of verified spelling.
namespace capstan::p21::detail {

/// The double nearest to a REAL or INTEGER; infinite beyond the range, 0 below it.
[[nodiscard]] double to_real(std::string_view lexeme);

/// An INTEGER that fits.
[[nodiscard]] std::int64_t to_integer(std::string_view lexeme);

/// `#12`, as a number that fits.
[[nodiscard]] std::uint64_t to_id(std::string_view lexeme);

}  // namespace capstan::p21::detail

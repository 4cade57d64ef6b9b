#include "planner/files/p21/read/number.h"

#include <array>
#include <charconv>
#include <cmath>
#include <limits>

namespace capstan::p21::detail {
namespace {

constexpr std::array<double, 23> kPowersOfTen = {1e0,  1e1,  1e2,  1e3,  1e4,  1e5,  1e6,  1e7,
                                                 1e8,  1e9,  1e10, 1e11, 1e12, 1e13, 1e14, 1e15,
                                                 1e16, 1e17, 1e18, 1e19, 1e20, 1e21, 1e22};

/// What from_chars left unread because it is too large or too small: which of the two.
double beyond_range(std::string_view text) {
  long exponent = 0;
  const std::size_t e = text.find_first_of("Ee");
  if (e != std::string_view::npos) {
    std::string_view digits = text.substr(e + 1);
    const bool negative = digits.front() == '-';
    if (negative || digits.front() == '+') digits.remove_prefix(1);
    for (const char c : digits) {
      if (exponent < 1'000'000'000) exponent = exponent * 10 + (c - '0');
    }
    if (negative) exponent = -exponent;
    text = text.substr(0, e);
  }
  const std::size_t first = text.find_first_of("123456789");
  if (first == std::string_view::npos) return 0.0;
  const std::size_t point = text.find('.');
  const auto whole = static_cast<long>(point == std::string_view::npos ? text.size() : point);
  const long magnitude = whole - static_cast<long>(first) + exponent;
  return magnitude > 0 ? std::numeric_limits<double>::infinity() : 0.0;
}

double slow_real(std::string_view text) {
  if (text.front() == '+') text.remove_prefix(1);
  double value = 0.0;
  const auto [end, ec] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (ec != std::errc::result_out_of_range) return value;
  return text.front() == '-' ? -beyond_range(text) : beyond_range(text);
}

}  // namespace

// A mantissa below 2^53 and a power of ten up to 22 are doubles themselves, so that one division or
// multiplication rounds once, correctly (Clinger 1990, section 3). All else goes to from_chars.
double to_real(std::string_view lexeme) {
  const char* p = lexeme.data();
  const char* const end = p + lexeme.size();
  const bool negative = *p == '-';
  if (negative || *p == '+') ++p;
  std::uint64_t mantissa = 0;
  const char* const start = p;
  const char* point = nullptr;
  for (; p != end; ++p) {
    const auto digit = static_cast<unsigned>(*p) - unsigned{'0'};
    if (digit < 10) {
      mantissa = mantissa * 10 + digit;
    } else if (*p == '.') {
      point = p;
    } else {
      break;
    }
  }
  if (p - start > 19) return slow_real(lexeme);  // the mantissa may have overflowed
  long exponent = point == nullptr ? 0 : point + 1 - p;
  if (p != end) {
    ++p;
    const bool minus = *p == '-';
    if (minus || *p == '+') ++p;
    if (end - p > 4) return slow_real(lexeme);
    long written = 0;
    for (; p != end; ++p) written = written * 10 + (*p - '0');
    exponent += minus ? -written : written;
  }
  if (mantissa > std::uint64_t{1} << 53U || exponent < -22 || exponent > 22) return slow_real(lexeme);
  auto value = static_cast<double>(mantissa);
  if (exponent < 0) {
    value /= kPowersOfTen[static_cast<std::size_t>(-exponent)];
  } else {
    value *= kPowersOfTen[static_cast<std::size_t>(exponent)];
  }
  return negative ? -value : value;
}

std::int64_t to_integer(std::string_view lexeme) {
  const bool negative = lexeme.front() == '-';
  if (negative || lexeme.front() == '+') lexeme.remove_prefix(1);
  std::uint64_t value = 0;
  for (const char c : lexeme) value = value * 10 + static_cast<std::uint64_t>(c - '0');
  return static_cast<std::int64_t>(negative ? 0 - value : value);
}

std::uint64_t to_id(std::string_view lexeme) {
  std::uint64_t value = 0;
  for (const char c : lexeme.substr(1)) value = value * 10 + static_cast<std::uint64_t>(c - '0');
  return value;
}

}  // namespace capstan::p21::detail

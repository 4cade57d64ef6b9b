#include "planner/ground/base/number.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <stdexcept>

#include "planner/ground/base/append_number.h"

// Most numbers of a plan have few decimals. Such a number is found and printed as a whole count of
// millionths: where count / 1e6 is the number again, the count has at most 15 digits, and no other decimal of
// so few digits reads back to the same double (IEEE 754: 15 digits survive), so it is the shortest. Between
// 0.001 and 1e5 std::to_chars chooses the fixed notation, for it is never longer there. All others go to
// std::to_chars (Ryu, Adams 2018).

namespace capstan {
namespace {

void need_finite(double value) {
  if (!std::isfinite(value)) throw std::logic_error("a number that is not finite cannot be printed");
}

}  // namespace

namespace {

// Millionths below 1e5 have at most 11 digits.
constexpr double kDecimals = 1e6;
constexpr std::uint64_t kMillionths = 1'000'000;

/// "00" to "99".
constexpr auto kPairs = [] {
  std::array<char, 200> out{};
  for (std::size_t n = 0; n < 100; ++n) {
    out[2 * n] = static_cast<char>('0' + n / 10);
    out[2 * n + 1] = static_cast<char>('0' + n % 10);
  }
  return out;
}();
/// How many digits of these a number needs that ends with them: none of "00", one of "10".
constexpr auto kNeeded = [] {
  std::array<std::uint8_t, 100> out{};
  for (std::size_t n = 1; n < 100; ++n) out[n] = n % 10 == 0 ? 1 : 2;
  return out;
}();

/// Two digits of a number below 100.
char* print_pair(char* to, std::uint32_t n) {
  std::memcpy(to, kPairs.data() + std::size_t{2} * n, 2);
  return to + 2;
}

/// A number below 100 without leading zeros.
char* print_one_or_two(char* to, std::uint32_t n) {
  if (n >= 10) return print_pair(to, n);
  *to = static_cast<char>('0' + n);
  return to + 1;
}

/// A number below 1e6 without leading zeros.
char* print_whole(char* to, std::uint32_t n) {
  if (n < 100) return print_one_or_two(to, n);
  if (n < 10000) return print_pair(print_one_or_two(to, n / 100), n % 100);
  return print_pair(print_pair(print_one_or_two(to, n / 10000), n / 100 % 100), n % 100);
}

/// The number as millionths, where it is so many, and whether it has a point; nullptr where it is not.
struct Printed {
  char* end = nullptr;
  bool point = false;
};
Printed print_few_decimals(char* to, double value) {
  const double size = std::abs(value);
  if (!(size >= 1e-3 && size < 1e5)) return {};
  const auto count = static_cast<std::uint64_t>(size * kDecimals + 0.5);
  if (static_cast<double>(count) / kDecimals != size) return {};
  *to = '-';
  to += value < 0.0 ? 1 : 0;
  to = print_whole(to, static_cast<std::uint32_t>(count / kMillionths));
  const auto rest = static_cast<std::uint32_t>(count % kMillionths);
  if (rest == 0) return {to, false};
  *to++ = '.';
  const std::uint32_t first = rest / 10000, second = rest / 100 % 100, third = rest % 100;
  print_pair(print_pair(print_pair(to, first), second), third);
  // What follows the last digit is printed over.
  const auto digits = third != 0 ? 4 + kNeeded[third] : second != 0 ? 2 + kNeeded[second] : kNeeded[first];
  return {to + digits, true};
}

/// The shortest text of any number.
char* print_any(char* to, double value) {
  if (value == 0.0) {  // also -0
    *to = '0';
    return to + 1;
  }
  return std::to_chars(to, to + kNumberRoom, value).ptr;
}

}  // namespace

char* print_shortest(char* to, double value) {
  need_finite(value);
  const Printed few = print_few_decimals(to, value);
  return few.end != nullptr ? few.end : print_any(to, value);
}

char* print_part21_real(char* to, double value) {
  if (const Printed few = print_few_decimals(to, value); few.end != nullptr) {
    if (!few.point) *few.end = '.';
    return few.point ? few.end : few.end + 1;
  }
  need_finite(value);
  char* const end = print_any(to, value);
  const double size = std::abs(value);
  if (size == 0.0 || (size >= 1e-3 && size < 1e5)) {  // no exponent: the fixed notation is no longer
    if (std::find(to, end, '.') != end) return end;
    *end = '.';
    return end + 1;
  }
  const auto length = static_cast<std::size_t>(end - to);
  auto* e = static_cast<char*>(std::memchr(to, 'e', length));
  if (std::memchr(to, '.', length) == nullptr) {
    char* const at = e == nullptr ? end : e;
    std::memmove(at + 1, at, static_cast<std::size_t>(end - at));
    *at = '.';
    if (e != nullptr) e[1] = 'E';
    return end + 1;
  }
  if (e != nullptr) *e = 'E';
  return end;
}

void append_shortest(std::string& out, double value) {
  std::array<char, kNumberRoom> buffer;
  const char* const end = print_shortest(buffer.data(), value);
  out.append(buffer.data(), static_cast<std::size_t>(end - buffer.data()));
}
void append_part21_real(std::string& out, double value) {
  std::array<char, kNumberRoom> buffer;
  const char* const end = print_part21_real(buffer.data(), value);
  out.append(buffer.data(), static_cast<std::size_t>(end - buffer.data()));
}

void append_part21_reals(std::string& out, std::span<const double> values) {
  std::array<char, 32 * kNumberRoom> buffer;
  char* to = buffer.data();
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (i != 0) *to++ = ',';
    to = print_part21_real(to, values[i]);
    if (static_cast<std::size_t>(to - buffer.data()) > buffer.size() - 2 * kNumberRoom) {
      out.append(buffer.data(), static_cast<std::size_t>(to - buffer.data()));
      to = buffer.data();
    }
  }
  out.append(buffer.data(), static_cast<std::size_t>(to - buffer.data()));
}

std::string shortest(double value) {
  std::array<char, kNumberRoom> buffer;
  return {buffer.data(), print_shortest(buffer.data(), value)};
}

namespace {

/// A number as a whole count of its last decimal, where that count is sure: value = count / scale to the
/// nearest.
struct Count {
  double whole = 0.0, scale = 1.0;
};

// The product is wrong by half a unit in the last place at most. Farther than that from a tie the whole
// number next to it is the one next to the exact product, too; below 1e15 it has 15 digits, and its quotient
// by a power of ten, which is exact, is the double next to the decimal (IEEE 754).
std::optional<Count> count_of(double value, int decimals) {
  constexpr std::array<double, 13> kScales{1e0, 1e1, 1e2, 1e3,  1e4,  1e5, 1e6,
                                           1e7, 1e8, 1e9, 1e10, 1e11, 1e12};
  if (decimals < 0 || static_cast<std::size_t>(decimals) >= kScales.size()) return std::nullopt;
  const double scale = kScales[static_cast<std::size_t>(decimals)];
  const double product = value * scale;
  const double size = std::abs(product);
  if (!(size < 1e15)) return std::nullopt;
  const double whole = std::nearbyint(product);
  if (!(0.5 - std::abs(product - whole) > size * 0x1p-52)) return std::nullopt;
  return Count{whole, scale};
}

}  // namespace

std::string fixed(double value, int decimals) {
  need_finite(value);
  if (const auto count = count_of(value, decimals)) {
    std::array<char, kNumberRoom> text;
    char* end = text.data();
    if (count->whole < 0.0) *end++ = '-';
    const auto all = static_cast<std::uint64_t>(std::abs(count->whole));
    const auto one = static_cast<std::uint64_t>(count->scale);
    end = std::to_chars(end, text.data() + text.size(), all / one).ptr;
    if (decimals > 0) *end++ = '.';
    std::uint64_t rest = all % one;
    for (std::uint64_t place = one / 10; place > 0; place /= 10) {
      *end++ = static_cast<char>('0' + rest / place);
      rest %= place;
    }
    return {text.data(), end};
  }
  std::array<char, 400> buffer{};
  const auto [end, ec] =
      std::to_chars(buffer.data(), buffer.data() + buffer.size(), value, std::chars_format::fixed, decimals);
  std::string out(buffer.data(), end);
  if (out.front() == '-' && out.find_first_not_of("-0.") == std::string::npos) out.erase(0, 1);
  return out;
}

std::string trimmed(double value, int decimals) {
  std::string out = fixed(value, decimals);
  if (out.find('.') == std::string::npos) return out;
  out.erase(out.find_last_not_of('0') + 1);
  if (out.back() == '.') out.pop_back();
  return out;
}

std::string part21_real(double value) {
  std::array<char, kNumberRoom> buffer;
  return {buffer.data(), print_part21_real(buffer.data(), value)};
}

double rounded(double value, int decimals) {
  if (const auto count = count_of(value, decimals))
    return count->whole == 0.0 ? 0.0 : count->whole / count->scale;
  return *parse_double(fixed(value, decimals));
}

std::optional<double> parse_double(std::string_view text) {
  if (!text.empty() && text.front() == '+') text.remove_prefix(1);
  double value = 0.0;
  const auto [end, ec] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (ec != std::errc() || end != text.data() + text.size() || !std::isfinite(value)) return std::nullopt;
  return value;
}

double unconverted(double value, double factor) {
  const double raw = value / factor;
  if (!std::isfinite(raw)) return raw;
  std::array<char, 40> buffer{};
  for (int digits = 12; digits <= 17; ++digits) {
    const auto [end, ec] =
        std::to_chars(buffer.data(), buffer.data() + buffer.size(), raw, std::chars_format::general, digits);
    double candidate = 0.0;
    std::from_chars(buffer.data(), end, candidate);
    if (candidate * factor == value) return candidate;
  }
  return raw;
}

std::string counted(std::size_t n, const std::string& one, const std::string& many) {
  if (n == 0) return "no " + one;
  return std::to_string(n) + " " + (n == 1 ? one : many);
}

}  // namespace capstan

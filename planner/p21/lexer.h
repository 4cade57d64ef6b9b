#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#ifdef __SSE2__
#include <emmintrin.h>
#endif

/// The byte-level scanners of the parser. All read a buffer that a NUL byte ends.
namespace capstan::p21::detail {

enum class Class : std::uint8_t {
  kOther,
  kSpace,  ///< also what may begin a comment or a print control directive
  kDigit,  ///< and signs
  kLetter,
  kQuote,
  kHash,
  kDot,
  kDoubleQuote,
  kDollar,
  kStar,
  kOpen,
};

namespace table {

constexpr std::array<Class, 256> classes() {
  std::array<Class, 256> t{};
  for (const char c : {' ', '\t', '\n', '\r', '\v', '\f', '/', '\\'})
    t[static_cast<unsigned char>(c)] = Class::kSpace;
  for (unsigned c = '0'; c <= '9'; ++c) t[c] = Class::kDigit;
  t['+'] = t['-'] = Class::kDigit;
  for (unsigned c = 'A'; c <= 'Z'; ++c) t[c] = t[c + 32] = Class::kLetter;
  t['_'] = t['!'] = Class::kLetter;
  t['\''] = Class::kQuote;
  t['#'] = Class::kHash;
  t['.'] = Class::kDot;
  t['"'] = Class::kDoubleQuote;
  t['$'] = Class::kDollar;
  t['*'] = Class::kStar;
  t['('] = Class::kOpen;
  return t;
}

/// 1: may stand in a keyword as it is; 2: a lower-case letter.
constexpr std::array<std::uint8_t, 256> word() {
  std::array<std::uint8_t, 256> t{};
  for (unsigned c = '0'; c <= '9'; ++c) t[c] = 1;
  for (unsigned c = 'A'; c <= 'Z'; ++c) {
    t[c] = 1;
    t[c + 32] = 2;
  }
  t['_'] = 1;
  return t;
}

inline constexpr auto kClasses = classes();
inline constexpr auto kWord = word();

}  // namespace table

[[nodiscard]] inline Class class_of(char c) { return table::kClasses[static_cast<unsigned char>(c)]; }
[[nodiscard]] inline std::uint8_t word_class(char c) { return table::kWord[static_cast<unsigned char>(c)]; }
[[nodiscard]] inline bool is_digit(char c) { return static_cast<unsigned char>(c - '0') < 10; }
[[nodiscard]] inline const char* skip_digits(const char* p) {
  while (is_digit(*p)) ++p;
  return p;
}

/// Whether a byte of a string needs a look: a quote, a backslash, or one outside printable ASCII.
[[nodiscard]] inline bool is_special(char c) {
  return c == '\'' || c == '\\' || static_cast<signed char>(c) < 0x20 || c == 0x7F;
}

/// The first special byte at or behind p; `end` (where a NUL stands) at the latest.
[[nodiscard]] inline const char* find_special(const char* p, const char* end) {
#ifdef __SSE2__
  while (end - p >= 16) {
    const __m128i v = _mm_loadu_si128(reinterpret_cast<const __m128i*>(p));
    const __m128i hit = _mm_or_si128(
        _mm_or_si128(_mm_cmpeq_epi8(v, _mm_set1_epi8('\'')), _mm_cmpeq_epi8(v, _mm_set1_epi8('\\'))),
        _mm_or_si128(_mm_cmplt_epi8(v, _mm_set1_epi8(0x20)), _mm_cmpeq_epi8(v, _mm_set1_epi8(0x7F))));
    const auto mask = static_cast<unsigned>(_mm_movemask_epi8(hit));
    if (mask != 0) return p + __builtin_ctz(mask);
    p += 16;
  }
#endif
  while (!is_special(*p)) ++p;
  (void)end;
  return p;
}

}  // namespace capstan::p21::detail

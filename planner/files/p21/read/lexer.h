#pragma once

#include <array>
#include <bit>
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

/// Sixteen bytes and what they are, one bit each. Reads p[0] to p[15].
class Sixteen {
 public:
#ifdef __SSE2__
  explicit Sixteen(const char* p) : v_(_mm_loadu_si128(reinterpret_cast<const __m128i*>(p))) {}
  [[nodiscard]] unsigned digits() const { return bits(range('0', 10)); }
  [[nodiscard]] unsigned points() const { return bits(_mm_cmpeq_epi8(v_, _mm_set1_epi8('.'))); }
  /// Capitals, digits and _.
  [[nodiscard]] unsigned word() const {
    return bits(
        _mm_or_si128(_mm_or_si128(range('A', 26), range('0', 10)), _mm_cmpeq_epi8(v_, _mm_set1_epi8('_'))));
  }

 private:
  [[nodiscard]] __m128i range(char first, char count) const {
    const __m128i from = _mm_sub_epi8(v_, _mm_set1_epi8(first));
    return _mm_cmpeq_epi8(_mm_min_epu8(from, _mm_set1_epi8(static_cast<char>(count - 1))), from);
  }
  [[nodiscard]] static unsigned bits(__m128i v) { return static_cast<unsigned>(_mm_movemask_epi8(v)); }
  __m128i v_;
#else
  explicit Sixteen(const char* p) : p_(p) {}
  [[nodiscard]] unsigned digits() const {
    return bits([](char c) { return is_digit(c); });
  }
  [[nodiscard]] unsigned points() const {
    return bits([](char c) { return c == '.'; });
  }
  [[nodiscard]] unsigned word() const {
    return bits([](char c) { return word_class(c) == 1; });
  }

 private:
  template <class Test>
  [[nodiscard]] unsigned bits(Test test) const {
    unsigned out = 0;
    for (unsigned i = 0; i < 16; ++i) out |= (test(p_[i]) ? 1U : 0U) << i;
    return out;
  }
  const char* p_;
#endif
};

/// The number of bits set from the lowest on.
[[nodiscard]] inline unsigned leading(unsigned mask) { return static_cast<unsigned>(std::countr_one(mask)); }

}  // namespace capstan::p21::detail

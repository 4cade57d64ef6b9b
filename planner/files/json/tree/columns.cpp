#include "planner/files/json/tree/columns.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cstring>
#include <utility>

#include "planner/ground/base/memory/grow.h"
#include "planner/ground/base/stopping.h"

// A general parser of JSON makes a value of each number: a plan of a million path points has twenty million
// of them. Here they are read where they stand. A number of at most 15 digits whose power of ten is at most
// 22 is one division or product of two exact doubles, which IEEE 754 rounds correctly (Clinger, "How to read
// floating point numbers accurately", 1990); all others go to std::from_chars.

namespace capstan::json {
namespace {

constexpr int kColumnLevel = 4;
constexpr int kExactDigits = 15;  // below 2^53

constexpr std::array<double, 23> kTen = {1e0,  1e1,  1e2,  1e3,  1e4,  1e5,  1e6,  1e7,
                                         1e8,  1e9,  1e10, 1e11, 1e12, 1e13, 1e14, 1e15,
                                         1e16, 1e17, 1e18, 1e19, 1e20, 1e21, 1e22};

bool is_digit(char c) { return c >= '0' && c <= '9'; }
bool is_space(char c) { return c == ' ' || c == '\t' || c == '\n' || c == '\r'; }

/// One number of RFC 8259 at `p`; false when there is none, or none that a double holds.
bool number(const char*& p, const char* end, double& value, bool& whole) {
  const char* const start = p;
  const bool negative = p != end && *p == '-';
  if (negative) ++p;
  if (p == end || !is_digit(*p)) return false;
  if (*p == '0' && p + 1 != end && is_digit(p[1])) return false;
  std::uint64_t digits = 0;
  int count = 0, decimals = 0;
  const auto take = [&] {
    for (; p != end && is_digit(*p); ++p) {
      if (count < kExactDigits) digits = 10 * digits + static_cast<std::uint64_t>(*p - '0');
      if (count != 0 || *p != '0') ++count;
    }
  };
  take();
  bool exact = true;
  if (p != end && *p == '.') {
    whole = false;
    const char* const point = ++p;
    take();
    if (p == point) return false;
    decimals = static_cast<int>(std::min<std::ptrdiff_t>(p - point, 100));
  }
  if (p != end && (*p == 'e' || *p == 'E')) {
    whole = exact = false;
    ++p;
    if (p != end && (*p == '+' || *p == '-')) ++p;
    if (p == end || !is_digit(*p)) return false;
    while (p != end && is_digit(*p)) ++p;
  }
  // A whole number that a double may not hold: what it is read into decides.
  if (whole && count > kExactDigits) return false;
  if (exact && count <= kExactDigits && decimals < static_cast<int>(kTen.size())) {
    value = static_cast<double>(digits) / kTen[static_cast<std::size_t>(decimals)];
    if (negative && (digits != 0 || !whole)) value = -value;
    return true;
  }
  const auto [stop, ec] = std::from_chars(start, p, value);
  return ec == std::errc() && stop == p;
}

/// How many numbers there are to the column's closing bracket, the one that ends at `p` counted: its memory
/// is asked for at once. 0: something else stands before it.
std::size_t numbers_behind(const char* p, const char* end) {
  std::size_t n = 1;
  bool digits = true;
  for (; p != end && *p != ']'; ++p) {
    if (*p == ',') {
      if (!std::exchange(digits, false)) return 0;
      ++n;
    } else if (is_digit(*p)) {
      digits = true;
    } else if (!is_space(*p) && *p != '.' && *p != '-' && *p != '+' && *p != 'e' && *p != 'E') {
      return 0;
    }
  }
  return p == end || !digits ? 0 : n;
}

/// The column whose bracket opens before `p`, which is moved behind its closing one; false when it is none.
/// `lines`: the line ends in it.
bool column(const char*& p, const char* end, Column& out, std::size_t& lines) {
  const char* at = p;
  const auto skip = [&] {
    for (; at != end && is_space(*at); ++at) lines += *at == '\n' ? 1U : 0U;
  };
  std::size_t n = 0;
  for (;;) {
    tick();
    skip();
    double value = 0.0;
    bool whole = true;
    if (!number(at, end, value, whole)) return false;
    if (!whole && !out.not_whole) out.not_whole = n;
    if (n == kLeastColumn) {
      const std::size_t more = numbers_behind(at, end);
      if (more == 0) return false;
      grow(out.bytes, (n + more) * sizeof value);
    }
    if (out.bytes.size() < (n + 1) * sizeof value) out.bytes.resize((n + 1) * sizeof value);
    std::memcpy(out.bytes.data() + n * sizeof value, &value, sizeof value);
    ++n;
    skip();
    if (at == end) return false;
    const char c = *at++;
    if (c == ']') break;
    if (c != ',') return false;
  }
  if (n < kLeastColumn) return false;
  p = at;
  return true;
}

}  // namespace

Columns take_columns(std::string_view text) {
  Columns out;
  const char* p = text.data();
  const char* const end = p + text.size();
  out.rest.reserve(text.size());
  const char* kept = p;  // what is before it is in the rest
  std::size_t arrays = 0;
  int level = 0;
  while (p != end) {
    const char c = *p++;
    if (c == '"') {
      for (; p != end && *p != '"'; ++p) {
        if (*p == '\\' && p + 1 != end) ++p;
      }
      if (p != end) ++p;
    } else if (c == '[' || c == '{') {
      tick();
      out.deepest = std::max(out.deepest, ++level);
      if (c == '{') continue;
      Column taken;
      std::size_t lines = 0;
      const char* const inside = p;
      if (level == kColumnLevel && column(p, end, taken, lines)) {
        out.rest.append(kept, inside);
        out.rest.append(lines, '\n').append(1, ']');
        kept = p;
        --level;
        taken.array = arrays;
        out.columns.push_back(std::move(taken));
      }
      ++arrays;
    } else if (c == ']' || c == '}') {
      --level;
    }
  }
  out.rest.append(kept, end);
  return out;
}

}  // namespace capstan::json

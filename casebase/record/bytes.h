#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>
#include <type_traits>

namespace capstan::casebase {

/// The bytes of an unsigned integer, little endian.
template <class U>
std::array<char, sizeof(U)> bytes_of(U v) {
  static_assert(std::is_unsigned_v<U>);
  std::array<char, sizeof(U)> out;
  for (std::size_t i = 0; i < sizeof(U); ++i)
    out[i] = static_cast<char>(static_cast<std::uint8_t>(static_cast<std::uint64_t>(v) >> (8 * i)));
  return out;
}
/// Appends them.
template <class U>
void put(std::string& to, U v) {
  const auto bytes = bytes_of(v);
  to.append(bytes.data(), bytes.size());
}
/// Appends a number; -0 and 0 are one.
inline void put(std::string& to, double v) { put(to, std::bit_cast<std::uint64_t>(v + 0.0)); }
/// Appends a text behind its length. Needs at most 65535 bytes.
inline void put(std::string& to, std::string_view text) {
  put(to, static_cast<std::uint16_t>(text.size()));
  to += text;
}

/// Reads what `put` wrote. Past the end everything is zero and `good` is false.
class Bytes {
 public:
  explicit Bytes(std::string_view bytes) : left_(bytes) {}
  [[nodiscard]] bool good() const { return good_; }
  [[nodiscard]] bool at_end() const { return left_.empty(); }
  [[nodiscard]] std::size_t left() const { return left_.size(); }

  template <class U>
  U integer() {
    static_assert(std::is_unsigned_v<U>);
    const std::string_view bytes = take(sizeof(U));
    if (bytes.empty()) return 0;
    U v = 0;
    if constexpr (std::endian::native == std::endian::little) {
      std::memcpy(&v, bytes.data(), sizeof(U));
    } else {
      for (std::size_t i = sizeof(U); i-- > 0;)
        v = static_cast<U>(static_cast<std::uint64_t>(v) << 8 | static_cast<std::uint8_t>(bytes[i]));
    }
    return v;
  }
  double number() { return std::bit_cast<double>(integer<std::uint64_t>()); }
  std::string_view text() { return take(integer<std::uint16_t>()); }
  std::string_view take(std::size_t n) {
    if (n > left_.size()) {
      good_ = false;
      left_ = {};
      return {};
    }
    const std::string_view taken = left_.substr(0, n);
    left_.remove_prefix(n);
    return taken;
  }

 private:
  std::string_view left_;
  bool good_ = true;
};

}  // namespace capstan::casebase

#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include "planner/ground/base/memory/grow.h"
#include "planner/ground/base/shared_text.h"
#include "planner/ground/base/stopping.h"
#include "planner/ground/memo/fields.h"

// Values as bytes, and back: numbers, enumerations, text, vectors, maps, pairs, optionals, shared constants,
// pointers, and structs of these, field by field in the order of their declaration. Arrays and variants are
// packed only, for keys. A pointer is packed as what it points to, for keys; in a value that is read back it
// must be null. Structs need no list of their fields (fields.h): a new field is packed like the others.
//
// The form is that of this build on this machine (byte order, enumerators, fields). It is written by a memo
// and read by one of the same build only. What is read is checked for length, never for sense.

namespace capstan::memo {

namespace detail {

template <class T>
inline constexpr bool kPlain = std::is_arithmetic_v<T> || std::is_enum_v<T>;

/// Whether T is made of this template: kIs<std::vector<int>, std::vector>.
template <class T, template <class...> class Of>
inline constexpr bool kIs = false;
template <template <class...> class Of, class... Arguments>
inline constexpr bool kIs<Of<Arguments...>, Of> = true;

template <class T>
inline constexpr bool kArray = false;
template <class T, std::size_t N>
inline constexpr bool kArray<std::array<T, N>> = true;

/// Appends in parts, between which `poll` is asked: pages that are new to it cost more than what is copied.
inline void append(std::string& out, const char* from, std::size_t n) {
  constexpr std::size_t kAtOnce = std::size_t{32} << 10;
  for (std::size_t i = 0; i < n; i += kAtOnce) {
    if (i > 0) poll();
    out.append(from + i, std::min(kAtOnce, n - i));
  }
}

/// Counts bytes in place of keeping them.
struct Counted {
  std::size_t bytes = 0;
};
inline void append(Counted& out, const char*, std::size_t n) { out.bytes += n; }

}  // namespace detail

/// Appends a value to the bytes.
template <class Out, class T>
void pack(Out& out, const T& v) {
  using namespace detail;
  if constexpr (kPlain<T>) {
    char raw[sizeof(T)];
    std::memcpy(raw, &v, sizeof(T));
    append(out, raw, sizeof(T));
  } else if constexpr (std::is_same_v<T, std::string>) {
    pack(out, static_cast<std::uint64_t>(v.size()));
    append(out, v.data(), v.size());
  } else if constexpr (std::is_same_v<T, SharedText>) {
    pack(out, v.text());
  } else if constexpr (kIs<T, std::vector>) {
    using E = typename T::value_type;
    pack(out, static_cast<std::uint64_t>(v.size()));
    if constexpr (kPlain<E> && !std::is_same_v<E, bool>) {
      append(out, reinterpret_cast<const char*>(v.data()), v.size() * sizeof(E));
    } else {
      for (const auto& e : v) {
        tick();
        pack(out, static_cast<const E&>(e));
      }
    }
  } else if constexpr (kIs<T, std::map>) {
    pack(out, static_cast<std::uint64_t>(v.size()));
    for (const auto& [key, value] : v) {
      pack(out, key);
      pack(out, value);
    }
  } else if constexpr (kIs<T, std::pair>) {
    pack(out, v.first);
    pack(out, v.second);
  } else if constexpr (kIs<T, std::optional>) {
    pack(out, v.has_value());
    if (v) pack(out, *v);
  } else if constexpr (kArray<T>) {
    for (const auto& e : v) pack(out, e);
  } else if constexpr (kIs<T, std::variant>) {
    pack(out, static_cast<std::uint64_t>(v.index()));
    std::visit([&](const auto& one) { pack(out, one); }, v);
  } else if constexpr (kIs<T, std::shared_ptr> || std::is_pointer_v<T>) {
    if constexpr (std::is_pointer_v<T>)
      static_assert(!std::is_same_v<std::remove_cv_t<std::remove_pointer_t<T>>, char>,
                    "a text is no single character");
    pack(out, v != nullptr);
    if (v != nullptr) pack(out, *v);
  } else {
    static_assert(std::is_aggregate_v<T>, "packed field by field: needs a struct without constructors");
    each_field(v, [&](const auto& field) { pack(out, field); });
  }
}

/// How many bytes `pack` appends: to ask for them at once. What grows with a long value copies what is there
/// again and again.
template <class T>
[[nodiscard]] std::size_t packed_size(const T& v) {
  detail::Counted out;
  pack(out, v);
  return out.bytes;
}

/// Reads values in the order in which they were packed. After bytes that are too few `whole` is false, and
/// what was read is to be thrown away.
class Unpacker {
 public:
  explicit Unpacker(std::string_view bytes) : bytes_(bytes) {}
  [[nodiscard]] bool whole() const { return whole_; }
  [[nodiscard]] bool at_end() const { return whole_ && bytes_.empty(); }

  template <class T>
  void read(T& v) {
    using namespace detail;
    if constexpr (std::is_same_v<T, bool>) {
      std::uint8_t byte = 0;
      raw(&byte, 1);
      v = byte != 0;
    } else if constexpr (kPlain<T>) {
      raw(&v, sizeof(T));
    } else if constexpr (std::is_same_v<T, std::string>) {
      const std::size_t n = count(1);
      v.assign(bytes_.substr(0, n));
      bytes_.remove_prefix(n);
    } else if constexpr (std::is_same_v<T, SharedText>) {
      std::string text;
      read(text);
      v = std::move(text);
    } else if constexpr (kIs<T, std::vector>) {
      using E = typename T::value_type;
      if constexpr (kPlain<E> && !std::is_same_v<E, bool>) {
        const std::size_t n = count(sizeof(E));
        v.clear();
        grow(v, n);
        raw(v.data(), n * sizeof(E));
      } else {
        const std::size_t n = count(1);
        v.clear();
        v.reserve(std::min(n, bytes_.size() / sizeof(E) + 1));
        for (std::size_t i = 0; i < n && whole_; ++i) {
          E e{};
          read(e);
          v.push_back(std::move(e));
        }
      }
    } else if constexpr (kIs<T, std::map>) {
      const std::size_t n = count(1);
      v.clear();
      for (std::size_t i = 0; i < n && whole_; ++i) {
        typename T::key_type key{};
        typename T::mapped_type value{};
        read(key);
        read(value);
        v.insert_or_assign(std::move(key), std::move(value));
      }
    } else if constexpr (kIs<T, std::pair>) {
      read(v.first);
      read(v.second);
    } else if constexpr (kIs<T, std::optional>) {
      bool there = false;
      read(there);
      if (!there) {
        v.reset();
        return;
      }
      read(v.emplace());
    } else if constexpr (std::is_pointer_v<T>) {
      bool there = false;
      read(there);
      whole_ = whole_ && !there;
      v = nullptr;
    } else if constexpr (kIs<T, std::shared_ptr>) {
      using E = std::remove_const_t<typename T::element_type>;
      bool there = false;
      read(there);
      if (!there) {
        v.reset();
        return;
      }
      auto value = std::make_shared<E>();
      read(*value);
      v = std::move(value);
    } else {
      static_assert(std::is_aggregate_v<T>);
      each_field(v, [&](auto& field) { read(field); });
    }
  }

 private:
  void raw(void* to, std::size_t n) {
    if (!whole_ || n > bytes_.size()) {
      whole_ = false;
      return;
    }
    if (n > 0) std::memcpy(to, bytes_.data(), n);
    bytes_.remove_prefix(n);
  }
  /// A number of elements of at least `least` bytes each; 0 where so many cannot follow.
  std::size_t count(std::size_t least) {
    std::uint64_t n = 0;
    raw(&n, sizeof n);
    if (n > bytes_.size() / least) whole_ = false;
    return whole_ ? static_cast<std::size_t>(n) : 0;
  }

  std::string_view bytes_;
  bool whole_ = true;
};

/// The value that all of the bytes say; nothing where they are too few or too many.
template <class T>
[[nodiscard]] std::optional<T> unpacked(std::string_view bytes) {
  T out{};
  Unpacker from(bytes);
  from.read(out);
  if (!from.at_end()) return std::nullopt;
  return out;
}

}  // namespace capstan::memo

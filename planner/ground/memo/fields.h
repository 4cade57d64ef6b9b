#pragma once

#include <array>
#include <cstddef>
#include <type_traits>
#include <utility>

// The fields of a struct without constructors, in the order of their declaration, without naming them: how
// many there are is how many values may stand between its braces, and a structured binding of so many names
// gives each. (Boost.PFR does the same; its counting makes GCC 12 fail with an internal error on structs of
// fifty fields.)

namespace capstan::memo {

namespace detail {

/// Stands for a value of any type; only ever asked whether it would do.
struct Any {
  template <class T>
  operator T() const;  // NOLINT: implicit on purpose
};

template <class T, std::size_t... I>
constexpr bool takes(std::index_sequence<I...>) {
  return requires { T{(static_cast<void>(I), Any{})...}; };
}

/// What a struct takes it takes less of, too: halved until the largest number is found.
template <class T, std::size_t Low, std::size_t High>
constexpr std::size_t fields_between() {
  if constexpr (Low == High) {
    return Low;
  } else {
    constexpr std::size_t kMiddle = (Low + High + 1) / 2;
    if constexpr (takes<T>(std::make_index_sequence<kMiddle>{})) {
      return fields_between<T, kMiddle, High>();
    } else {
      return fields_between<T, Low, kMiddle - 1>();
    }
  }
}

}  // namespace detail

inline constexpr std::size_t kMostFields = 64;

template <class T>
inline constexpr std::size_t kFields = detail::fields_between<std::remove_cv_t<T>, 0, kMostFields + 1>();

/// Calls body(field) for each field of v, which may be const.
template <class T, class Body>
void each_field(T& v, Body&& body) {
  constexpr std::size_t kCount = kFields<T>;
  static_assert(std::is_aggregate_v<std::remove_cv_t<T>>, "needs a struct without constructors");
  static_assert(kCount <= kMostFields, "more fields than planner/ground/memo/bindings.inc binds");
  const auto all = [&](auto&... field) { (body(field), ...); };
  if constexpr (kCount == 0) {
  }
#include "planner/ground/memo/bindings.inc"
}

}  // namespace capstan::memo

#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <initializer_list>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "planner/ground/geometry/vec.h"
#include "planner/model/plan/fields.h"

/// @file Fields of two plans side by side, within the resolution of a plan's numbers.

namespace capstan::model {

/// Two numbers of two plans are the same when they agree within a millionth, of a mm, N, W and so on, the
/// grid that areas of paths lie on (geometry::kRegionGrid), or within a thousand-millionth of the larger: an
/// inch file of the same piece says its lengths in other digits, and what is computed of them differs in the
/// last ones.
inline constexpr double kSameNumber = 1e-6, kSameShare = 1e-9;

[[nodiscard]] inline bool same_value(double a, double b) {
  if (a == b) return true;
  if (!std::isfinite(a) || !std::isfinite(b)) return false;
  return std::abs(a - b) <= std::max(kSameNumber, kSameShare * std::max(std::abs(a), std::abs(b)));
}
[[nodiscard]] inline bool same_value(const geometry::Vec3& a, const geometry::Vec3& b) {
  return same_value(a.x, b.x) && same_value(a.y, b.y) && same_value(a.z, b.z);
}
template <class T>
[[nodiscard]] bool same_value(const T& a, const T& b);
template <class T>
[[nodiscard]] bool same_value(const std::optional<T>& a, const std::optional<T>& b);
template <class T, std::size_t N>
[[nodiscard]] bool same_value(const std::array<T, N>& a, const std::array<T, N>& b);
template <class T>
[[nodiscard]] bool same_value(const std::vector<T>& a, const std::vector<T>& b);

template <class T>
bool same_value(const std::optional<T>& a, const std::optional<T>& b) {
  return a.has_value() == b.has_value() && (!a || same_value(*a, *b));
}
template <class T, std::size_t N>
bool same_value(const std::array<T, N>& a, const std::array<T, N>& b) {
  return std::equal(a.begin(), a.end(), b.begin(), [](const T& x, const T& y) { return same_value(x, y); });
}
template <class T>
bool same_value(const std::vector<T>& a, const std::vector<T>& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [](const T& x, const T& y) { return same_value(x, y); });
}
/// A struct with a table of fields: each of them. Of other types: equal.
template <class T>
bool same_value(const T& a, const T& b) {
  if constexpr (HasFields<T>) {
    bool same = true;
    for_each_field(
        a, [&](const auto& row, const auto& value) { same = same && same_value(value, b.*row.member); });
    return same;
  } else {
    return a == b;
  }
}

/// The names of the fields in which two differ, in order and with commas between; of those that diff tells,
/// but for those that it tells elsewhere, by name.
template <HasFields S>
[[nodiscard]] std::string told_differences(const S& a, const S& b,
                                           std::initializer_list<std::string_view> elsewhere = {}) {
  std::string out;
  for_each_field(a, [&](const auto& row, const auto& value) {
    const bool is_elsewhere = std::find(elsewhere.begin(), elsewhere.end(), row.name) != elsewhere.end();
    if (row.not_told == nullptr && !is_elsewhere && !same_value(value, b.*row.member))
      out += (out.empty() ? "" : ", ") + std::string(row.name);
  });
  return out;
}

}  // namespace capstan::model

#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

#include "planner/ground/base/stopping.h"

namespace capstan {

/// Lengthens a column to `n` values, in parts between which `poll` is asked: a page of memory that was not
/// touched before costs more than the numbers that are written to it.
template <class T>
void grow(std::vector<T>& column, std::size_t n, const T& value = {}) {
  constexpr std::size_t kAtOnce = std::max<std::size_t>(1, (std::size_t{32} << 10) / sizeof(T));
  column.reserve(n);
  while (column.size() < n) {
    column.resize(std::min(n, column.size() + kAtOnce), value);
    poll();
  }
}

}  // namespace capstan

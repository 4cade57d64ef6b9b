#include "planner/proof/verify/sweep/grid/heights_before.h"

#include <algorithm>

#include "planner/ground/base/stopping.h"

namespace capstan::verify {
namespace {

constexpr std::size_t kAtOnce = 1 << 16;  // a new page costs more than its numbers

/// Calls `f(from, to)` for pieces of the cells, with a look at the clock between them, while it gives true.
template <class F>
bool by_pieces(std::size_t cells, const F& f) {
  for (std::size_t i = 0; i < cells; i += kAtOnce) {
    if (!f(static_cast<std::ptrdiff_t>(i), static_cast<std::ptrdiff_t>(std::min(cells, i + kAtOnce))))
      return false;
    poll();
  }
  return true;
}

}  // namespace

void HeightsBefore::keep(const std::vector<double>& now) {
  cells_ = now.size();
  all_ = now.empty() ? 0.0 : now.front();
  each_.clear();
  const bool level = by_pieces(cells_, [&](std::ptrdiff_t from, std::ptrdiff_t to) {
    return std::all_of(now.begin() + from, now.begin() + to, [&](double z) { return z == all_; });
  });
  if (level) return;
  each_.reserve(cells_);
  by_pieces(cells_, [&](std::ptrdiff_t from, std::ptrdiff_t to) {
    each_.insert(each_.end(), now.begin() + from, now.begin() + to);
    return true;
  });
}

}  // namespace capstan::verify

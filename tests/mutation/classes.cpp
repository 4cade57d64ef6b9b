#include "tests/mutation/classes.h"

#include <algorithm>

namespace capstan::mutation {

std::uint64_t Random::next() {
  state_ ^= state_ >> 12U;
  state_ ^= state_ << 25U;
  state_ ^= state_ >> 27U;
  return state_ * 0x2545f4914f6cdd1dU >> 11U;
}

double Random::between(double lo, double hi) {
  const auto steps = static_cast<std::size_t>((hi - lo) * 100.0);
  return lo + static_cast<double>(below(std::max<std::size_t>(steps, 1))) / 100.0;
}

const std::vector<Class>& classes() {
  static const std::vector<Class> kAll = [] {
    std::vector<Class> all = dangerous_in_any();
    for (const auto& more : {dangerous_by_plan(), not_dangerous()})
      all.insert(all.end(), more.begin(), more.end());
    return all;
  }();
  return kAll;
}

}  // namespace capstan::mutation

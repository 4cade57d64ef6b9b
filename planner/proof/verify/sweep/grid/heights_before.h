#pragma once

#include <cstddef>
#include <vector>

namespace capstan::verify {

/// Heights of all cells as they were at one time, mm. Those of a level face are kept as one number: most
/// set-ups begin with such stock, and its cells are many.
class HeightsBefore {
 public:
  void keep(const std::vector<double>& now);
  [[nodiscard]] double operator[](std::size_t cell) const { return each_.empty() ? all_ : each_[cell]; }
  [[nodiscard]] std::size_t cells() const { return cells_; }
  /// How many numbers are kept: one, or one of each cell.
  [[nodiscard]] std::size_t numbers() const { return each_.empty() ? 1 : each_.size(); }

 private:
  std::size_t cells_ = 0;
  double all_ = 0.0;
  std::vector<double> each_;  ///< empty: all of them are `all_`
};

}  // namespace capstan::verify

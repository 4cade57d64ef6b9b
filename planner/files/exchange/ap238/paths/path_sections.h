#pragma once

#include <array>
#include <cstddef>
#include <utility>
#include <vector>

#include "planner/model/plan/cutter_path.h"

namespace capstan::exchange::ap238 {

/// ADmax, RDmax, Xmaxofs, Ymaxofs, CSA, XCGofs, YCGofs.
using SectionNumbers = std::array<double, 7>;

/// The measured sections of a path, by place.
class PathSections {
 public:
  /// Of a path of so many moves. The series may be null: no sections.
  PathSections(const model::SectionSeries* series, std::size_t moves);

  /// Those of the measured step in which the place lies; zeros in air.
  [[nodiscard]] SectionNumbers at(std::size_t move, double at_mm) const;
  /// Places inside a move, with their numbers, between which all seven change evenly: within a fiftieth of
  /// the path's largest depth, width and area, offsets within a twentieth. Default, unsourced.
  [[nodiscard]] std::vector<std::pair<double, SectionNumbers>> inside(std::size_t move,
                                                                      double length_mm) const;
  [[nodiscard]] double volume(std::size_t first, std::size_t last) const;

 private:
  [[nodiscard]] SectionNumbers numbers(std::size_t i) const;
  [[nodiscard]] double step_mm(std::size_t i) const;
  /// Where the samples of a move begin in `order_`; those of the next one follow.
  [[nodiscard]] std::size_t begin_of(std::size_t move) const {
    return move < begins_.size() ? begins_[move] : order_.size();
  }

  const model::SectionSeries* s_;
  std::vector<std::size_t> order_;   ///< samples by move and place
  std::vector<std::size_t> begins_;  ///< by move
  SectionNumbers tolerance_{};
};

}  // namespace capstan::exchange::ap238

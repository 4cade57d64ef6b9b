#pragma once

#include <memory>
#include <vector>

#include "planner/geometry/profile.h"
#include "planner/verify/sweep/grid.h"

namespace capstan::verify {

/// What a set-up began with and what has been cut since: to look again, closer, at a place.
class Past {
 public:
  /// The stock as it stands now is the beginning.
  void begin(const Grid& grid);
  void add(const Move& m, std::shared_ptr<const geometry::CutterProfile> cutter);
  /// The thickest chip of a move that is about to be added, on points up to eight times as close as the
  /// set-up's cells, at most 40,000 of them for each piece of the way that is four radii long. Stock of the
  /// beginning counts where all cells around a point have it, so that no chip is found that is not there.
  /// Nothing where points would lie hardly closer. `pieces`: how many more may be looked at; counted down.
  [[nodiscard]] Bite look(const Grid& grid, const Move& m, const geometry::CutterProfile& cutter,
                          double advance_mm, int& pieces) const;

 private:
  struct Cut {
    Move move;
    std::shared_ptr<const geometry::CutterProfile> cutter;
    geometry::Box3 box;
  };
  [[nodiscard]] Grid before(const Grid& grid, geometry::Vec2 lo, geometry::Vec2 hi, double cell) const;
  std::vector<double> stock_, base_;
  std::vector<Cut> cuts_;
};

}  // namespace capstan::verify

#pragma once

#include <memory>
#include <vector>

#include "planner/proof/verify/sweep/grid/grid.h"

namespace capstan::verify {

/// What a set-up began with and what has been cut since: to look again, closer, at a place.
class EarlierCuts {
 public:
  /// The stock as it stands now is the beginning.
  void begin(const Grid& grid);
  void add(const Move& m, std::shared_ptr<const CutterOutline> cutter);
  /// The thickest chip of a move that is about to be added, on points up to eight times as close as the
  /// set-up's cells, at most 40,000 of them for each piece of the way that is four radii long. Stock of the
  /// beginning counts where all cells around a point have it, so that no chip is found that is not there.
  /// Nothing where points would lie hardly closer. `pieces`: how many more may be looked at; counted down.
  [[nodiscard]] Bite look(const Grid& grid, const Move& m, const CutterOutline& cutter,
                          double advance_mm, int& pieces) const;
  /// How many cuts there are: a place to look back to.
  [[nodiscard]] std::size_t mark() const { return cuts_.size(); }
  /// Whether these moves take anything off what stood at that mark, on points as close as those of `look`;
  /// `cell_mm` becomes the distance of the widest. Stock of the beginning counts where any cell around a
  /// point has it.
  [[nodiscard]] bool takes(const Grid& grid, const std::vector<Move>& moves,
                           const CutterOutline& cutter, std::size_t mark, double& cell_mm) const;

 private:
  struct Cut {
    Move move;
    std::shared_ptr<const CutterOutline> cutter;
    geometry::Box3 box;
  };
  enum class Begun { kWhereAllHaveIt, kWhereAnyHasIt };
  [[nodiscard]] Grid before(const Grid& grid, geometry::Vec2 lo, geometry::Vec2 hi, double cell,
                            std::size_t mark, Begun begun) const;
  std::vector<double> stock_, base_;
  std::vector<Cut> cuts_;
};

}  // namespace capstan::verify

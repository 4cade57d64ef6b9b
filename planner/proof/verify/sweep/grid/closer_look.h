#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "planner/proof/verify/sweep/grid/grid.h"
#include "planner/proof/verify/sweep/grid/heights_before.h"

namespace capstan::verify {

struct Front;

/// A chip, and where it is cut.
struct Chip {
  double mm = 0.0;
  geometry::Vec2 at;
};

/// Whether a move touches what stands.
struct Touch {
  std::optional<geometry::Vec2> at;  ///< where; nothing: it is free
  bool sure = false;  ///< false: only if the beginning had material there that not all cells around show
};

/// What a set-up began with and what has been cut since: to look again, closer, at a place.
class EarlierCuts {
 public:
  /// The stock as it stands now is the beginning.
  void begin(const Grid& grid);
  void add(const Move& m, std::shared_ptr<const CutterOutline> cutter);
  /// The thickest chip of a move that is about to be added, if it is thicker than `least_mm`, on points up to
  /// eight times as close as the set-up's cells, at most 40,000 of them for each piece of the way that is
  /// four radii long. Stock of the beginning counts where all cells around a point have it, so that no chip
  /// is found that is not there. Nothing where points would lie hardly closer. `pieces`: how many more may be
  /// looked at; counted down. Needs  `advance_mm` > `least_mm`.
  [[nodiscard]] Chip look(const Grid& grid, const Move& m, const std::shared_ptr<const CutterOutline>& cutter,
                          double advance_mm, double least_mm, int& pieces);
  /// How many cuts there are: a place to look back to.
  [[nodiscard]] std::size_t mark() const { return cuts_.size(); }
  /// Whether these moves take anything off what stood at that mark, on points as close as those of `look`;
  /// `cell_mm` becomes the distance of the widest. Stock of the beginning counts where any cell around a
  /// point has it.
  [[nodiscard]] bool takes(const Grid& grid, const std::vector<Move>& moves, const CutterOutline& cutter,
                           std::size_t mark, double& cell_mm);
  /// Whether a straight move touches what stands, on points as close as those of `look`. Nothing where it
  /// cannot be told: points would lie farther apart than `close_mm`, or no more pieces of its way may be
  /// looked at; `pieces`: how many more may be, counted down.
  [[nodiscard]] std::optional<Touch> meets(const Grid& grid, const Move& m, const CutterOutline& cutter,
                                           double close_mm, int& pieces);

 private:
  struct Cut {
    Move move;
    std::shared_ptr<const CutterOutline> cutter;
    geometry::Box3 box;
  };
  struct Place;
  struct Block;
  struct Point;
  template <class F>
  void squares(geometry::Vec2 lo, geometry::Vec2 hi, const F& f);
  [[nodiscard]] std::vector<const Cut*> met(const Place& place, std::size_t mark);
  template <class Way>
  [[nodiscard]] static std::vector<Block> blocks(const Raster& local, const Way& way, const Front* front,
                                                 double least_mm, const std::vector<const Cut*>& cuts);
  template <class Way>
  [[nodiscard]] std::vector<Point> begun(const Grid& grid, const Raster& local, const Way& way,
                                         const Front* front, double least_mm,
                                         std::span<const Block> blocks) const;
  static void lower(std::vector<Point>& points, const Move& m, const CutterOutline& cutter, double least_mm);
  template <class Way>
  [[nodiscard]] std::vector<Point> left(const Grid& grid, const Place& place, const Way& way,
                                        const Front* front, double least_mm,
                                        const std::vector<const Cut*>& cuts) const;

  [[nodiscard]] double least_begun(const Grid& grid, geometry::Vec2 at) const;

  HeightsBefore stock_, base_;
  std::vector<Cut> cuts_;
  /// The cuts by the squares of the set-up's area that they reach, `indexed_` of them so far.
  static constexpr int kSquares = 32;
  std::vector<std::vector<std::uint32_t>> squares_;
  std::size_t indexed_ = 0;
  geometry::Vec2 lo_, square_;  ///< where they begin, and how wide they are
};

}  // namespace capstan::verify

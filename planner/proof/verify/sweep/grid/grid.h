#pragma once

#include <algorithm>
#include <utility>
#include <vector>

#include "planner/ground/geometry/vec.h"
#include "planner/proof/verify/moves.h"
#include "planner/proof/verify/sweep/grid/outline.h"

namespace capstan::verify {

/// Memory that a thread keeps for its next grids, MB: two of the usual 250,000 cells. Default, unsourced.
inline constexpr double kMostSpareMb = 12.0;

/// Square cells over an area, by their centres.
class Raster {
 public:
  /// At most `maximum_cells` cells over the area [lo, hi].
  Raster(geometry::Vec2 lo, geometry::Vec2 hi, double cell_mm, long maximum_cells);

  [[nodiscard]] int nx() const { return nx_; }
  [[nodiscard]] int ny() const { return ny_; }
  [[nodiscard]] double cell() const { return cell_; }
  [[nodiscard]] geometry::Vec2 centre(int ix, int iy) const {
    return {lo_.x + (ix + 0.5) * cell_, lo_.y + (iy + 0.5) * cell_};
  }
  [[nodiscard]] std::size_t index(int ix, int iy) const {
    return static_cast<std::size_t>(iy) * static_cast<std::size_t>(nx_) + static_cast<std::size_t>(ix);
  }
  /// Cells whose centres lie in [a, b]: first and last + 1, clipped.
  [[nodiscard]] std::pair<int, int> columns(double a, double b) const;
  [[nodiscard]] std::pair<int, int> rows(double a, double b) const;

 protected:
  geometry::Vec2 lo_;
  double cell_ = 0.0;
  int nx_ = 0, ny_ = 0;
};

/// Heights at the centres of the cells, seen along the tool axis: the raw piece as it is now, and the
/// finished part. A point sample, not an average: what holds at a centre holds there exactly.
///
/// Memory of a grid that is gone serves the next one of its thread: new pages cost more than all that is
/// written to them. At most kMostSpareMb of it wait so.
///
/// Frame  the set-up's. Units  mm.
class Grid : public Raster {
 public:
  Grid(geometry::Vec2 lo, geometry::Vec2 hi, double cell_mm, long maximum_cells);
  Grid(const Grid&) = default;
  Grid(Grid&&) = default;
  Grid& operator=(const Grid&) = default;
  Grid& operator=(Grid&&) = default;
  ~Grid();

  std::vector<double> stock;  ///< in-process height; kNothing: no material
  std::vector<double> part;   ///< finished height; kNothing: nothing stays here
  std::vector<double> base;   ///< underside of the stock: above `floor` where it was cut from the other side
  static constexpr double kNothing = -1e9;
  double floor = kNothing;  ///< underside of the raw piece

  /// Highest stock under a disc, cell centres counted; kNothing when none.
  [[nodiscard]] double highest(geometry::Vec2 at, double radius_mm) const;
  /// Whether material stands under a disc anywhere between two heights.
  [[nodiscard]] bool stands(geometry::Vec2 at, double radius_mm, double lo_mm, double hi_mm) const;
  /// How far below the part's surface a height is, measured square to the surface; 0 beside an edge of it.
  [[nodiscard]] double normal_depth(geometry::Vec2 at, double z_mm) const;
  [[nodiscard]] double top() const { return top_; }  ///< no stock is higher; may be too high
  /// No stock of a row is higher; may be too high.
  [[nodiscard]] double row_top(int iy) const { return row_top_[static_cast<std::size_t>(iy)]; }
  /// Says that stock of columns from..to - 1 (at least one) in a row is about to be cut.
  void cut_cells(int iy, int from, int to) {
    cut_from_ = std::min(cut_from_, iy);
    cut_to_ = std::max(cut_to_, iy + 1);
    Blocks& b = cut_blocks_[static_cast<std::size_t>(iy)];
    b.from = std::min(b.from, from / kBlock);
    b.to = std::max(b.to, (to - 1) / kBlock + 1);
  }
  /// Stock as high everywhere, and its underside.
  void begin_level(double stock_mm, double base_mm);
  /// Finds the tops of all rows: for stock that was written other than by `cut`.
  void find_top();
  /// Finds those of the rows that were cut since.
  void find_top_after_cuts();

 private:
  /// Cells of a row whose highest is kept, so that a row's top is found without its other cells. Default,
  /// unsourced: as long as the blocks of a row are many.
  static constexpr int kBlock = 32;
  struct Blocks {
    int from = 0, to = 0;
  };
  void nothing_cut(int iy) { cut_blocks_[static_cast<std::size_t>(iy)] = {blocks_, 0}; }

  double top_ = kNothing;
  std::vector<double> row_top_, block_top_;
  int blocks_ = 0;                  ///< of a row
  int cut_from_ = 0, cut_to_ = 0;   ///< rows cut since their tops were found
  std::vector<Blocks> cut_blocks_;  ///< by row: those cut since
};

/// What one move took away.
struct Bite {
  double volume_mm3 = 0.0;
  double contact_mm = 0.0;   ///< highest material taken above the tip
  double thickest_mm = 0.0;  ///< most taken off a cell
  double core_mm = 0.0;      ///< most taken off a cell within 0.3 radii of the axis's track
  double gouge_mm = 0.0;     ///< deepest below the finished part, beyond the tolerance
  geometry::Vec2 gouge_at;
  double chip_mm = 0.0;  ///< thickest chip that the front of the cutter took off a cell's centre
  geometry::Vec2 chip_at;
};

/// Whether a point that lies `depth_mm` below the finished surface at height z is a gouge, or within the
/// tolerance of a wall.
class GougeTest {
 public:
  virtual ~GougeTest() = default;
  [[nodiscard]] virtual bool is_gouge(geometry::Vec2 at, double z_mm) const = 0;
};

/// Results wanted of a cut beside its volume; one that is not wanted costs nothing.
struct CutAsks {
  double allowed_mm = 1e300;         ///< depth below the part that is within tolerance
  const GougeTest* judge = nullptr;  ///< of what is deeper; null: all of it is a gouge
  /// What a tooth advances; 0: chips are not measured. A centre that the front of the cutter meets has met it
  /// at one place of its surface, whose normal n and the direction of travel v are known exactly: the chip
  /// there is the advance times n v, no thicker than the material is deep.
  double advance_mm = 0.0;
  /// > 0: the cutter has nothing that cuts above that height. What stands higher than the head's top is an
  /// overhang, which heights do not hold: it stays.
  double head_mm = 0.0;
  bool contact = true;  ///< `Bite::contact_mm`
  /// Contact ends at the stock's underside: what the cutter has below it cuts nothing.
  bool above_underside = false;
};

/// Cuts with the move and says what it took. Exact at cell centres for lines and arcs, level or not; an arc
/// whose ends are not as far from its centre runs at the mean of both. Heights after several moves do not
/// depend on their order.
Bite cut(Grid& grid, const Move& m, const CutterOutline& cutter, const CutAsks& asks);

/// Least gap under a rapid, mm: more than a program's last decimal.
inline constexpr double kRapidClearanceMm = 1e-3;

/// How deep a rapid would dip into what stands there, > 0: it does, also when axes do not arrive together:
/// the box that the two ends span, swept by the cutter. `at` says where.
[[nodiscard]] double rapid_collision(const Grid& grid, const Move& m, const CutterOutline& cutter,
                                     double clearance_mm, geometry::Vec2& at);

}  // namespace capstan::verify

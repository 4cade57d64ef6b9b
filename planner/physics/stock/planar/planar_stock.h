#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "planner/ground/base/result.h"
#include "planner/ground/geometry/profile.h"
#include "planner/ground/geometry/vec.h"
#include "planner/model/plan/cutter_path.h"
#include "planner/physics/stock/planar/part.h"
#include "planner/physics/stock/planar/probe.h"
#include "planner/physics/stock/planar/trail.h"

namespace capstan::stock {

/// The in-process workpiece of one set-up as what it is, not as cells: an upright block or bar less the
/// trails that cutters left, each with its own floor. A layer of it is the block's outline without the bands
/// and discs of the trails that reach so deep; lines and circles stay lines and circles, so that a level
/// cut's boundary is exact but for rounding of doubles.
///
/// Trails lie in a grid of tiles; one that covers a tile makes what was there before it superfluous, so
/// that cutting and asking cost what is near, not what was ever cut.
///
/// Held exactly    level moves of flat cutters (straight and round), flat plunges.
/// Held in strips  ramps and helices of flat cutters, points of drills, level moves of other outlines: their
///                 floors are read in strips (trail.h).
/// Not held        sloping moves of outlines that are not flat, undercuts.
///
/// Frame  the set-up's, z away from the work.
/// Units  mm.
class PlanarStock {
  static constexpr std::size_t kThinAt = 8;
  struct Tile {
    std::vector<std::uint32_t> trails;
    double highest_mm = 0.0;
    std::size_t thin_at = kThinAt;  ///< as many trails are looked through for superfluous ones
    std::uint32_t noted = 0;        ///< the mark since which it is noted as it was
  };

 public:
  /// `tile_mm` 0: a 48th of the longer side, at least 1 mm.
  [[nodiscard]] static PlanarStock from_box(const geometry::Box3& box, double tile_mm = 0.0);
  /// A bar along z through the box's centre.
  [[nodiscard]] static PlanarStock from_cylinder(const geometry::Box3& box, double radius_mm,
                                                 double tile_mm = 0.0);

  /// Why this no longer equals the real stock; empty while it does.
  [[nodiscard]] const std::string& lost() const { return lost_; }
  void lose(std::string why) { lost_ = std::move(why); }

  /// Empty if every move of the path can be represented (moves through air always can), else why not.
  [[nodiscard]] std::string cannot_hold(const geometry::CutterProfile& profile,
                                        const model::CutterPath& path) const;
  /// Cuts the whole path, rapids included.
  /// Fails  STK-NOT-PLANAR: it cannot be held; the stock is then lost.
  Status cut(const geometry::CutterProfile& profile, const model::CutterPath& path);
  /// Takes one trail away. `outline` of the trail must come from `keep`.
  void take(Trail trail);
  /// A copy of the profile that lives as long as this stock and its copies; null for a flat one.
  [[nodiscard]] const geometry::CutterProfile* keep(const geometry::CutterProfile& profile);

  /// What of the stock matters to a look or a cut between lo and hi, which are in the own frame of `origin`.
  /// Every trail that reaches there is in it, superfluous ones too: which of them tiles keep depends on where
  /// these lie.
  [[nodiscard]] PlanarPart part(geometry::Vec2 lo, geometry::Vec2 hi, geometry::Vec2 origin) const;
  [[nodiscard]] static PlanarStock from_part(const PlanarPart& part);

  /// The stock at a moment. Changes after `mark` are recorded, so that `put_back` can undo them.
  struct Mark {
    std::size_t changes = 0, trails = 0, reached = 0;
    std::string lost;
  };
  [[nodiscard]] Mark mark();
  /// Needs  a mark of this stock, younger than the last `forget`. Marks made after it are void.
  void put_back(const Mark& mark);
  /// As `put_back`; gives what was undone, so that `put_in` can do it again without cutting.
  class Undone {
    friend class PlanarStock;
    std::vector<std::pair<std::size_t, Tile>> tiles_;  ///< after their changes, youngest first
    std::vector<Trail> trails_;
    std::vector<std::pair<std::size_t, std::uint32_t>> reached_;
    std::string lost_;
  };
  [[nodiscard]] Undone take_out(const Mark& mark);
  /// Needs  the stock as `take_out` left it.
  void put_in(Undone undone);
  /// All marks are void; what was noted since is let go.
  void forget();

  /// Trails that may matter near a place; kept by the caller so that asking allocates nothing.
  struct Nearby {
    std::vector<std::uint32_t> trails;  ///< deepest floor first
    std::vector<std::uint32_t> first;   ///< what shaped the last answer; likely to shape the next
    std::vector<std::uint32_t> helped;
    std::vector<std::uint32_t> seen;
    std::uint32_t round = 0;
    bool in_strips = false;  ///< the last answer came from floors that are read in strips, in part
  };
  void gather(geometry::Vec2 lo, geometry::Vec2 hi, Nearby& out) const;
  /// True if the material is the same at all heights between: no floor begins or ends there.
  [[nodiscard]] bool even(const Nearby& near, double from_mm, double to_mm) const;
  /// True if trails with floors at or below z removed all of a disc. False also if squares of an eighth of
  /// its radius are too coarse to decide. `near` was gathered around it.
  [[nodiscard]] bool cleared(const Nearby& near, geometry::Vec2 centre, double radius_mm, double z_mm) const;
  /// Heights of the material along the probe; `near` was gathered around it. Heights below `above_mm` are
  /// reported as `above_mm`, heights over `most_mm` as `most_mm`.
  void heights(const Probe& probe, Nearby& near, double above_mm, Heights& out, double most_mm = 1e300) const;

  /// An upper bound of the material over a rectangle; the floor if there is none.
  [[nodiscard]] double highest(geometry::Vec2 lo, geometry::Vec2 hi) const;
  [[nodiscard]] double height_at(geometry::Vec2 p) const;
  /// mm3, integrated over lines along x to about `relative` of the raw piece, apart from any cutting.
  [[nodiscard]] double volume(double relative = 1e-8) const;

  [[nodiscard]] const geometry::Box3& box() const { return box_; }
  [[nodiscard]] std::size_t trail_count() const { return trails_.size(); }

 private:
  PlanarStock() = default;
  void tiles_of(geometry::Vec2 lo, geometry::Vec2 hi, int& x0, int& x1, int& y0, int& y1) const;
  [[nodiscard]] std::size_t number_of(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(nx_) + static_cast<std::size_t>(x);
  }
  void note(std::uint32_t id, geometry::Vec2 lo, geometry::Vec2 hi);
  void place(std::uint32_t id, geometry::Vec2 lo, geometry::Vec2 hi);
  void thin(Tile& tile, geometry::Vec2 middle);
  bool covered(const Trail& trail, const std::vector<std::uint32_t>& others, geometry::Vec2 middle,
               double half_mm, int quarterings) const;

  geometry::Box3 box_;
  double bar_radius_mm_ = 0.0;  ///< 0: a block
  double tile_mm_ = 1.0;
  int nx_ = 0, ny_ = 0;
  std::vector<Tile> tiles_;
  std::vector<Trail> trails_;
  std::vector<std::shared_ptr<const geometry::CutterProfile>> outlines_;
  std::string lost_;
  std::vector<std::pair<std::size_t, Tile>> changes_;  ///< tiles before they were changed, oldest first
  std::vector<std::vector<std::uint32_t>> reaching_;   ///< by tile: all trails that may reach into it
  std::vector<std::size_t> reached_;                   ///< tiles that were added to, since the last `forget`
  std::uint32_t marks_ = 0;                            ///< how many were made
};

}  // namespace capstan::stock

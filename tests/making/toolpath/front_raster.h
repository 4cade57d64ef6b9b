#pragma once

#include <cstdint>
#include <vector>

#include "planner/making/toolpath/path_job.h"

namespace capstan::toolpath {

/// Ground of one height as cells, cleared by discs: how much of a cutter's front half stands in material, by
/// counting, apart from how paths are made.
class FrontRaster {
 public:
  FrontRaster(geometry::Vec2 lo, geometry::Vec2 hi, double cell_mm);
  /// Air outside of the region.
  void only(const geometry::Region& region);

  struct Report {
    double held_arc_rad = 0.0;  ///< of cuts after `from_move`: the most that lasts for half a millimetre
    geometry::Vec2 held_at;
    double peak_arc_rad = 0.0;  ///< the most at any place
    double most_on_link_rad = 0.0;
    double cut_mm = 0.0, link_mm = 0.0, idle_mm = 0.0;  ///< cuts, links, cuts without contact
    int retracts = 0;
  };
  /// Runs the moves from `from_move` on whose height is at most `below_mm`. The circle asked about is smaller
  /// than the cutter by `blind_mm`.
  Report run(const GeneratedPath& g, double radius_mm, double below_mm, std::size_t from_move,
             double blind_mm);
  /// Area of the region that is not cleared, mm2.
  [[nodiscard]] double left_mm2(const geometry::Region& region) const;

 private:
  [[nodiscard]] bool solid(geometry::Vec2 p) const;
  void clear(geometry::Vec2 p, double radius);
  [[nodiscard]] double arc(geometry::Vec2 p, geometry::Vec2 direction, double radius) const;
  geometry::Vec2 lo_;
  double cell_;
  std::size_t nx_, ny_;
  std::vector<std::uint8_t> solid_;
  std::vector<geometry::Vec2> late_;
};

}  // namespace capstan::toolpath

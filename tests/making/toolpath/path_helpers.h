#pragma once

#include <string>
#include <vector>

#include "planner/making/toolpath/path_job.h"

namespace capstan::toolpath {

/// Heights on a grid, cut by discs: a referee that knows nothing of how paths are made.
class HeightMap {
 public:
  HeightMap(geometry::Vec2 lo, geometry::Vec2 hi, double cell_mm, double top_mm);
  /// Fills only where the region is; elsewhere there is air.
  void only(const geometry::Region& region);
  void set_top(const geometry::Region& region, double z_mm);

  struct Report {
    std::vector<std::string> faults;  ///< moves in the air that touch, plunges that must not be
    double cut_mm = 0.0;
    double deepest_mm = 0.0;  ///< the most that a cutting move took off at one place of the cutter
  };
  /// Runs the path with a flat cutter. Air moves (rapids, approach, link, retract) must touch nothing.
  Report run(const GeneratedPath& g, const model::Cutter& cutter);
  /// Highest cell whose centre lies in the region; lowest likewise.
  [[nodiscard]] double highest(const geometry::Region& region) const;
  [[nodiscard]] double lowest_outside(const geometry::Region& region) const;
  [[nodiscard]] double cell() const { return cell_; }

 private:
  [[nodiscard]] geometry::Vec2 centre(std::size_t i) const;
  /// The most that the cutter takes there, mm; 0: it touches nothing.
  double stamp(geometry::Vec3 p, double radius, bool cuts);
  geometry::Vec2 lo_;
  double cell_;
  std::size_t nx_, ny_;
  std::vector<float> z_;
};

/// What must hold of any path: heights of begin and end, rapids, arcs, ramps, columns.
std::vector<std::string> rule_breaks(const PathJob& task, const GeneratedPath& g);
/// Largest distance by which a disc at any point below `below_z` leaves the region, mm (0: none).
double gouge_mm(const GeneratedPath& g, const geometry::Region& allowed, double radius_mm, double below_z);

model::Cutter endmill(double diameter_mm);
/// A pocket or other area at the origin, top at z = 0.
PathJob area_job(const geometry::Region& area, double depth_mm, double diameter_mm);

/// Writes an SVG of the path when CAPSTAN_PLOT names a folder.
void plot(const GeneratedPath& g, const geometry::Region& area, const std::string& name);

}  // namespace capstan::toolpath

#pragma once

#include <vector>

#include "planner/ground/geometry/profile.h"
#include "planner/physics/stock/planar/planar_stock.h"

namespace capstan::engagement {

/// Removal of a cutter at one place, per length of its horizontal way; of a plunge: down to one height.
///
/// Frame  X across the feed, negative to the left; Y along the axis from the tip.
/// Units  mm, and mm2 (mm3 of a plunge) for the amounts.
struct Contact {
  double amount = 0.0;                       ///< area of the section; of a plunge the volume above the tip
  double moment_x = 0.0, moment_y = 0.0;     ///< amount times centre of gravity
  double left = 1e300, right = -1e300;       ///< of contacts that are no slivers
  double low = 1e300, high = -1e300;         ///< of the tallest of them, less its slivers
  double highest = 0.0;                      ///< of any, above the tip
  bool in_strips = false;                    ///< floors read in strips contribute, or edges under a ramp
  double unsure = 0.0;                       ///< error of the amount from the lines under a ramp's tip
  double gap_rad = 0.0;                      ///< angle between left and right at which nothing is touched
  void extend(const Contact& o);             ///< the extremes of both
  void add(const Contact& o, double times);  ///< amounts alone
  [[nodiscard]] bool seen() const { return right > left; }
};

/// Looks at the stock for one cutter; keeps its buffers.
class Prober {
 public:
  Prober(const stock::PlanarStock& stock, const geometry::CutterProfile& profile)
      : stock_(stock), profile_(profile) {}

  /// Collects the trails in a rectangle. True if nothing there is higher than z.
  bool turn_to(geometry::Vec2 lo, geometry::Vec2 hi, double z_mm);
  /// A flat cutter on its way: its front half circle removes the material above the tip; with `fall` (slope,
  /// positive downwards) also material under it.
  [[nodiscard]] Contact on_the_way(geometry::Vec2 at, geometry::Vec2 unit_heading, double z_mm, double fall);
  /// Whether the section across the axis is the same between two heights.
  [[nodiscard]] bool even(double from_mm, double to_mm) const { return stock_.even(near_, from_mm, to_mm); }
  /// The volume of material inside the outline with the tip at z; extremes of the last `advance_mm` of the
  /// plunge.
  [[nodiscard]] Contact inside(geometry::Vec2 at, geometry::Vec2 unit_heading, double z_mm,
                               double advance_mm);

 private:
  void under_tip(geometry::Vec2 at, geometry::Vec2 unit_heading, double z_mm, double fall, Contact& c);
  double reach_at(double height_mm) const;
  const stock::PlanarStock& stock_;
  const geometry::CutterProfile& profile_;
  stock::PlanarStock::Nearby near_;
  stock::Heights heights_;
  std::vector<stock::Heights::Piece> thin_;  ///< pieces of a contact that are slivers by themselves
};

}  // namespace capstan::engagement

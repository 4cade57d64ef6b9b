#pragma once

#include <vector>

#include "planner/making/toolpath/freeform/freeform.h"
#include "planner/making/toolpath/freeform/hatch.h"
#include "planner/physics/stock/height_map.h"

namespace capstan::toolpath::freeform {

/// Solid material under the lines, for a job without a stock.
[[nodiscard]] stock::HeightMap block_under(const FreeformJob& task, const Hatch& hatch);

/// Where the axis of a cutter is within `radius_mm` of material that is higher than may stay, seen from
/// above, and no more than a cutter's radius beside that. Empty: there is none.
[[nodiscard]] geometry::Region around_rests(const stock::HeightMap& material,
                                            const stock::HeightMap& may_stay, double radius_mm);

/// Whether the material ends where the surface does: then beside both is nothing that must stay.
[[nodiscard]] bool ends_with(const stock::HeightMap& material, const geometry::Box3& surface);

/// What stands in the way of a cutter.
class Material {
 public:
  /// `may_stay`: of the map's cells, up to which heights its material is not wanted; null: all is.
  Material(stock::HeightMap map, const model::Cutter& cutter, const stock::HeightMap* may_stay = nullptr);

  stock::HeightMap map;
  geometry::CutterProfile profile;

  /// Whether the cutter, its tip at p and z, takes more than `kWorthMm` anywhere of what is wanted. What its
  /// corner or its ball passes by is no material.
  [[nodiscard]] bool meets(geometry::Vec2 p, double z) const;
  /// The same by the means of cells alone: slivers that a round cut left in a cell are no depth to go down
  /// through.
  [[nodiscard]] bool stands(geometry::Vec2 p, double z) const;
  /// Whether the cutter, its tip at p and z, takes nothing at all: no cell that it touches is higher than its
  /// outline over that cell's nearest point.
  [[nodiscard]] bool is_clear(geometry::Vec2 p, double z) const;
  /// Whether nothing under the cutter's disc is higher than z.
  [[nodiscard]] bool is_below(geometry::Vec2 p, double z) const;

 private:
  /// Whether `f(cell, distance of its middle)` holds for a cell whose middle lies within
  /// `radius_mm`.
  template <class F>
  [[nodiscard]] bool any(geometry::Vec2 p, double radius_mm, const F& f) const;
  [[nodiscard]] double outline(double r_mm) const;
  /// Whether the mean of a cell's column, its middle at least `from_mm` from the axis and a cell within the
  /// radius, is higher than the outline by kWorthMm.
  [[nodiscard]] bool higher(geometry::Vec2 p, double z, double from_mm) const;

  [[nodiscard]] bool meets_wanted(geometry::Vec2 p, double z) const;

  const stock::HeightMap* may_stay_;
  double flat_mm_ = 0.0;        ///< radius of the plane at the tip
  std::vector<float> outline_;  ///< heights above the tip, `kPerCell` of them for each cell from the axis
};

}  // namespace capstan::toolpath::freeform

#pragma once

#include <cstddef>
#include <vector>

#include "planner/ground/geometry/mesh.h"
#include "planner/ground/geometry/vec.h"

namespace capstan::stock {

/// The material on one cell: a share of the cell is at `low_mm`, the rest at `top_mm`, both above the map's
/// floor. On a uniform cell the share is 0 and both are equal. Two levels represent an edge that crosses the
/// cell.
struct Column {
  float top_mm = 0.0F;
  float low_mm = 0.0F;
  float share = 0.0F;
  [[nodiscard]] float mean() const { return top_mm - share * (top_mm - low_mm); }
  friend bool operator==(const Column&, const Column&) = default;
};

/// The in-process workpiece of one set-up, seen along the tool axis: a height for each cell of a grid.
/// Outside the grid there is no material. Undercuts cannot be held: the solid reaches from its top down
/// to the floor.
///
/// Frame  the set-up's, z away from the work.
/// Units  mm.
/// Shape  top[iy * nx + ix] and so on, with kPadding entries more at the end that belong to no cell; cell
///        (ix, iy) covers origin + cell * [ix, ix + 1] x [iy, iy + 1].
struct HeightMap {
  static constexpr std::size_t kPadding = 16;  ///< a vector's width may be read beyond the last cell

  geometry::Vec3 origin;  ///< corner of cell (0, 0); z is the floor, the underside of the raw piece
  double cell_mm = 0.0;
  int nx = 0, ny = 0;
  std::vector<float> top, low, share;  ///< of the cells' columns

  [[nodiscard]] double x_of(int ix) const { return origin.x + (ix + 0.5) * cell_mm; }
  [[nodiscard]] double y_of(int iy) const { return origin.y + (iy + 0.5) * cell_mm; }
  [[nodiscard]] std::size_t index(int ix, int iy) const {
    return static_cast<std::size_t>(iy) * static_cast<std::size_t>(nx) + static_cast<std::size_t>(ix);
  }
  [[nodiscard]] std::size_t cells() const {
    return static_cast<std::size_t>(nx) * static_cast<std::size_t>(ny);
  }
  [[nodiscard]] Column at(std::size_t i) const { return {top[i], low[i], share[i]}; }
  [[nodiscard]] Column at(int ix, int iy) const { return at(index(ix, iy)); }
  void set(std::size_t i, const Column& c) {
    top[i] = c.top_mm;
    low[i] = c.low_mm;
    share[i] = c.share;
  }
  void set(int ix, int iy, const Column& c) { set(index(ix, iy), c); }
  friend bool operator==(const HeightMap&, const HeightMap&) = default;
};

/// A map has at most this many cells (192 MB); default, unsourced.
inline constexpr double kMaximumCells = 16e6;

/// The cell that divides a cutter's diameter into `cells_per_diameter`, made larger where the piece would
/// then need more than `maximum_cells`, and rounded up to a micrometre.
/// Units  mm. 100 cells per diameter measure a cross section to 1 %; 40 suffice for time and volume.
[[nodiscard]] double cell_for(double diameter_mm, const geometry::Box3& piece,
                              double cells_per_diameter = 100.0, double maximum_cells = 4e6);

/// An empty grid over the box's area, its floor at the box's underside.
/// Needs  a box that is not empty, cell > 0; the cell grows until the grid keeps to kMaximumCells.
[[nodiscard]] HeightMap empty_map(const geometry::Box3& box, double cell_mm);
/// A block along the axes. Cells that the far sides cut through are held in part.
[[nodiscard]] HeightMap from_box(const geometry::Box3& box, double cell_mm);
/// A bar along z through the box's centre, between its bottom and its top.
[[nodiscard]] HeightMap from_cylinder(const geometry::Box3& box, double radius_mm, double cell_mm);
/// The highest surface of the mesh above each cell's centre; `floor_mm` is the underside. Orientation of
/// triangles does not matter; where no triangle lies there is nothing.
[[nodiscard]] HeightMap from_mesh(const geometry::Mesh& mesh, double floor_mm, double cell_mm);
/// The same over the cells of another map.
[[nodiscard]] HeightMap from_mesh(const geometry::Mesh& mesh, double floor_mm, const HeightMap& cells);

/// The columns of a rectangle of cells before a cut, to undo it.
struct Patch {
  int x0 = 0, y0 = 0, nx = 0, ny = 0;
  std::vector<float> top, low, share;  ///< row by row
};
/// The cells of a rectangle, set-up frame, and one more on each side.
[[nodiscard]] Patch patch_of(const HeightMap& map, geometry::Vec2 lo, geometry::Vec2 hi);
/// Needs  a patch of this map.
void put_back(HeightMap& map, const Patch& patch);
/// As `put_back`; the patch then has the columns as they were.
void exchange(HeightMap& map, Patch& patch);

[[nodiscard]] double volume(const HeightMap& map);  ///< mm3
/// Height of the stock at a point, the mean of its cell; the floor outside.
[[nodiscard]] double height_at(const HeightMap& map, geometry::Vec2 p);
/// Highest material under a disc, set-up z; the floor if there is none. Cells that the disc only touches
/// count, so that the result is never too low.
[[nodiscard]] double max_height(const HeightMap& map, geometry::Vec2 centre, double radius_mm);
/// Lowest material under a disc, set-up z; the floor where the disc goes beyond the map. Cells that the disc
/// only touches count, so that the result is never too high.
[[nodiscard]] double min_height(const HeightMap& map, geometry::Vec2 centre, double radius_mm);
/// The highest under the band that a disc sweeps from a to b.
[[nodiscard]] double max_height(const HeightMap& map, geometry::Vec2 a, geometry::Vec2 b, double radius_mm);

}  // namespace capstan::stock

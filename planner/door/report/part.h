#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "planner/ground/geometry/vec.h"
#include "planner/model/plan/plan.h"

namespace capstan::report {

/// A feature of the plan as prisms that show where it is, workpiece frame.
struct FeatureSolids {
  struct Prism {
    std::vector<geometry::Vec3>
        outline;          ///< at its top, counter-clockwise about the direction out of the material
    geometry::Vec3 down;  ///< from there to its bottom
  };
  std::string id;             ///< its_id
  std::vector<Prism> prisms;  ///< empty: a surface, or a feature whose shape cannot be read
};

/// Every feature that has a name, in the order of the file; of the areas the outer outlines alone.
[[nodiscard]] std::vector<FeatureSolids> feature_solids(const model::Plan& plan);

/// The finished part as its features and its mesh have it, planned or not: columns over the raw piece's box,
/// each from a lower to an upper height, workpiece frame, mm. Entry j * nx + i is at share i / (nx - 1) of
/// the box's length along x, j / (ny - 1) along y. Where the part has nothing both heights are equal.
struct PartHeights {
  std::size_t nx = 0, ny = 0;
  std::vector<float> top, bottom;
  std::vector<std::string>
      beside;  ///< features that such columns do not show: they look along another axis than Z, or are curved
};

/// Columns along the longer side of the box.
inline constexpr std::size_t kPartColumns = 200;

/// Accuracy  of what overhangs the upper side alone; walls to a column.
/// Cost      columns times features over them.
[[nodiscard]] PartHeights part_heights(const model::Plan& plan);

}  // namespace capstan::report

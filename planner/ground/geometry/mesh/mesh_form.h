#pragma once

#include <optional>
#include <string>

#include "planner/ground/geometry/mesh.h"
#include "planner/ground/geometry/mesh/welded.h"
#include "planner/ground/geometry/region.h"

namespace capstan::geometry {

/// A facet is upright if its unit normal has less of z than this. Default, unsourced.
inline constexpr double kUprightNormal = 1e-3;
/// A facet is level if its unit normal has more of z than this: the rounding of coordinates.
inline constexpr double kLevelNormal = 1.0 - 1e-6;

/// What a mesh bounds, by its edges.
struct MeshForm {
  enum class Kind {
    kSolid,   ///< every edge is shared by an even number of triangles: it has an inside
    kSheet,   ///< open at its border only, one height over each place of its outline
    kBroken,  ///< neither: it has holes, or it ends somewhere
  };
  Kind kind = Kind::kBroken;
  std::size_t open_edges = 0;     ///< shared by an odd number of triangles
  std::size_t crowded_edges = 0;  ///< shared by more than two
  std::size_t turned_edges = 0;   ///< between two triangles that face opposite ways
  bool inside_out = false;        ///< a solid whose triangles face inwards
  bool faces_down = false;        ///< a sheet whose triangles do
  Region outline;                 ///< of a sheet, in XY
  std::string fault;              ///< of what is neither: what it has, with the place
};

/// Cost  n log n; a border of n edges whose corners lie on other edges of it n squared, up to 3,000 edges.
[[nodiscard]] MeshForm form_of(const Mesh& mesh);

}  // namespace capstan::geometry

#pragma once

#include <optional>

#include "planner/ground/geometry/mesh.h"

namespace capstan::piece {

/// A place of a part that gives way to a cutter: a wall that stands free, or a floor between walls.
struct ThinPlace {
  double thickness_mm = 0.0;
  double extent_mm = 0.0;  ///< a wall's height above the place; the widest circle on a floor
  geometry::Vec3 at;       ///< in the middle of it
  [[nodiscard]] double ratio() const { return extent_mm / thickness_mm; }
};
/// The wall that is highest by its thickness, and the floor that is widest by its own; nothing: none is five
/// times as high, or ten times as wide.
struct ThinPlaces {
  std::optional<ThinPlace> wall, floor;
};

/// The thin places of a mesh that is cut from above out of a raw piece, which stays whole below it. A wall
/// that something stiffer holds from beside, within an eighth of its height, is none; nor is a floor of half
/// of the raw piece's height or more, for that was as thin before. A sheet has no floors: it does not say
/// what lies below it.
///
/// Units mm. Frame: the mesh's, z the tool's axis. Cost: a few short rays for each steep triangle, and a map
/// of heights where the mesh goes down below half of the raw piece.
[[nodiscard]] ThinPlaces thin_places(const geometry::Mesh& mesh, const geometry::Box3& raw);

}  // namespace capstan::piece

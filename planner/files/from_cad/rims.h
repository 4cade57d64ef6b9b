#pragma once

#include <optional>
#include <string>
#include <vector>

#include "planner/files/from_cad/areas.h"

namespace capstan::from_cad {

/// The upper edge of a wall that a chamfer or a round breaks, seen from the tool.
struct Rim {
  model::TypeId type = model::TypeId::kNone;  ///< kChamfer, kEdgeRound
  geometry::Placement frame;           ///< at the origin of the workpiece, z from the material to the tool
  double top_mm = 0.0, foot_mm = 0.0;  ///< along z of the frame
  double angle_rad = 0.0;              ///< chamfer: against the plane above
  std::vector<Vec2> foot;              ///< places where it ends on the walls, in the frame's plane
  std::vector<std::uint32_t> faces;    ///< ascending
  [[nodiscard]] double height_mm() const { return top_mm - foot_mm; }
  [[nodiscard]] double width_mm() const;  ///< along the plane above
};

/// A rim of recognition in the frame of its direction, mm.
[[nodiscard]] Rim rim_of(const Part& part, const recognise::Feature& feature);

/// Of which outline a rim is the upper edge: a loop of a room's area, or the contour of what stands in it.
struct EdgeOf {
  std::size_t room = 0;
  std::size_t loop = 0;  ///< of the room's area; of what stands where the room is a contour
  friend bool operator==(const EdgeOf&, const EdgeOf&) = default;
};

/// The outline whose upper edge a rim is: that of a closed pocket, of an island, or a contour; where the rim
/// runs round the raw piece's own sides, a room of nothing is added for it. Nothing: there is none, its edge
/// is not broken all along, or no mill makes the rim from above.
[[nodiscard]] std::optional<EdgeOf> edge_of(const Part& part, const Rim& rim, std::vector<Room>& rooms);

/// The faces of a rim as features of their own: planes that a set-up faces, corners of an outline.
[[nodiscard]] std::vector<recognise::Feature> faces_apart(const Part& part, const recognise::Feature& rim);

/// The noun with that outline: that of the room, or of the boss in it.
[[nodiscard]] AnyRef noun_with(const Part& part, const Room& room, std::size_t loop, AnyRef noun,
                               const model::Model& m);

/// The chamfer or edge round of a rim, at the upper edge of a noun.
[[nodiscard]] AnyRef noun_of(const Rim& rim, AnyRef edge_of, model::Model& m, Ref<model::Workpiece> piece,
                             const std::string& number);

}  // namespace capstan::from_cad

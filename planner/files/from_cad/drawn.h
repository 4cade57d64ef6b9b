#pragma once

#include <vector>

#include "planner/files/from_cad/areas.h"

namespace capstan::from_cad {

/// A room in the frame of its noun: at the middle of its area, at its top.
struct Drawn {
  geometry::Placement at;
  double depth_mm = 0.0;
  geometry::Region raw, area;
  std::vector<RoundWall> walls;
  std::vector<FlatWall> flats;
  std::vector<Piece> outer;
  std::vector<std::vector<Piece>> islands;
  std::vector<std::size_t> island_loops;  ///< per island: its loop of the area
  double chord_mm = 0.0;
  geometry::Box2 around;                        ///< the whole raw piece in plan
  bool wall_feet = false, island_feet = false;  ///< whether fillets stand at walls, and at islands
};

/// A room as its noun has it, mm. Where nothing is cut, the frame is at the middle of the raw piece.
[[nodiscard]] Drawn drawn(const Part& part, const Room& room);

}  // namespace capstan::from_cad

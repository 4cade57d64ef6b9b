#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "planner/files/from_cad/areas.h"
#include "planner/files/from_cad/holes.h"
#include "planner/files/from_cad/rims.h"

namespace capstan::from_cad {

/// Faces that no feature of the plan makes, and why.
struct Left {
  std::vector<std::uint32_t> faces;
  std::string why;
};

/// A rim at the upper edge of a room.
struct OnEdge {
  Rim rim;
  std::vector<std::size_t> recognised;  ///< into the features
  EdgeOf of;                            ///< its room is one of Removal::rooms
};

/// Recognition in terms of rooms and holes.
struct Removal {
  std::vector<Room> rooms;
  std::vector<Hole> holes;
  std::vector<std::size_t> hole_of;  ///< per hole: into the features
  std::vector<OnEdge> on_edges;
  std::vector<std::size_t> on_no_edge;  ///< rims, into the features: no outline is broken all along by them
  std::vector<Left> left;
};

/// "closed pocket" of CLOSED_POCKET.
[[nodiscard]] std::string word_of(model::TypeId type);

/// What the features remove. `features` are those of recognition and the sides of the part that lie below the
/// raw piece's; rims that no room has at its edge become features of their faces there.
[[nodiscard]] Removal removal_of(const Part& part, const recognise::Recognition& found,
                                 std::vector<recognise::Feature>& features);

}  // namespace capstan::from_cad

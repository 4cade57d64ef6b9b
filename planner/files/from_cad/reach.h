#pragma once

#include <optional>
#include <string>
#include <vector>

#include "planner/files/from_cad/solid/part.h"

namespace capstan::from_cad {

/// So far in front of a wall a tool must have room, mm: beyond rounding, and less than what fits into a
/// corner of the smallest parts.
inline constexpr double kInFrontMm = 0.005;

/// How a feature would be machined along one direction: its floors, one above the other, each a level down to
/// which a tool clears.
struct Way {
  geometry::Placement frame;          ///< at the origin of the workpiece, z from the material to the tool
  std::vector<double> levels_mm;      ///< along z of the frame, the lowest first
  bool no_floor = false;              ///< the level is where the walls end
  std::vector<std::uint32_t> blends;  ///< faces of fillets between wall and floor, ascending
  double blend_radius_mm = 0.0;
  double slope_rad = 0.0;  ///< by which all walls lean outwards; 0: they are upright
};

/// The ways along which a tool reaches all of a feature's faces, past the rest of the part: the recognised
/// direction first, those along which they are walls and no deeper last. Where there is none, `why` says what
/// stands in the way.
///
/// Source  derived: a place is reached along a direction when nothing of the part lies above it.
[[nodiscard]] std::vector<Way> ways_of(const Part& part, const recognise::Feature& feature, std::string& why);

}  // namespace capstan::from_cad

#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "planner/files/from_cad/reach.h"

namespace capstan::from_cad {

/// Of an area so much may differ by rounding, mm2.
inline constexpr double kSpeckMm2 = 1e-2;

/// One area to be cleared down to one level: what one feature of the plan removes.
struct Room {
  geometry::Placement frame;   ///< at the origin of the workpiece, z from the material to the tool
  double level_mm = 0.0;       ///< along z of the frame
  double top_mm = 0.0;         ///< what lies above it is cleared by another room, or is outside the raw piece
  bool through = false;        ///< down to the underside of the raw piece, or into a hollow below
  bool no_floor = false;       ///< its level is where its walls end
  bool sheer = false;          ///< and nothing of the part is wider below
  bool contour = false;        ///< the whole contour of what stands beside its areas
  geometry::Region raw, area;  ///< in the frame's plane; holes are what stands in the area
  /// Not empty: the outlines, filled, of what stands while all around is cleared, out over the raw piece.
  std::vector<geometry::Loop> stands;
  std::vector<std::uint32_t> blends;
  double blend_radius_mm = 0.0;
  double slope_rad = 0.0;               ///< by which its walls lean outwards
  std::vector<std::uint32_t> faces;     ///< of the features that it makes, ascending
  std::vector<std::size_t> recognised;  ///< into Recognition::features
};

/// The rooms of a feature along a way, with nothing but their own faces. Tops are those of the raw piece.
[[nodiscard]] std::vector<Room> rooms_of(const Part& part, const recognise::Feature& feature, const Way& way);

/// Joins rooms of one area and level, and lets each begin at the level of the lowest room that holds it.
void settle(std::vector<Room>& rooms);

/// Joins through rooms of one direction and height that each round one place of the part's contour, such as
/// the corners of a plate, into one room whose noun is the contour.
void join_contours(const Part& part, std::vector<Room>& rooms);

/// Whether a room clears a place of the workpiece.
[[nodiscard]] bool clears(const Room& room, Vec3 at);

/// The noun of a room: closed_pocket, open_pocket, slot, step, planar_face or general_outside_profile, by
/// which of its sides are walls and which are open. Walls are lines and arcs; others are chords of the mesh.
/// Unset where the area is thinner than points are told apart: nothing is written.
[[nodiscard]] AnyRef noun_of(const Part& part, const Room& room, model::Model& m, Ref<model::Workpiece> piece,
                             const std::string& number);

}  // namespace capstan::from_cad

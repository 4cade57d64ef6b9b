#pragma once

#include <array>
#include <string>
#include <variant>
#include <vector>

#include "planner/ground/geometry/placement.h"
#include "planner/model/nouns/arena/attribute.h"
#include "planner/proof/verify/volumes/outline.h"

namespace capstan::verify::volumes {

/// What the text of a file says of a place. kNotStated: the standard, or the file, leaves it open.
enum class PointState : std::uint8_t { kStays, kRemoved, kNotStated };

/// A boss in an area that is cut around it, from `top_mm` downwards.
struct Standing {
  model::AnyRef boss;
  Outline outline;
  double top_mm = 0.0;          ///< solid's frame
  double leaning_mm = 0.0;      ///< its walls lean by up to this beside the outline: undecided there
  double foot_radius_mm = 0.0;  ///< between it and the floor: undecided there
};

/// An area cut down to a depth: face, pocket, step, outside. With `around`: what lies outside the outline.
struct Area {
  Outline outline;
  bool around = false;
  std::vector<Standing> standing;
  double foot_radius_mm = 0.0;  ///< between its walls and its floor
  double leaning_mm = 0.0;      ///< its walls lean by up to this: undecided so near to them
  double only_mm = 0.0;         ///< above 0: farther from its walls, and past their ends, it is undecided
  bool overhead = false;        ///< material above its top goes, too: a face
};

/// Round about its axis.
struct Bore {
  enum class Bottom : std::uint8_t { kThrough, kFlat, kCone, kBall, kRounded };
  double top_radius_mm = 0.0, bottom_radius_mm = 0.0;  ///< at the top, and at the depth
  Bottom bottom = Bottom::kFlat;
  double tip_mm = 0.0;     ///< kCone: how far its point lies below the depth; 0: undecided
  double radius_mm = 0.0;  ///< kBall, kRounded
  double blunt_mm = 0.0;   ///< kCone: so near to the axis its point is undecided
  double thread_major_mm = 0.0, thread_depth_mm = 0.0;  ///< of a thread in it; 0: none
  double thread_pitch_mm = 0.0;                         ///< with it; 0: not stated
  bool left_hand = false;                               ///< with it
};

/// A section swept along a course; `section` in (across, height above the floor), left of travel positive.
struct Groove {
  enum class End : std::uint8_t { kOpen, kHalfRound, kFlat, kNone };
  Outline course;  ///< not closed, or closed in itself
  bool loop = false;
  Outline section;
  double half_mm = 0.0;  ///< the widest that the section reaches to either side
  std::array<End, 2> ends = {End::kNone, End::kNone};
  std::array<double, 2> corner_mm = {0.0, 0.0};  ///< kFlat: so near to both walls it is undecided
  std::array<double, 2> rising_mm = {0.0,
                                     0.0};  ///< a Woodruff end: nearer to it than this its floor is undecided
  double foot_radius_mm = 0.0;              ///< between floor and sides
  /// Below this height and farther than this from the middle it is undecided: corners and flanks of a tee.
  double unsaid_height_mm = 0.0, unsaid_half_mm = 0.0;
};

/// A broken edge along an outline: from `width_mm` beside it, falling to `depth_mm` at it.
struct Bevel {
  Outline outline;
  bool within = false;  ///< the material lies within the outline
  double width_mm = 0.0, depth_mm = 0.0;
  double other_width_mm = 0.0, other_depth_mm = 0.0;  ///< the other way to read its offset and its angle
  bool round = false;                                 ///< a quarter of a circle that touches both sides
};

/// What one simple feature takes away. Frame: in workpiece coordinates, z out of the material, its top at
/// z = 0, its depth at z = -depth_mm.
struct Solid {
  model::AnyRef noun;  ///< the simple feature
  geometry::Placement frame;
  double depth_mm = 0.0;
  bool through = false;
  std::variant<Area, Bore, Groove, Bevel> form;

  /// What it says of a place, given in its frame.
  [[nodiscard]] PointState at(geometry::Vec3 p) const;
  /// The box that holds all it may take away or leaves open, its frame. Unbounded areas are cut off.
  [[nodiscard]] geometry::Box3 box() const;
};

/// How far beside the outline of what is cut around something the file says that it is taken away, mm: how
/// much further out an outside or a step goes, the standard leaves to the raw piece. Default, unsourced.
inline constexpr double kSaidBeside = 25.0;

}  // namespace capstan::verify::volumes

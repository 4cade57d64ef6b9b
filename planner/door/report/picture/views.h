#pragma once

#include <cstddef>
#include <vector>

#include "planner/door/report/picture/drawing.h"
#include "planner/ground/geometry/vec.h"
#include "planner/model/plan/plan.h"

namespace capstan::report::picture {

/// Where the two views of a set-up lie in the picture: from above, and below it from the front, in line with
/// it and as large (third angle projection, ISO 128).
///
/// Frame  points of the set-up's frame, mm, to the frame of drawing.h: from above x is X and y is -Y, from
///        the front x is X and y is -Z.
struct Views {
  geometry::Box3 box = {};   ///< of what is drawn
  double scale = 1.0;        ///< units of the picture per mm
  geometry::Vec2 at = {};    ///< upper left corner of the view from above
  double front_y = 0.0;      ///< upper edge of the view from the front
  geometry::Vec2 size = {};  ///< of both together
  [[nodiscard]] geometry::Vec2 above(geometry::Vec3 p) const {
    return {at.x + scale * (p.x - box.lo.x), at.y + scale * (box.hi.y - p.y)};
  }
  [[nodiscard]] geometry::Vec2 front(geometry::Vec3 p) const {
    return {at.x + scale * (p.x - box.lo.x), front_y + scale * (box.hi.z - p.z)};
  }
};

/// Room that views and what stands between and below them take, units of the picture.
inline constexpr double kViewsWide = 520.0, kViewsHigh = 560.0;
/// Between the view from above and that from the front.
inline constexpr double kViewsApart = 24.0;

/// The views of a set-up with these steps, as large as the room is: of the raw piece and the paths of the
/// steps, of the zero where it is as near as half of that is long, and of what of the fixtures is near.
[[nodiscard]] Views views_of(const model::Plan& plan, std::size_t setup,
                             const std::vector<std::size_t>& steps, geometry::Vec2 at);

/// Raw piece, fixtures, and what the features of all steps of the set-up remove.
struct PieceDrawn {
  std::vector<Group> groups = {};
  bool piece = false, features = false, fixtures = false;  ///< whether any of each is in the picture
};
[[nodiscard]] PieceDrawn piece_in(const model::Plan& plan, std::size_t setup, const Views& views);

/// The path of a step: rapids dashed and grey, moves at feed in its colour, a dot where feed begins.
/// `most`: points of each of its lines.
[[nodiscard]] Group path_in(const model::StepResult& step, Colour colour, const Views& views,
                            std::size_t most);

/// Zero and axes, the names of the views, and a bar of a round length.
[[nodiscard]] std::vector<Group> marks_in(const Views& views);

/// Colours of what the key of the picture names.
inline constexpr Colour kInk{27, 31, 36}, kGrey{110, 118, 127}, kRapid{150, 158, 167};
inline constexpr Colour kPieceFill{226, 234, 242}, kPieceEdge{108, 127, 148};
inline constexpr Colour kFeatureFill{203, 217, 231}, kFeatureEdge{130, 148, 168};
inline constexpr Colour kFixtureFill{226, 212, 184}, kFixtureEdge{138, 122, 88};

}  // namespace capstan::report::picture

#pragma once

#include <vector>

#include "planner/ground/base/result.h"
#include "planner/ground/geometry/vec.h"
#include "planner/model/features/shape.h"
#include "planner/model/plan/cutter/cutter.h"

namespace capstan::toolpath {

/// Profile of a slot or a tapered hole: the height of its surface as a function of the distance from its
/// middle (the spine of a slot, the axis of a hole). The same on both sides.
///
/// Shape  `wall` holds (distance, height above the bottom), neither falls; it begins at distance 0 and ends
///        on the feature's top at `depth_mm`. A rounded bottom is a polyline within the true arc: it holds
///        more material than the part, by 1 um at most for radii to 20 mm.
struct Section {
  std::vector<geometry::Vec2> wall;
  double depth_mm = 0.0;
  bool floor = true;  ///< the part has a surface at height 0 between the middle and the first wall
  [[nodiscard]] double half_width_mm() const { return wall.back().x; }
};

/// Nearer to the middle than this a pass is the middle itself, mm. Default, unsourced.
inline constexpr double kLeastU = 0.02;

/// Fails  TPA-UNSUPPORTED  the section narrows upwards (tee, dovetail), or a bottom that is not flat lies
///                         under a taper.
[[nodiscard]] Result<Section> slot_section(const model::FeatureShape& slot);
/// `below_mm`: how far a cutter may go below an open bottom.
[[nodiscard]] Result<Section> hole_section(const model::FeatureShape& hole, double below_mm);

/// The end of a rotating cutter as far as a section meets it: flat, corner radius, upright flank.
struct Tip {
  double radius_mm = 0.0;
  double corner_mm = 0.0;
};

/// Lowest height of the tip at which a cutter whose axis is u from the middle touches nothing.
///
///     h(u) = max over d in [u, u + R] of  wall(d) - end(d - u)
///
/// Exact for the polyline: on every straight piece the end's slope is met at one place. As the distance from
/// a spine changes no faster than one moves, what holds across the section holds for any spine and its ends.
/// Cost  the pieces of the wall.
/// Source  derived.
[[nodiscard]] double drop(const Section& s, const Tip& tip, double u_mm);
/// The largest distance u at which the tip fits at height h, mm; below 0: none.
[[nodiscard]] double widest_at(const Section& s, const Tip& tip, double height_mm);

/// One run of the cutter around the middle.
struct SectionPass {
  double u_mm = 0.0;
  double height_mm = 0.0;  ///< of the tip
};

/// What `finishing` came to.
struct Finishing {
  std::vector<SectionPass> passes;  ///< from above and outside to the middle
  double rest_mm = 0.0;             ///< most that stays where the cutter does not reach
};
/// Passes of a rounded cutter that leave at most `scallop_mm` where it reaches, at most `down_mm` apart in
/// height (0: any). Needs a corner radius.
[[nodiscard]] Finishing finishing(const Section& s, const Tip& tip, double scallop_mm, double down_mm);

/// Distance between the cutter at (u, height) and a point of the section, mm; below 0: the point is cut.
[[nodiscard]] double gap_to(const Tip& tip, const SectionPass& at, geometry::Vec2 point);

}  // namespace capstan::toolpath

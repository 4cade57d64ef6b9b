#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "planner/ground/base/job.h"
#include "planner/ground/base/result.h"
#include "planner/ground/geometry/placement.h"
#include "planner/model/nouns/forward.h"
#include "planner/model/plan/cutter_path.h"
#include "planner/model/plan/plan.h"

/// @file Curves that go along with a trajectory's basic curve: they have its parameter range (informal
/// proposition of cutter_location_trajectory), so that a place on one is a place on the other.

namespace capstan::exchange {

/// The basic curve's parameter at both ends of each move made of it; entry 0 has no move.
struct MoveParameters {
  std::vector<double> from, to;
  double first = 0.0, last = 0.0;
  [[nodiscard]] bool known() const { return last > first; }
};

/// Feeds a plan varies by along one path (default, unsourced): beyond, the numbers are something else, unless
/// the greatest is just 1.
inline constexpr double kLeastRatio = 0.01, kMostRatio = 4.0;

/// Ratio of each move's feed to the technology's, from a speed curve: the least along the move. The values
/// are multiples of that feed. Other meanings, metres per second or millimetres per minute, are recognised by
/// their size; if two are plausible, a warning EXC-SPEED-PROFILE says which is taken.
/// Fails  EXC-SPEED-PROFILE: another parameter range, values that are not positive or could be anything.
[[nodiscard]] Result<std::vector<double>> speed_ratios(const model::Model& m, model::AnyRef speed,
                                                       const MoveParameters& moves, double feed_mm_min,
                                                       Job& job);

/// For a curve that cannot be followed: the least multiple of the feed that it states anywhere, at most 1.
/// Fails  EXC-SPEED-PROFILE: a kind of curve whose values are not known, or values as above.
[[nodiscard]] Result<double> least_speed_ratio(const model::Model& m, model::AnyRef speed, double feed_mm_min,
                                               Job& job);

/// Adds the cross-section parameters of one trajectory, whose moves are the last ones of `path`: one sample
/// at each point of the basic curve. The total removal of the trajectory is distributed over them in
/// proportion to length times the mean area of both ends.
/// Fails  EXC-SECTIONS: another parameter range, or points of other than seven numbers.
[[nodiscard]] Status add_sections(const model::Model& m, const model::Trajectory& t,
                                  const MoveParameters& moves, const model::CutterPath& path,
                                  model::SectionSeries& out);

/// The largest angle between a curve of tool axes and the z of the frame that `frame` leads to, rad; nothing
/// for a curve that is no polyline of directions.
[[nodiscard]] std::optional<double> largest_tilt(const model::Model& m, model::AnyRef axes,
                                                 const geometry::Placement& frame);

}  // namespace capstan::exchange

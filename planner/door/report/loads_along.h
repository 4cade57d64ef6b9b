#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "planner/model/plan/plan.h"

namespace capstan::report {

/// Loads along the path of a step: columns, one entry per place.
struct LoadsAlong {
  std::vector<std::uint32_t> move;  ///< of the path
  std::vector<double> at_mm;        ///< from the start of the path, along it, rapids included
  std::vector<double> feed_mm_min, depth_mm, width_mm;
  std::vector<double> force_n, torque_nm, power_w,
      deflection_mm;    ///< expected: sharp edge, mean coefficients
  double margin = 1.0;  ///< what is compared with a limit is the expected load times this
  /// The spindle's at the speed there, 0 where it is not known; of a force what the holding resists, of the
  /// deflection what the tool's material does (0: not known).
  std::vector<double> torque_limit_nm, power_limit_w;
  /// The most that the axes allow there, along arcs by their acceleration, and that the operator allows; 0:
  /// not known.
  std::vector<double> feed_limit_mm_min;
  double force_limit_n = 0.0, deflection_limit_mm = 0.0;
};

/// At most so many places; of each piece of the path between two the largest of every load is kept.
inline constexpr std::size_t kMostPlaces = 1500;

/// The loads of the sections that the plan holds, at the feeds of its schedule, as the feed schedule counts
/// them: an irregular section is two rectangles. Where the law of milling does not hold (drills, reamers,
/// taps), torque, power and thrust of the step's own calculation while the tool cuts. Empty for a step
/// without sections.
///
/// Source  making/step/cut_samples.h, making/optimise/feeds/cut_loads.h.
[[nodiscard]] LoadsAlong loads_along(const model::Plan& plan, const model::StepResult& step);

}  // namespace capstan::report

#pragma once

#include <cstddef>
#include <optional>
#include <string>

#include "planner/ground/geometry/vec.h"
#include "planner/model/plan/plan.h"
#include "planner/proof/verify/program/program_checks.h"

namespace capstan::verify {

/// Where the ball's centre begins, and where its surface meets the wall: the set-up's frame, mm.
struct TouchWay {
  geometry::Vec3 start, wall;
  char axis = 'Z';
  double ball = 0.0, stem = 0.0;  ///< radii
};

[[nodiscard]] inline double along(const geometry::Vec3& v, char axis) {
  return axis == 'X' ? v.x : axis == 'Y' ? v.y : v.z;
}

/// The way of a touch of the plan; nothing where it states too little or goes along no axis.
[[nodiscard]] std::optional<TouchWay> way_of(const model::Plan& plan, model::AnyRef touch, std::size_t setup);

/// What is in the way straight down at the start and along the touch, by all of the raw piece and what holds
/// it, the probe taken as discs about its ways; empty: nothing is.
[[nodiscard]] std::string in_the_way(const model::Plan& plan, const TouchWay& way, std::size_t setup);

/// The steps between which a line of the program stands.
struct StandsBetween {
  const model::StepResult *behind = nullptr, *then = nullptr;  ///< of the plan; null: none that is known
  bool at_end = false;                                         ///< behind the last step of the program
  std::size_t next = 0;                                        ///< marker of `then`
  Findings::Where where;
};
[[nodiscard]] StandsBetween between_steps(const ProgramCase& c, long line);
/// Whether a touch that the plan has before that step (none: behind the last) may stand there: behind a step
/// of its set-up.
[[nodiscard]] bool stands_right(const StandsBetween& at, model::AnyRef before, std::size_t setup);
/// Whether the step behind it goes on without a call of a tool: it would cut with the probe.
[[nodiscard]] bool calls_no_tool(const ProgramCase& c, const StandsBetween& at);

}  // namespace capstan::verify

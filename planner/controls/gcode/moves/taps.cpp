#include "planner/controls/gcode/moves/taps.h"

#include <cmath>

#include "planner/ground/base/number.h"
#include "planner/model/nouns/executable.h"
#include "planner/model/nouns/operation.h"

namespace capstan::controls::gcode {
namespace {

using geometry::Vec3;
using model::MoveKind;
using model::MoveRole;

/// Feed and pitch times speed of a tap may differ by what rounding of either explains.
constexpr double kPitchAgreement = 0.01;

}  // namespace

Result<HoleInPath> tap_at(const model::Plan& plan, const model::StepResult& step, const model::Cutter& cutter,
                          std::size_t down, Vec3 top, double rpm) {
  const model::CutterPath& path = *step.path;
  const model::Control& control = plan.machine.control;
  const auto placed = [&](std::size_t i) {
    const Vec3 p = path.point(i);
    return Vec3{rounded(p.x, control.decimals), rounded(p.y, control.decimals),
                rounded(p.z, control.decimals)};
  };
  const Vec3 bottom = placed(down);
  std::size_t up = down + 1;
  while (up < path.size() && path.kind[up] == MoveKind::kDwell) ++up;
  const bool back = up < path.size() && path.kind[up] == MoveKind::kLine && path.role[up] == MoveRole::kTap &&
                    placed(up) == top;
  if (path.kind[down] != MoveKind::kLine || xy(bottom) != xy(top) || bottom.z >= top.z || !back)
    return fail("OUT-TAP", "a tapping move must run straight down and the same way back");
  if (rpm == 0.0) return fail("OUT-TAP", "the spindle stands still when tapping begins");
  const double feed = step.schedule ? step.schedule->feed_mm_min[down] : step.feed_mm_min;
  const double by_feed = feed / std::abs(rpm);
  const double pitch = cutter.thread_pitch_mm > 0.0 ? cutter.thread_pitch_mm : by_feed;
  if (std::abs(by_feed - pitch) > kPitchAgreement * pitch)
    return fail("OUT-TAP", "feed and speed make a pitch of " + trimmed(by_feed, 4) + " mm, the tap has " +
                               trimmed(pitch, 4) + " mm");
  HoleInPath out;
  out.last_move = up;
  HoleCycle& hole = out.cycle;
  hole.at = xy(top);
  hole.initial_z = hole.r_z = top.z;
  hole.bottom_z = bottom.z;
  hole.pitch_mm = pitch;
  hole.rpm = rpm;
  hole.decimals = control.decimals;
  hole.feed_decimals = control.feed_decimals;
  const auto* working = plan.model.get<model::MachiningWorkingstep>(step.step);
  const auto* tapping = working == nullptr ? nullptr : plan.model.get<model::Tapping>(working->its_operation);
  hole.in_chuck = tapping != nullptr && tapping->compensation_chuck.value_or(false);
  return out;
}

}  // namespace capstan::controls::gcode

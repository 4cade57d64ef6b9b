#include "planner/controls/gcode/moves/repeats.h"

#include <algorithm>

#include "planner/controls/gcode/moves/hole_cycles.h"
#include "planner/controls/gcode/program.h"
#include "planner/ground/base/number.h"

namespace capstan::controls::gcode {
namespace {

using model::MoveKind;

/// Fewer holes, or shorter ones, are no shorter as calls: a place and a call each.
constexpr std::size_t kLeastHoles = 3, kLeastLines = 3;

/// The moves of one hole as lines, the tool above it: each says its feed anew.
std::string lines_of(const model::StepResult& step, std::size_t first, std::size_t last, geometry::Vec3 at,
                     const model::Control& control, const Words& words) {
  Program lines(control, words);
  lines.stands_at(at);
  for (std::size_t i = first; i <= last; ++i) {
    const geometry::Vec3 to = lines.round(step.path->point(i));
    const double dwell = step.schedule ? step.schedule->dwell_s[i] : 0.0;
    if (step.path->kind[i] == MoveKind::kRapid)
      lines.rapid(to);
    else if (step.path->kind[i] == MoveKind::kLine)
      lines.cut(to, step.schedule ? step.schedule->feed_mm_min[i] : step.feed_mm_min);
    else if (rounded(dwell, words.dwell_decimals) > 0.0)
      lines.line(words.dwell(words.number(dwell, words.dwell_decimals)));
  }
  return lines.take();
}

}  // namespace

std::optional<Repeats> repeats_at(const model::StepResult& step, std::size_t move, geometry::Vec3 at,
                                  const model::Control& control, const Words& words) {
  const auto first = hole_at(step, move, at, control);
  if (!first || first->cycle.stops) return std::nullopt;
  Repeats out{lines_of(step, move, first->last_move, at, control, words),
              {xy(step.path->point(move))},
              first->last_move};
  if (static_cast<std::size_t>(std::count(out.lines.begin(), out.lines.end(), '\n')) < kLeastLines)
    return std::nullopt;
  const Program rounding(control, words);
  while (out.last_move + 2 < step.path->size()) {
    const std::size_t across = out.last_move + 1;
    const geometry::Vec3 to = rounding.round(step.path->point(across));
    const bool goes = step.path->kind[across] == MoveKind::kRapid && to.z == at.z &&
                      xy(to) != xy(rounding.round(step.path->point(out.last_move)));
    const auto next = goes ? hole_at(step, across + 1, to, control) : std::nullopt;
    const double rpm = step.schedule ? step.schedule->spindle_rpm[across] : step.spindle_rpm;
    if (!next || next->cycle.stops || next->cycle.rpm != first->cycle.rpm || rpm != first->cycle.rpm ||
        lines_of(step, across + 1, next->last_move, to, control, words) != out.lines)
      break;
    out.places.push_back(xy(step.path->point(across)));
    out.last_move = next->last_move;
  }
  return out.places.size() < kLeastHoles ? std::nullopt : std::optional(std::move(out));
}

}  // namespace capstan::controls::gcode

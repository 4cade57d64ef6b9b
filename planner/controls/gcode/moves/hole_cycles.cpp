#include "planner/controls/gcode/moves/hole_cycles.h"

#include "planner/ground/base/number.h"

namespace capstan::controls::gcode {
namespace {

using geometry::Vec3;
using model::MoveKind;
using model::StepResult;

/// The moves of one step as a control sees them.
class Moves {
 public:
  Moves(const StepResult& step, const model::Control& control) : step_(step), control_(control) {}

  [[nodiscard]] std::size_t size() const { return step_.path->size(); }
  [[nodiscard]] MoveKind kind(std::size_t i) const { return step_.path->kind[i]; }
  [[nodiscard]] Vec3 to(std::size_t i) const {
    const Vec3 p = step_.path->point(i);
    return {rounded(p.x, control_.decimals), rounded(p.y, control_.decimals),
            rounded(p.z, control_.decimals)};
  }
  [[nodiscard]] double feed(std::size_t i) const {
    return rounded(step_.schedule ? step_.schedule->feed_mm_min[i] : step_.feed_mm_min,
                   control_.feed_decimals);
  }
  [[nodiscard]] double rpm(std::size_t i) const {
    return step_.schedule ? step_.schedule->spindle_rpm[i] : step_.spindle_rpm;
  }
  [[nodiscard]] double dwell(std::size_t i) const {
    return step_.schedule ? step_.schedule->dwell_s[i] : 0.0;
  }

 private:
  const StepResult& step_;
  const model::Control& control_;
};

}  // namespace

std::optional<HoleInPath> hole_at(const StepResult& step, std::size_t move, Vec3 at,
                                  const model::Control& control) {
  const Moves m(step, control);
  std::size_t i = move;
  const auto straight = [&](std::size_t k) {
    return k < m.size() && m.kind(k) != MoveKind::kDwell && !model::is_arc(m.kind(k)) &&
           xy(m.to(k)) == xy(at);
  };
  double z = at.z;
  const auto in_air = [&](std::size_t k) {
    return m.kind(k) == MoveKind::kRapid || step.path->role[k] == model::MoveRole::kApproach;
  };
  for (; straight(i) && in_air(i) && m.to(i).z < z; ++i) z = m.to(i).z;
  if (i == move || m.kind(move) != MoveKind::kRapid) return std::nullopt;
  HoleInPath out;
  HoleCycle& h = out.cycle;
  h.at = xy(at);
  h.initial_z = at.z;
  h.r_z = z;
  h.rpm = m.rpm(move);
  h.decimals = control.decimals;
  h.feed_decimals = control.feed_decimals;
  const std::size_t first = i;
  for (; straight(i) && m.kind(i) == MoveKind::kLine && m.to(i).z < z; ++i) {
    if (m.feed(i) != m.feed(first) || step.path->role[i] == model::MoveRole::kTap) return std::nullopt;
    z = m.to(i).z;
  }
  if (i == first) return std::nullopt;
  h.bottom_z = z;
  h.feed_mm_min = m.feed(first);
  for (; i < m.size() && m.kind(i) == MoveKind::kDwell; ++i) h.dwell_s += m.dwell(i);
  // Out: at the same feed to R or above, or by rapid; to where the tool came from.
  if (!straight(i) || step.path->role[i] != model::MoveRole::kRetract) return std::nullopt;
  h.feeds_out = m.kind(i) == MoveKind::kLine;
  if (h.feeds_out && (m.feed(i) != h.feed_mm_min || m.to(i).z < h.r_z)) return std::nullopt;
  const std::size_t out_begins = i;
  for (; straight(i) && m.to(i).z > z && (i == out_begins || m.kind(i) == MoveKind::kRapid); ++i)
    z = m.to(i).z;
  if (z != at.z) return std::nullopt;
  // A peck is no hole of its own.
  if (straight(i) && m.kind(i) != MoveKind::kRapid) return std::nullopt;
  for (std::size_t k = move; k < i; ++k) {
    if (m.rpm(k) != h.rpm) return std::nullopt;
  }
  out.last_move = i - 1;
  return out;
}

std::optional<HolesInPath> holes_at(const StepResult& step, std::size_t move, Vec3 at,
                                    const model::Control& control) {
  const auto first = hole_at(step, move, at, control);
  if (!first) return std::nullopt;
  const HoleCycle& h = first->cycle;
  HolesInPath out{h, {xy(step.path->point(move))}, first->last_move};
  const Moves m(step, control);
  while (out.last_move + 2 < m.size()) {
    const std::size_t across = out.last_move + 1;
    const Vec3 to = m.to(across);
    if (m.kind(across) != MoveKind::kRapid || to.z != h.initial_z || m.rpm(across) != h.rpm) break;
    if (xy(to) == xy(m.to(out.last_move))) break;
    const auto next = hole_at(step, across + 1, to, control);
    if (!next) break;
    const HoleCycle& n = next->cycle;
    const bool equal = n.r_z == h.r_z && n.bottom_z == h.bottom_z && n.feeds_out == h.feeds_out &&
                       n.feed_mm_min == h.feed_mm_min && n.dwell_s == h.dwell_s && n.rpm == h.rpm;
    if (!equal) break;
    out.places.push_back(xy(step.path->point(across)));
    out.last_move = next->last_move;
  }
  return out;
}

bool cuts_across(const model::CutterPath& path) {
  for (std::size_t i = 1; i < path.size(); ++i) {
    if (path.kind[i] == MoveKind::kRapid || path.kind[i] == MoveKind::kDwell) continue;
    if (path.x[i] != path.x[i - 1] || path.y[i] != path.y[i - 1] || model::is_arc(path.kind[i])) return true;
  }
  return false;
}

}  // namespace capstan::controls::gcode

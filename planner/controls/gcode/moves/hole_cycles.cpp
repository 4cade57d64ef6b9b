#include "planner/controls/gcode/moves/hole_cycles.h"

#include <cmath>

#include "planner/ground/base/number.h"

namespace capstan::controls::gcode {
namespace {

using geometry::Vec3;
using model::MoveKind;
using model::MoveRole;
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

/// Reads one hole of a path from the first of its moves on.
class Hole {
 public:
  Hole(const StepResult& step, std::size_t move, Vec3 at, const model::Control& control)
      : step_(step), m_(step, control), at_(at), first_(move), i_(move), z_(at.z) {
    h_.at = xy(at);
    h_.initial_z = at.z;
    h_.decimals = control.decimals;
    h_.feed_decimals = control.feed_decimals;
  }

  std::optional<HoleInPath> read() {
    if (!through_air() || !fed()) return std::nullopt;
    h_.feed_mm_min = fed_at_;
    while (const auto back = peck()) {
      if (h_.pecks ? !(h_.pecks->clears == back->clears && near(h_.pecks->back_mm, back->back_mm) &&
                       h_.pecks->dwell_s == h_.dwell_s)
                   : !first_peck(*back))
        return std::nullopt;
      if (back->clears && !near(h_.r_z, back->top_z)) return std::nullopt;
      h_.pecks->bottoms_z.push_back(h_.bottom_z);
      i_ = back->next_move;
      z_ = m_.to(i_ - 1).z;
      h_.dwell_s = 0.0;
      if (!fed() || fed_at_ != h_.feed_mm_min) return std::nullopt;
    }
    if (!out()) return std::nullopt;
    return HoleInPath{h_, i_ - 1};
  }

 private:
  /// The way back from a bottom to where the next peck is fed.
  struct Back {
    bool clears = false;
    double back_mm = 0.0, top_z = 0.0;
    std::size_t next_move = 0;
  };

  [[nodiscard]] bool near(double a, double b) const {
    return std::abs(a - b) < 0.5 * std::pow(10.0, -h_.decimals);
  }
  [[nodiscard]] MoveRole role(std::size_t k) const { return step_.path->role[k]; }
  [[nodiscard]] bool straight(std::size_t k) const {
    return k < m_.size() && m_.kind(k) != MoveKind::kDwell && !model::is_arc(m_.kind(k)) &&
           xy(m_.to(k)) == h_.at;
  }

  bool through_air() {
    const auto in_air = [&](std::size_t k) {
      return m_.kind(k) == MoveKind::kRapid || role(k) == MoveRole::kApproach;
    };
    for (; straight(i_) && in_air(i_) && m_.to(i_).z < z_; ++i_) z_ = m_.to(i_).z;
    if (i_ == first_ || m_.kind(first_) != MoveKind::kRapid) return false;
    h_.r_z = z_;
    h_.rpm = m_.rpm(first_);
    return true;
  }

  /// Down at one feed to `bottom_z`, and the dwells there.
  bool fed() {
    const std::size_t begin = i_;
    for (; straight(i_) && m_.kind(i_) == MoveKind::kLine && m_.to(i_).z < z_; ++i_) {
      if (m_.feed(i_) != m_.feed(begin) || role(i_) == MoveRole::kTap) return false;
      z_ = m_.to(i_).z;
    }
    if (i_ == begin) return false;
    fed_at_ = m_.feed(begin);
    h_.bottom_z = z_;
    for (; i_ < m_.size() && m_.kind(i_) == MoveKind::kDwell; ++i_) h_.dwell_s += m_.dwell(i_);
    return true;
  }

  [[nodiscard]] std::optional<Back> peck() const {
    const auto link = [&](std::size_t k) {
      return straight(k) && m_.kind(k) == MoveKind::kLine && role(k) == MoveRole::kLink;
    };
    const bool clears = straight(i_) && m_.kind(i_) == MoveKind::kRapid && m_.to(i_).z > z_ && link(i_ + 1) &&
                        m_.to(i_ + 1).z < m_.to(i_).z;
    const std::size_t end = clears ? i_ + 1 : i_;
    if (!clears && !link(i_)) return std::nullopt;
    const double back = m_.to(end).z - z_;
    if (!(back > 0.0)) return std::nullopt;
    return Back{clears, back, m_.to(i_).z, end + 1};
  }

  /// Cleared holes are fed from where the tool comes back to: that is above where the path begins to.
  bool first_peck(const Back& back) {
    h_.pecks = Pecks{{}, back.clears, back.back_mm, h_.dwell_s};
    if (!back.clears) return true;
    if (back.top_z < h_.r_z || back.top_z > at_.z) return false;
    h_.r_z = back.top_z;
    return true;
  }

  /// At the same feed to R or above, or by rapid; to where the tool came from.
  bool out() {
    if (!straight(i_) || role(i_) != MoveRole::kRetract) return false;
    h_.feeds_out = m_.kind(i_) == MoveKind::kLine;
    if (h_.feeds_out && (m_.feed(i_) != h_.feed_mm_min || m_.to(i_).z < h_.r_z)) return false;
    const std::size_t begin = i_;
    for (; straight(i_) && m_.to(i_).z > z_ && (i_ == begin || m_.kind(i_) == MoveKind::kRapid); ++i_)
      z_ = m_.to(i_).z;
    if (z_ != at_.z) return false;
    // A peck is no hole of its own.
    if (straight(i_) && m_.kind(i_) != MoveKind::kRapid) return false;
    h_.stops = m_.rpm(begin) == 0.0 && !h_.feeds_out && !h_.pecks;
    for (std::size_t k = first_; k < i_; ++k) {
      if (m_.rpm(k) != (h_.stops && k >= begin ? 0.0 : h_.rpm)) return false;
    }
    return true;
  }

  const StepResult& step_;
  Moves m_;
  Vec3 at_;
  std::size_t first_, i_;
  double z_, fed_at_ = 0.0;
  HoleCycle h_;
};

}  // namespace

std::optional<HoleInPath> hole_at(const StepResult& step, std::size_t move, Vec3 at,
                                  const model::Control& control) {
  return Hole(step, move, at, control).read();
}

bool are_pecks(const HoleCycle& hole, double first_mm, double step_mm) {
  if (!hole.pecks || !(first_mm > 0.0) || !(step_mm > 0.0)) return false;
  const double half = 0.5 * std::pow(10.0, -hole.decimals);
  double z = hole.r_z - first_mm;
  for (const double bottom : hole.pecks->bottoms_z) {
    if (!(z > hole.bottom_z + half) || std::abs(z - bottom) > half) return false;
    z -= step_mm;
  }
  return z < hole.bottom_z + half;
}

std::optional<PeckSizes> peck_sizes(const HoleCycle& hole) {
  if (!hole.pecks || hole.pecks->bottoms_z.empty()) return std::nullopt;
  const auto& b = hole.pecks->bottoms_z;
  const double below = b.size() > 1 ? b[1] : hole.bottom_z;
  const PeckSizes out{rounded(hole.r_z - b[0], hole.decimals), rounded(b[0] - below, hole.decimals)};
  return are_pecks(hole, out.first_mm, out.step_mm) ? std::optional(out) : std::nullopt;
}

std::optional<HolesInPath> holes_at(const StepResult& step, std::size_t move, Vec3 at,
                                    const model::Control& control) {
  const auto first = hole_at(step, move, at, control);
  if (!first) return std::nullopt;
  const HoleCycle& h = first->cycle;
  HolesInPath out{h, {xy(step.path->point(move))}, first->last_move};
  if (h.stops) return out;  // the spindle is waited for before the next one
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
                       n.feed_mm_min == h.feed_mm_min && n.dwell_s == h.dwell_s && n.rpm == h.rpm &&
                       n.stops == h.stops && n.pecks == h.pecks;
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

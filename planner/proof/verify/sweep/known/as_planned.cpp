#include "planner/proof/verify/sweep/known/as_planned.h"

#include <algorithm>
#include <cmath>

namespace capstan::verify {
namespace {

using geometry::Vec3;
using model::MoveKind;

constexpr double kCoarsestMm = 5e-4;  ///< half a micrometre: coarser decimals are swept by themselves
constexpr double kMore = 1e-9;        ///< mm, more than the binary rounding of a decimal number

bool within(double a, double b, double by) { return std::abs(a - b) <= by + kMore; }
bool within(Vec3 a, Vec3 b, double by) {
  return within(a.x, b.x, by) && within(a.y, b.y, by) && within(a.z, b.z, by);
}
bool waits(const Move& m) { return m.kind == MoveKind::kDwell; }
/// A move that a text leaves out: its ends are the same number.
bool stays(const Move& m, double by) { return waits(m) || (!is_arc(m.kind) && within(m.from, m.to, by)); }
bool along_one_axis(const Move& m, double by) {
  const int moved = static_cast<int>(!within(m.from.x, m.to.x, by)) +
                    static_cast<int>(!within(m.from.y, m.to.y, by)) +
                    static_cast<int>(!within(m.from.z, m.to.z, by));
  return moved <= 1;
}
bool between(double v, double a, double b, double by) {
  return v >= std::min(a, b) - by - kMore && v <= std::max(a, b) + by + kMore;
}
bool between(Vec3 v, Vec3 a, Vec3 b, double by) {
  return between(v.x, a.x, b.x, by) && between(v.y, a.y, b.y, by) && between(v.z, a.z, b.z, by);
}
/// A written feed or speed that stands for a planned one, by decimals that the check allows for.
bool is_written(double text, double plan, double by) {
  return by <= kWritten * std::abs(plan) ? within(text, plan, by) : text == plan;
}

/// Feeds and speeds of a text, against planned ones.
struct Rates {
  double feed_mm_min, speed_rpm;
  [[nodiscard]] bool turn_alike(const Move& a, const Move& b) const {  // b: of the plan
    return is_written(a.spindle_rpm, b.spindle_rpm, speed_rpm);
  }
  [[nodiscard]] bool alike(const Move& a, const Move& b) const {
    return turn_alike(a, b) && is_written(a.feed_mm_min, b.feed_mm_min, feed_mm_min);
  }
};

bool same_cut(const Move& text, const Move& plan, const Rates& rates) {
  const double by = text.rounding_mm;
  if (text.kind != plan.kind || text.synchronised != plan.synchronised) return false;
  if (!within(text.from, plan.from, by) || !within(text.to, plan.to, by)) return false;
  if (is_arc(plan.kind)) {
    for (const double t : {0.25, 0.5, 0.75})
      if (!within(point_of(text, t), point_of(plan, t), 2.0 * by)) return false;
    const double radius = norm(xy(plan.from) - plan.centre);
    for (const Vec3 end : {text.from, text.to})
      if (!within(norm(xy(end) - text.centre), radius, 3.0 * by)) return false;
  }
  return rates.alike(text, plan);
}

}  // namespace

std::optional<AsPlanned> as_planned(const StepMoves& step, const std::vector<Move>& plan) {
  const std::vector<Move>& text = step.moves;
  if (text.empty() || plan.empty()) return std::nullopt;
  const Rates rates{step.feed_rounding_mm_min, step.speed_rounding_rpm};
  const double by = text.front().rounding_mm;
  if (!(by > 0.0) || by > kCoarsestMm) return std::nullopt;
  AsPlanned out;
  // To the path's first point, by rapids alone.
  std::size_t at = 0;
  while (at < text.size() && !within(text[at].from, plan.front().to, by)) {
    if (text[at].kind != MoveKind::kRapid && !waits(text[at])) return std::nullopt;
    ++at;
  }
  if (at == text.size()) return std::nullopt;
  out.first = at;
  out.where.assign(plan.size(), text[at].where);
  for (std::size_t i = 1; i < plan.size(); ++i) {
    const Move& p = plan[i];
    if (stays(p, by)) continue;
    // What stays at the place where the plan is, and turns as the plan will, does nothing.
    while (at < text.size() &&
           (waits(text[at]) || (stays(text[at], by) && within(text[at].from, p.from, by) &&
                                within(text[at].to, p.from, by) && rates.turn_alike(text[at], p))))
      ++at;
    if (at == text.size()) return std::nullopt;
    out.where[i] = text[at].where;
    if (p.kind != MoveKind::kRapid) {
      if (!same_cut(text[at], p, rates)) return std::nullopt;
      ++at;
      continue;
    }
    // Along one axis a rapid may be several that go on from each other.
    const bool may_be_several = along_one_axis(p, by);
    Vec3 place = p.from;
    for (bool there = false; !there; ++at) {
      if (at == text.size()) return std::nullopt;
      const Move& t = text[at];
      if (waits(t)) continue;
      there = within(t.to, p.to, by);
      if (t.kind != MoveKind::kRapid || !within(t.from, place, by) || !between(t.to, t.from, p.to, by) ||
          !rates.turn_alike(t, p) || !(there || may_be_several))
        return std::nullopt;
      place = t.to;
    }
  }
  out.last = at;
  for (; at < text.size(); ++at)
    if (text[at].kind != MoveKind::kRapid && !waits(text[at])) return std::nullopt;
  return out;
}

}  // namespace capstan::verify

#include <algorithm>
#include <cmath>

#include "planner/proof/verify/plan/plan_checks.h"

namespace capstan::verify {

using model::MoveKind;

namespace {

/// Components of the direction of travel at fraction t, unit length.
geometry::Vec3 heading(const Move& m, double t) {
  if (!is_arc(m.kind)) {
    const double n = norm(m.to - m.from);
    return n > 0.0 ? (1.0 / n) * (m.to - m.from) : geometry::Vec3{};
  }
  const geometry::Vec2 q = xy(point_of(m, t)) - m.centre;
  const double length = length_of(m);
  const double flat = norm(q) * sweep_of(m) / std::max(length, 1e-12);
  const double r = std::max(norm(q), 1e-12);
  return {-flat * q.y / r, flat * q.x / r, (m.to.z - m.from.z) / std::max(length, 1e-12)};
}

void check_speed(const StepMoves& step, const Move& m, const model::Machine& machine, Findings& findings) {
  const double n = std::abs(m.spindle_rpm);
  if (n == 0.0) return;
  const Findings::Where at{step.order + 1, step.id, m.where};
  const model::Spindle& s = machine.spindle;
  if (s.rpm_max > 0.0 && n > s.rpm_max * (1.0 + 1e-9))
    findings.error(16, "CHK-SPEED", at,
                   plain(n) + " 1/min; the machine's spindle has at most " + plain(s.rpm_max), n);
  if (n < s.rpm_min * (1.0 - 1e-9))
    findings.error(16, "CHK-SPEED-LOW", at,
                   plain(n) + " 1/min; the machine's spindle has at least " + plain(s.rpm_min), -n);
  if (step.cutter != nullptr && step.cutter->maximum_speed_rpm > 0.0 &&
      n > step.cutter->maximum_speed_rpm * (1.0 + 1e-9)) {
    findings.error(16, "CHK-SPEED-TOOL", at,
                   plain(n) + " 1/min; tool " + step.cutter->id + " allows at most " +
                       plain(step.cutter->maximum_speed_rpm),
                   n);
  }
}

constexpr double kFeedOver = 1.0005;  ///< share of an axis's limit that is none above it
constexpr double kNearer = 1.0004;    ///< less than that, so that rounding decides nothing

/// Whether no axis can be too fast whatever the direction: a heading's parts are 1 at most, on an arc whose
/// end is nearer to its centre than its start as much more as that.
bool slow_enough(const Move& m, const model::Machine& machine) {
  if (is_arc(m.kind) && norm(xy(m.from) - m.centre) > kNearer * norm(xy(m.to) - m.centre)) return false;
  for (std::size_t a = 0; a < 3; ++a) {
    const double most = machine.axes[a].feed_max_mm_min;
    if (most > 0.0 && !(m.feed_mm_min <= most)) return false;
  }
  return true;
}

void check_feed(const StepMoves& step, const Move& m, const model::Machine& machine, Findings& findings) {
  const Findings::Where at{step.order + 1, step.id, m.where};
  if (!(m.feed_mm_min > 0.0)) {
    findings.error(18, "CHK-FEED", at,
                   "the feed is " + plain(m.feed_mm_min) + " mm/min; it must be above zero");
    return;
  }
  if (slow_enough(m, machine)) return;
  double share[3] = {0.0, 0.0, 0.0};
  // An arc turns each way: its ends and quarters show the largest share of each axis.
  const int n = is_arc(m.kind) ? 16 : 1;
  for (int i = 0; i <= n; ++i) {
    const geometry::Vec3 h = heading(m, static_cast<double>(i) / n);
    share[0] = std::max(share[0], std::abs(h.x));
    share[1] = std::max(share[1], std::abs(h.y));
    share[2] = std::max(share[2], std::abs(h.z));
  }
  for (int a = 0; a < 3; ++a) {
    const double most = machine.axes[static_cast<std::size_t>(a)].feed_max_mm_min;
    if (most > 0.0 && m.feed_mm_min * share[a] > most * kFeedOver) {
      findings.error(18, "CHK-FEED-AXIS", at,
                     "axis " + machine.axes[static_cast<std::size_t>(a)].name + " would feed at " +
                         plain(m.feed_mm_min * share[a]) + " mm/min; its limit is " + plain(most) +
                         ": feed slower",
                     m.feed_mm_min * share[a] / most);
    }
  }
}

void check_arc(const StepMoves& step, const Move& m, double gap, Findings& findings) {
  const Findings::Where at{step.order + 1, step.id, m.where};
  const double r0 = norm(xy(m.from) - m.centre);
  const double r1 = norm(xy(m.to) - m.centre);
  if (std::abs(r0 - r1) > gap) {
    findings.error(23, "CHK-ARC", at,
                   "the arc's radius is " + mm(r0) + " at its start and " + mm(r1) +
                       " at its end; they may differ by " + mm(gap),
                   std::abs(r0 - r1));
  }
  const double chord = norm(xy(m.to) - xy(m.from));
  if (std::max(r0, r1) < kShortestChordMm) {
    findings.error(24, "CHK-ARC-ZERO", at, "an arc of radius " + plain(std::max(r0, r1) * 1000.0) + " um");
  } else if (chord > 1e-9 && chord < kShortestChordMm) {
    findings.error(24, "CHK-ARC-FULL", at,
                   "an arc whose ends are " + plain(chord * 1000.0) +
                       " um apart: after rounding it is a full turn or nothing");
  }
}

}  // namespace

void check_moves(const StepMoves& step, const model::Machine& machine, double radius_gap_mm,
                 Findings& findings) {
  double speed = -1.0;
  for (const Move& m : step.moves) {
    if (m.spindle_rpm != speed && m.kind != MoveKind::kDwell) {
      speed = m.spindle_rpm;
      check_speed(step, m, machine, findings);
    }
    if (m.kind == MoveKind::kRapid || m.kind == MoveKind::kDwell) continue;
    check_feed(step, m, machine, findings);
    if (is_arc(m.kind)) check_arc(step, m, radius_gap_mm, findings);
  }
}

void Extents::add(const StepMoves& step, Findings& findings) {
  geometry::Box3& box = boxes_[step.setup];
  bool* said = said_[step.setup].data();
  for (const Move& m : step.moves) {
    const geometry::Box3 b = box_of(m);
    if (b.hi.z >= kUnknownHeightMm) continue;
    box.add(b.lo);
    box.add(b.hi);
    const geometry::Vec3 size = box.size();
    const double lengths[3] = {size.x, size.y, size.z};
    for (std::size_t a = 0; a < 3; ++a) {
      const model::LinearAxis& axis = machine_.axes[a];
      const double travel = axis.travel_max_mm - axis.travel_min_mm;
      if (said[a] || !(travel > 0.0) || lengths[a] <= travel + 1e-6) continue;
      said[a] = true;
      findings.error(22, "CHK-TRAVEL-" + axis.name, {step.order + 1, step.id, m.where},
                     "with this move the paths of one set-up span " + mm(lengths[a]) + " in " + axis.name +
                         ", arcs included; the axis travels " + mm(travel));
    }
  }
}

void check_limits(const model::Plan& plan, const std::vector<StepMoves>& steps, Findings& findings) {
  Extents extents(plan.machine);
  for (std::size_t i = 0; i < steps.size(); ++i) {
    const StepMoves& s = steps[i];
    check_moves(s, plan.machine, kRadiusGapMm, findings);
    extents.add(s, findings);
    if (s.cutter == nullptr || s.planned == nullptr) continue;
    const Findings::Where at{s.order + 1, s.id, -1};
    const bool mills = s.planned->radial_depth_mm > 0.0;
    if (mills && s.cutter->maximum_depth_of_cut_mm > 0.0 &&
        s.planned->axial_depth_mm > s.cutter->maximum_depth_of_cut_mm + 1e-6) {
      findings.error(20, "CHK-DEPTH-PLANNED", at,
                     "an axial depth of " + mm(s.planned->axial_depth_mm) + "; tool " + s.cutter->id +
                         " has at most " + mm(s.cutter->maximum_depth_of_cut_mm) +
                         ": cut in more levels, or use a longer edge");
    }
    if (mills && s.planned->radial_depth_mm > s.cutter->cutting_diameter_mm + 1e-6) {
      findings.error(20, "CHK-WIDTH-PLANNED", at,
                     "a radial depth of " + mm(s.planned->radial_depth_mm) + "; the diameter of tool " +
                         s.cutter->id + " is " + mm(s.cutter->cutting_diameter_mm) +
                         ": cut less wide, or use a larger one");
    }
  }
}

}  // namespace capstan::verify

#include "planner/making/toolpath/link/path_writer.h"

#include <algorithm>
#include <utility>

namespace capstan::toolpath {

using geometry::Vec2;
using geometry::Vec3;
using model::MoveRole;

namespace {
constexpr double kNothing = 1e-9;  // mm; shorter moves are not written
}

PathWriter::PathWriter(const PathJob& task)
    : security_z_(task.security_z_mm),
      rapid_z_(std::min(std::max(task.retract_z_mm, task.start_z_mm + task.clearance_mm),
                        std::max(task.security_z_mm, task.start_z_mm + task.clearance_mm))) {
  security_z_ = std::max(security_z_, rapid_z_);
}

void PathWriter::fill() {
  out_.feed_factor.resize(out_.path.size(), feed_);
  out_.speed_factor.resize(out_.path.size(), speed_);
  out_.dwell_s.resize(out_.path.size(), 0.0);
  if (pending_dwell_ > 0.0) out_.dwell_s.back() = std::exchange(pending_dwell_, 0.0);
}

void PathWriter::over(Vec2 p) {
  if (!begun()) {
    out_.path.start({p.x, p.y, security_z_});
    fill();
    if (security_z_ - rapid_z_ > kNothing) out_.path.rapid({p.x, p.y, rapid_z_}, MoveRole::kApproach);
    fill();
    return;
  }
  retract();
  if (norm(xy(at()) - p) > kNothing) out_.path.rapid({p.x, p.y, at().z}, MoveRole::kLink);
  fill();
}

void PathWriter::descend(double z_mm, double material_z_mm) {
  const Vec3 p = at();
  const double air = std::max(z_mm, material_z_mm);
  line({p.x, p.y, std::min(air, p.z)}, MoveRole::kApproach);
  line({p.x, p.y, z_mm}, MoveRole::kPlunge);
}

void PathWriter::line(Vec3 to, MoveRole why) {
  if (norm(to - at()) <= kNothing) return;
  out_.path.line(to, why);
  fill();
}

/// Adds an arc. A control takes an arc whose ends it cannot distinguish for a full turn, or for nothing. Such
/// an arc becomes a line below half a turn, and two arcs above. Ends that agree exactly mean a full turn.
void PathWriter::arc(Vec3 to, Vec2 centre, bool clockwise, MoveRole why) {
  const Vec2 from = xy(at());
  const double chord = norm(xy(to) - from);
  if (chord > kNothing && chord < kSmallestArc) {
    const double turn = cross(from - centre, xy(to) - centre);
    if ((turn < 0.0) == clockwise) {
      line(to, why);
      return;
    }
    const Vec2 over = 2.0 * centre - from;
    out_.path.arc({over.x, over.y, 0.5 * (at().z + to.z)}, centre, clockwise, why);
    fill();
  }
  out_.path.arc(to, centre, clockwise, why);
  fill();
}

void PathWriter::follow(const Track& t, double z_mm, MoveRole why) {
  for (const Segment& s : t.segments) {
    const Vec3 to{s.to.x, s.to.y, z_mm};
    if (s.bend == Bend::kStraight) {
      line(to, why);
    } else {
      arc(to, s.centre, s.bend == Bend::kCw, why);
    }
  }
}

void PathWriter::follow_down(const Track& t, double z_mm, const Descent& descent, MoveRole why) {
  const double total = descent.of(t);
  const double from = at().z;
  double s = 0.0;
  Vec2 last = t.start;
  for (std::size_t i = 0; i < t.segments.size(); ++i) {
    const Segment& seg = t.segments[i];
    s += descent.of(length_of(last, seg));
    const double z = s >= total || i + 1 == t.segments.size() ? z_mm : from + (z_mm - from) * (s / total);
    const Vec3 to{seg.to.x, seg.to.y, z};
    if (seg.bend == Bend::kStraight) {
      line(to, why);
    } else {
      arc(to, seg.centre, seg.bend == Bend::kCw, why);
    }
    last = seg.to;
  }
}

void PathWriter::rapid_up(double z_mm) {
  const Vec3 p = at();
  if (z_mm - p.z <= kNothing) return;
  out_.path.rapid({p.x, p.y, z_mm}, MoveRole::kRetract);
  fill();
}

void PathWriter::dwell(double seconds) {
  if (!(seconds > 0.0)) return;
  out_.path.dwell();
  pending_dwell_ = seconds;
  fill();
}

void PathWriter::retract() { rapid_up(rapid_z_); }

void PathWriter::factors(double feed, double speed) {
  feed_ = feed;
  speed_ = speed;
}

GeneratedPath PathWriter::finish() {
  if (begun()) rapid_up(security_z_);
  return std::move(out_);
}

}  // namespace capstan::toolpath

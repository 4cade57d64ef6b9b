#include "planner/making/toolpath/freeform/rough/ways_in.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "planner/making/toolpath/defaults.h"
#include "planner/making/toolpath/freeform/rough/levels.h"
#include "planner/physics/stock/sweep.h"

namespace capstan::toolpath::freeform {

using geometry::Vec2;
using geometry::Vec3;
using model::MoveRole;

namespace {
/// More turns of a ramp than this and a place counts as not to be entered; default, unsourced.
constexpr int kMostRampTurns = 100;
}  // namespace

void WaysIn::begin_level(double above_mm, bool raised) {
  above_ = above_mm;
  raised_ = raised;
  if (!raised) ends.clear();
}

bool WaysIn::approach(Vec2 p, double z) {
  if (down_ && here().z <= z && norm(xy(here()) - p) <= 2.0 * radius_ &&
      reach_.is_free(xy(here()), p, z, 0.5)) {
    line({here().x, here().y, z}, MoveRole::kRetract);
    line({p.x, p.y, z}, MoveRole::kCut);
    return true;
  }
  std::optional<Vec2> from;
  for (const Vec2 e : ends) {
    if (norm(e - p) > 2.0 * radius_ || (from && norm(e - p) >= norm(*from - p))) continue;
    if (reach_.is_free(e, p, z, 0.5)) from = e;  // the cutter was there at this level
  }
  if (!from && (task_.left_mm || raised_)) from = air_near(p, z);
  if (!from) return false;
  come_down({from->x, from->y, z}, stock::max_height(rest_.map, *from, radius_), task_.terrace_mm > 0.0);
  down_ = true;
  line({p.x, p.y, z}, MoveRole::kCut);
  return true;
}

bool WaysIn::ramp_along(const std::vector<Vec2>& line, double z) {
  const double angle = ramp_angle();
  if (!(task_.terrace_mm > 0.0) || line.front() != line.back() || !(angle > 0.0)) return false;
  double length = 0.0, material = z;
  bool clear = true;
  for (std::size_t i = 1; i < line.size(); ++i) {
    length += norm(line[i] - line[i - 1]);
    material = std::max(material, stock::max_height(rest_.map, line[i], radius_));
    clear = clear && is_clear(line[i], above_);
    if (!reach_.is_free(line[i - 1], line[i], z, 0.5)) return false;
  }
  const double top = clear ? std::clamp(above_, z, material) : material;
  const double turns = std::ceil((top - z) / (length * std::tan(angle)) - 1e-9);
  if (length < radius_ || turns > kMostRampTurns) return false;
  come_down({line.front().x, line.front().y, top}, top);
  down_ = true;
  double way = 0.0;
  for (int turn = 0; turn < static_cast<int>(turns); ++turn) {
    for (std::size_t i = 1; i < line.size(); ++i) {
      way += norm(line[i] - line[i - 1]);
      const double deep = std::min(1.0, way / (turns * length));
      this->line({line[i].x, line[i].y, top - deep * (top - z)}, MoveRole::kRamp);
    }
  }
  this->line({line.front().x, line.front().y, z}, MoveRole::kRamp);
  return true;
}

double WaysIn::ramp_angle() const {
  const double most = task_.cutter.maximum_ramp_angle_rad;
  return task_.ramp_angle_rad > 0.0 ? std::min(most, task_.ramp_angle_rad) : most;
}

std::optional<Vec2> WaysIn::air_near(Vec2 p, double z) const {
  constexpr int kRings = 16, kAround = 24;
  std::uint32_t hint = 0;
  for (int k = 1; k <= kRings; ++k) {
    const double r = 2.0 * radius_ * k / kRings;
    for (int i = 0; i < kAround; ++i) {
      const double a = 2.0 * std::numbers::pi * i / kAround;
      const Vec2 q = p + Vec2{r * std::cos(a), r * std::sin(a)};
      if (!is_clear(q, z) || grid_.blocks(q, p, z)) continue;
      if (reach_.is_free(q, z, hint) && reach_.is_free(q, p, z, 0.5)) return q;
    }
  }
  return std::nullopt;
}

bool WaysIn::is_clear(Vec2 p, double z) const {
  return task_.terrace_mm > 0.0 ? rest_.is_clear(p, z) : rest_.is_below(p, z);
}

bool WaysIn::is_open(double u, double far, double v, double z) const {
  return is_clear(hatch_.place(u, v), z) || air_before(u, far, v, z);
}

bool WaysIn::enter(double u, double far, double v, double z) {
  if (is_clear(hatch_.place(u, v), z)) {
    come_down(at(u, v, z), z);
    return true;
  }
  if (const auto beside = air_before(u, far, v, z)) {
    come_down(at(*beside, v, z), z);
    line(at(u, v, z), MoveRole::kCut);
    return true;
  }
  if (task_.terrace_mm > 0.0) {
    if (const auto q = air_near(hatch_.place(u, v), z)) {  // from what a pass beside it has cleared
      come_down({q->x, q->y, z}, z);
      line(at(u, v, z), MoveRole::kCut);
      return true;
    }
  }
  const double leg = std::min(std::abs(far - u), 4.0 * radius_);
  const double end = u + (far > u ? leg : -leg);
  double top = stock::max_height(rest_.map, hatch_.place(u, v), hatch_.place(end, v), radius_);
  const auto probe = [&](double w) { return is_clear(hatch_.place(u + w * (end - u), v), above_); };
  if (above_ < top && probe(0.0) && probe(0.25) && probe(0.5) && probe(0.75) && probe(1.0))
    top = std::max(z, above_);
  const double angle = ramp_angle();
  if (angle > 0.0 && leg >= 0.5 * radius_) {
    const double turns = std::ceil((top - z) / (2.0 * leg * std::tan(angle)) - 1e-9);
    if (turns <= kMostRampTurns) {
      ramp(u, end, v, top, z, std::max(1, static_cast<int>(turns)));
      return true;
    }
  }
  // Too short for a ramp.
  const bool deep = rest_.stands(hatch_.place(u, v), z + kStraightTerraces * task_.terrace_mm);
  if (task_.terrace_mm > 0.0 && angle > 0.0 && deep) return false;
  if (!task_.cutter.centre_cutting) return false;
  come_down(at(u, v, z), stock::max_height(rest_.map, hatch_.place(u, v), radius_));
  return true;
}

std::optional<double> WaysIn::air_before(double u, double far, double v, double z) const {
  constexpr int kPlaces = 24;
  const double step = 3.0 * radius_ / kPlaces * (far > u ? -1.0 : 1.0);
  const Vec2 begin = hatch_.place(u, v);
  for (int k = 1; k <= kPlaces; ++k) {
    const Vec2 p = hatch_.place(u + k * step, v);
    if (is_clear(p, z)) return reach_.is_free(p, begin, z) ? std::optional(u + k * step) : std::nullopt;
  }
  return std::nullopt;
}

void WaysIn::ramp(double u, double end, double v, double top, double z, int turns) {
  come_down(at(u, v, top), top);
  for (int k = 0; k < 2 * turns; ++k) {
    const double next = k + 1 == 2 * turns ? z : top - (top - z) * (k + 1) / (2.0 * turns);
    line(at(k % 2 == 0 ? end : u, v, next), MoveRole::kRamp);
  }
}

void WaysIn::come_down(Vec3 p, double material, bool was_there) {
  const Vec3 high{p.x, p.y, task_.security_z_mm};
  if (path_.size() == 0) {
    path_.start(high);
  } else if (!link_low(p)) {
    lift();
    path_.rapid(high);
  }
  double fast = std::max(material, p.z) + task_.clearance_mm;
  // A raw piece may be larger than it is drawn: fast no lower than above one that is as near.
  const double beside = stock::max_height(rest_.map, xy(p), radius_ + kAboveRaw);
  if (is_raw(beside)) fast = std::max(fast, beside + std::min(task_.clearance_mm, kAboveRaw));
  const double z = std::min(here().z, fast);
  if (z < task_.security_z_mm && here().z == task_.security_z_mm)
    path_.rapid({p.x, p.y, z}, MoveRole::kApproach);
  // Beside the piece nothing is near; on what is cleared the tip comes to stand on material.
  constexpr double kNearMm = 0.1;
  if (rest_.is_below(xy(p), p.z - kNearMm)) return line(p, MoveRole::kApproach);
  const double top = was_there || is_clear(xy(p), p.z) ? p.z : std::max(material, p.z);
  const double near = top + (is_raw(material) ? kAboveRaw : kAirAbove);
  if (near < here().z) line({p.x, p.y, near}, MoveRole::kApproach);
  line(p, MoveRole::kPlunge);
}

bool WaysIn::is_raw(double material) const { return material >= task_.top_z_mm - kNothing; }

bool WaysIn::link_low(Vec3 p) {
  if (!down_) return false;
  const double material = stock::max_height(rest_.map, xy(here()), xy(p), radius_);
  const double z = std::max({material + (is_raw(material) ? kAboveRaw : kAirAbove), here().z, p.z});
  // At the feed of air, no farther than up to the plane and down again, both of them fast.
  if (norm(xy(p) - xy(here())) > 2.0 * (task_.security_z_mm - z)) return false;
  if (!reach_.is_free(xy(here()), xy(p), z, 0.5)) return false;
  line({here().x, here().y, z}, MoveRole::kRetract);
  line({p.x, p.y, z}, MoveRole::kLink);
  return true;
}

void WaysIn::lift() {
  const Vec3 p = here();
  if (p.z < task_.security_z_mm) path_.line({p.x, p.y, task_.security_z_mm}, MoveRole::kRetract);
  down_ = false;
}

void WaysIn::line(Vec3 to, MoveRole why) {
  constexpr double kNoWay = 1e-6;  // mm, shorter than a program's digits say
  if (path_.size() > 0 && norm(here() - to) < kNoWay) return;
  path_.line(to, why);
  stock::cut(rest_.map, rest_.profile, path_, path_.size() - 1);
}

}  // namespace capstan::toolpath::freeform

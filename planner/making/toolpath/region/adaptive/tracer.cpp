#include "planner/making/toolpath/region/adaptive/tracer.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "planner/ground/base/stopping.h"

// The arc of contact of a straight cut is acos(1 - ae / r) (WIDIA, Trochoidal Milling, page 7: 36.87 degrees
// at a tenth of the diameter). A pass turns at each step as far towards the material as that arc allows: the
// new direction is the root of (arc of contact - that of the straight cut), found by secants within the turns
// that a step may make. On a smooth front this is the curve whose foremost contact runs along the front at a
// constant angle to the travel, a tractrix of the front. Where the step would leave the centres, it slides
// along their boundary; if it then touches too much, it turns away. Without contact the cutter curls towards
// the material.

namespace capstan::toolpath {

using geometry::Vec2;

namespace {

// Without another reason: defaults, unsourced, chosen by what the tests measure.
// Length of a step as a part of the radius: its sagitta on a circle of half the radius is a thousandth of it.
constexpr double kStepPart = 0.06;
// Radius of a curl towards the material, as a part of the cutter's: a machine follows it at feed.
constexpr double kCurlPart = 0.5;
constexpr double kMostLeft = 1.8;               // rad: away from a front met square on; more is another pass
constexpr double kContactFound = 0.005;         // of the limit: accuracy of the root
constexpr double kNoContact = 0.01;             // of the limit
constexpr double kTurnedInto = 0.05;            // of the limit: what a turn on the spot may add
constexpr double kIdleLength = 3.0;             // radii without contact, after which a pass has ended
constexpr double kIdleTurn = std::numbers::pi;  // likewise
constexpr double kOwnSweep = 8.0;               // radii of length after which the ground is taken anew
constexpr double kOwnTurn = 2.0;                // rad, likewise
constexpr double kOwnFront = 0.2;               // rad of turn after which its own sweep may lie before it
constexpr std::size_t kVisitedEvery = 3;        // steps between places that stand for the sweep
constexpr std::size_t kMostPlaces = 1'000'000;

Vec2 turned(Vec2 v, double rad) {
  const double c = std::cos(rad);
  const double s = std::sin(rad);
  return {c * v.x - s * v.y, s * v.x + c * v.y};
}

std::size_t cell_of(double v, double lo, double cell, std::size_t n) {
  return static_cast<std::size_t>(std::clamp(std::floor((v - lo) / cell), 0.0, static_cast<double>(n - 1)));
}

double angle_between(Vec2 a, Vec2 b) { return std::atan2(cross(a, b), dot(a, b)); }

}  // namespace

double Bite::arc_rad() const {
  return std::acos(std::clamp((radius_mm - radial_mm) / (radius_mm - blind_mm), -1.0, 1.0));
}

Walls::Walls(const geometry::Region& centres) : inside_(centres) {
  const auto box = geometry::bounds(centres);
  lo_ = box.lo;
  const Vec2 size = box.hi - box.lo;
  cell_ = std::max({size.x / 64.0, size.y / 64.0, 1e-6});
  columns_ = static_cast<std::size_t>(std::max(0.0, size.x / cell_)) + 1;
  rows_ = static_cast<std::size_t>(std::max(0.0, size.y / cell_)) + 1;
  cells_.resize(columns_ * rows_);
  const auto index = [&](double v, double lo, std::size_t n) { return cell_of(v, lo, cell_, n); };
  for (const auto& loop : centres.loops) {
    for (std::size_t i = 0; i < loop.size(); ++i) {
      const Edge e{loop[i], loop[(i + 1) % loop.size()]};
      for (std::size_t y = index(std::min(e.a.y, e.b.y), lo_.y, rows_);
           y <= index(std::max(e.a.y, e.b.y), lo_.y, rows_); ++y) {
        for (std::size_t x = index(std::min(e.a.x, e.b.x), lo_.x, columns_);
             x <= index(std::max(e.a.x, e.b.x), lo_.x, columns_); ++x) {
          cells_[y * columns_ + x].push_back(e);
        }
      }
    }
  }
}

Walls::Place Walls::nearest(Vec2 p, double within_mm) const {
  const auto index = [&](double v, double lo, std::size_t n) { return cell_of(v, lo, cell_, n); };
  Place best;
  for (std::size_t y = index(p.y - within_mm, lo_.y, rows_); y <= index(p.y + within_mm, lo_.y, rows_); ++y) {
    for (std::size_t x = index(p.x - within_mm, lo_.x, columns_);
         x <= index(p.x + within_mm, lo_.x, columns_); ++x) {
      for (const Edge& e : cells_[y * columns_ + x]) {
        const Vec2 d = e.b - e.a;
        const double l2 = dot(d, d);
        const double t = l2 > 0.0 ? std::clamp(dot(p - e.a, d) / l2, 0.0, 1.0) : 0.0;
        const Vec2 q = e.a + t * d;
        const double distance = norm(p - q);
        if (distance < best.distance_mm - 1e-12) best = {q, distance};
      }
    }
  }
  return best;
}

Vec2 Walls::kept(Vec2 p) const {
  if (inside_.contains(p)) return p;
  for (double within = cell_; within < 1e6; within *= 4.0) {
    const Place place = nearest(p, within);
    if (place.distance_mm <= within) return place.point;
  }
  return p;
}

Tracer::Tracer(const Walls& walls, const Bite& bite, Vec2 start, Vec2 heading)
    : walls_(walls),
      bite_(bite),
      limit_(bite.arc_rad()),
      length_(kStepPart * bite.radius_mm),
      right_(kStepPart / kCurlPart),
      heading_(heading),
      line_({start}) {}

Tracer::Step Tracer::step(ContactMeter& ground, double right_rad) const {
  Step out;
  const Vec2 from = line_.back();
  out.heading = turned(heading_, -right_rad);
  out.to = from + length_ * out.heading;
  if (!walls_.contains(out.to)) {
    out.to = walls_.kept(out.to);
    const Vec2 d = out.to - from;
    const double l = norm(d);
    // Straight into the wall: hardly a step.
    if (l < 0.4 * length_) return out;
    out.heading = (1.0 / l) * d;
    if (angle_between(heading_, out.heading) > kMostLeft) return out;
  }
  out.contact = ground.arc(out.to, out.heading);
  out.possible = true;
  // A turn to the right turns the front half into what its side just left, before the step is made.
  if (-angle_between(heading_, out.heading) > kTurnedInto * limit_)
    out.contact = std::max(out.contact, ground.arc(from, out.heading) - kTurnedInto * limit_);
  return out;
}

Tracer::Step Tracer::best(ContactMeter& ground) const {
  // On most fronts the turn of the step before is near the one that is sought.
  Step good = step(ground, last_right_);
  double at = last_right_;
  double bad = right_;
  double over = std::numbers::pi;
  if (good.possible && good.contact <= limit_) {
    if (good.contact >= (1.0 - kContactFound) * limit_) return good;
    const Step right = step(ground, right_);
    if (right.possible && right.contact <= limit_) return right;
    if (right.possible) over = right.contact;
  } else {
    // Leftwards in growing turns until a step is allowed; then back towards the limit.
    double by = 0.1 * right_;
    while (!good.possible || good.contact > limit_) {
      bad = at;
      over = good.possible ? good.contact : std::numbers::pi;
      at -= by;
      if (at < -kMostLeft) return {};
      good = step(ground, at);
      by = std::min(2.0 * by, 0.15);
    }
  }
  for (int i = 0; i < 8; ++i) {
    if (good.contact >= (1.0 - kContactFound) * limit_ || bad - at < 1e-3) break;
    double t = (limit_ - good.contact) / std::max(over - good.contact, 1e-12);
    t = std::clamp(t, 0.1, 0.9);
    const double turn = at + t * (bad - at);
    const Step s = step(ground, turn);
    if (s.possible && s.contact <= limit_) {
      good = s;
      at = turn;
    } else {
      bad = turn;
      over = s.possible ? s.contact : std::numbers::pi;
    }
  }
  return good;
}

Tracer::End Tracer::run(ContactMeter& ground) {
  double length = 0.0;
  double turn = 0.0;
  std::size_t steps = 0;
  std::vector<Vec2> held;
  while (line_.size() < kMostPlaces) {
    tick();
    const Step s = best(ground);
    if (!s.possible) return End::kBlocked;
    const double by = angle_between(heading_, s.heading);
    turn += by;
    last_right_ = std::clamp(-by, -right_, right_);
    length += norm(s.to - line_.back());
    line_.push_back(s.to);
    heading_ = s.heading;
    // Its own sweep lies before it only once it has turned.
    if (++steps % kVisitedEvery == 0) held.push_back(s.to);
    if (std::abs(turn) > kOwnFront) {
      for (const Vec2 p : held) ground.visited(p);
      held.clear();
    }
    if (s.contact > kNoContact * limit_) {
      idle_mm_ = idle_turn_ = 0.0;
      cut_ = line_.size();
    } else {
      idle_mm_ += length_;
      idle_turn_ += by;
      if (idle_mm_ > kIdleLength * bite_.radius_mm || std::abs(idle_turn_) > kIdleTurn) return End::kAir;
    }
    if (length > kOwnSweep * bite_.radius_mm || std::abs(turn) > kOwnTurn) return End::kFurther;
  }
  return End::kAir;
}

}  // namespace capstan::toolpath

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "planner/proof/verify/findings.h"
#include "planner/proof/verify/program/block_state.h"

// A pocket cycle made into moves. No manual says each move of the control's: these cover what it may cut,
// with the cutter as deep and as wide in the material as any path with these parameters can have it.

namespace capstan::verify {

using geometry::Vec2;
using geometry::Vec3;
using model::MoveKind;

namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kNothing = 1e-9;

/// A rectangle that the tool's centre goes round, with its corners' radius.
struct Ring {
  double along_mm = 0.0, across_mm = 0.0, corner_mm = 0.0;
};

}  // namespace

double BlockState::called_diameter_mm() const {
  double out = 0.0;
  for (const HeaderTool& t : out_.tools) {
    if (t.tool == tool_) out = t.diameter_mm.value_or(0.0);
  }
  return out;
}

// Level by level from the middle out: along the middle, which is a full slot, then rings to the walls.
void BlockState::mill(Pocket p) {
  p.line = line_;
  const auto wrong = [&](const std::string& why) { fault(26, "CHK-CYCLE", "the pocket cycle: " + why); };
  p.cutter_mm = called_diameter_mm();
  if (!(p.cutter_mm > 0.0))
    return fault(
        33, "CHK-UNVERIFIABLE",
        "the pocket cycle's path hangs on the tool's diameter, which the program's header does not say",
        true);
  if (p.width_mm > p.length_mm) {
    std::swap(p.width_mm, p.length_mm);
    p.angle_rad += 0.5 * kPi;
  }
  const double inset = 0.5 * p.cutter_mm + p.side_mm;
  const double across = 0.5 * p.width_mm - inset, along = 0.5 * p.length_mm - inset;
  if (across < 0.0 || p.corner_mm + kNothing < 0.5 * p.cutter_mm)
    return wrong("it is narrower than the tool of diameter " + mm(p.cutter_mm));
  if (p.corner_mm > 0.5 * p.width_mm + kNothing) return wrong("its corners are rounder than half its width");
  const double depth = p.reference_z - p.floor_z - p.bottom_mm;
  if (!(depth > 0.0) || !(p.level_mm > 0.0)) return wrong("it has no depth, or its levels have none");
  if (p.start_z < p.reference_z || p.back_z < p.start_z)
    return wrong("its planes are not one above the other");
  if (!(p.feed_mm_min > 0.0) || !(p.ramp_feed_mm_min > 0.0)) return wrong("it has no feed");
  if (!known_[0] || !known_[1] || !known_[2]) return wrong("it begins where the position is not known");
  if (at_.z < p.back_z - kNothing) return wrong("it is called below its return plane");
  if (p.helix_mm > across + kNothing || (p.helix_mm > 0.0 && !(p.turn_mm > 0.0)))
    return wrong("its way in has no room, or does not go down");
  if (p.slope > 0.0 && !(along - across > kNothing))
    return wrong("its way in goes back and forth, and it is no longer than wide");
  if (p.own_rings) p.over_mm = std::max(across, p.cutter_mm);
  if (!(p.over_mm > 0.0)) return wrong("its rings have no distance");
  if (std::ceil(depth / p.level_mm) * std::ceil((across + p.over_mm) / p.over_mm) > 1.0 * kCycleBlockCap)
    return wrong("it has too many levels or rings to be followed");

  const std::size_t first = out_.blocks.size();
  const double feed = feed_, clearance = p.start_z - p.reference_z, straight = along - across;
  const Vec2 u{std::cos(p.angle_rad), std::sin(p.angle_rad)}, v{-u.y, u.x};
  const double side = p.clockwise ? -1.0 : 1.0;
  const auto at = [&](double x, double y) { return p.centre + x * u + side * y * v; };
  const auto line = [&](Vec2 q) { to({q.x, q.y, at_.z}, MoveKind::kLine); };
  const auto turn = [&](Vec2 end, double z, Vec2 centre, double total) {
    Block b = block();
    b.from_cycle = true;
    b.move = p.clockwise ? MoveKind::kArcCw : MoveKind::kArcCcw;
    b.to = {end.x, end.y, z};
    b.centre = centre;
    for (int i = 0; i < 3; ++i) b.words[i] = b.known_to[i] = true;
    half_turns(b, total);
  };
  const auto round_ring = [&](const Ring& r) {
    const double x = r.along_mm, y = r.across_mm, c = r.corner_mm;
    line(at(x, 0.0));
    const Vec2 corners[4] = {{x, y}, {-x, y}, {-x, -y}, {x, -y}};
    for (int k = 0; k < 4; ++k) {
      const Vec2 q = corners[k];
      const Vec2 in{q.x - std::copysign(c, q.x), q.y - std::copysign(c, q.y)};
      const bool up = k % 2 == 0;  // comes along y
      line(up ? at(q.x, in.y) : at(in.x, q.y));
      const Vec2 end = up ? at(in.x, q.y) : at(q.x, in.y);
      if (c > kNothing) turn(end, at_.z, at(in.x, in.y), 0.5 * kPi);
    }
    line(at(x, 0.0));
  };

  stated_ |= kStatedFeed;
  to({p.centre.x, p.centre.y, p.back_z}, MoveKind::kRapid);
  const int levels = std::max(1, static_cast<int>(std::ceil(depth / p.level_mm - 1e-6)));
  const int rings = std::max(1, static_cast<int>(std::ceil(across / p.over_mm - 1e-6)));
  double above = p.start_z;
  for (int k = 1; k <= levels && cycle_blocks_ <= kCycleBlockCap; ++k) {
    const double z = p.reference_z - depth * k / levels;
    const Vec2 in = p.slope > 0.0 ? at(-straight, 0.0) : at(p.helix_mm, 0.0);
    to({at_.x, at_.y, std::max(at_.z, p.start_z)}, MoveKind::kRapid);
    to({in.x, in.y, at_.z}, MoveKind::kRapid);
    to({in.x, in.y, std::min(p.start_z, k == 1 ? p.start_z : above + clearance)}, MoveKind::kRapid);
    feed_ = p.ramp_feed_mm_min;
    if (p.slope > 0.0) {
      const double passes = std::max(1.0, std::ceil((at_.z - z) / (2.0 * straight * p.slope) - 1e-6));
      const double from = at_.z;
      double side_of = 1.0;
      for (double n = 1.0; n <= passes && cycle_blocks_ <= kCycleBlockCap; n += 1.0) {
        const Vec2 q = at(side_of * straight, 0.0);
        to({q.x, q.y, from + (z - from) * n / passes}, MoveKind::kLine);
        side_of = -side_of;
      }
      line(at(side_of * straight, 0.0));
    } else if (p.helix_mm > 0.0) {
      const double turns = std::max(1.0, std::ceil((at_.z - z) / p.turn_mm - 1e-6));
      turn(in, z, p.centre, 2.0 * kPi * turns);
      turn(in, z, p.centre, 2.0 * kPi);
    } else {
      to({in.x, in.y, z}, MoveKind::kLine);
    }
    feed_ = p.feed_mm_min;
    if (!p.round && straight > kNothing) {
      line(at(straight, 0.0));
      line(at(-straight, 0.0));
      line(at(straight, 0.0));
    }
    for (int r = 1; r <= rings && across > kNothing; ++r) {
      const double out = across * r / rings;
      if (p.round) {
        line(at(out, 0.0));
        turn(at(out, 0.0), z, p.centre, 2.0 * kPi);
      } else {
        round_ring({straight + out, out, r == rings ? std::max(0.0, p.corner_mm - inset) : 0.0});
      }
    }
    above = z;
  }
  to({at_.x, at_.y, p.back_z}, MoveKind::kRapid);
  to({p.centre.x, p.centre.y, p.back_z}, MoveKind::kRapid);
  feed_ = feed;
  const int number = static_cast<int>(out_.pockets.size());
  for (std::size_t i = first; i < out_.blocks.size(); ++i) out_.blocks[i].pocket = number;
  out_.pockets.push_back(p);
}

}  // namespace capstan::verify

#include <cmath>

#include "planner/proof/verify/findings.h"
#include "planner/proof/verify/program/linuxcnc/interpreter.h"

// Straight moves, arcs and taps, as the words of one block give them.

namespace capstan::verify::linuxcnc {

using model::MoveKind;

void Interpreter::target(const Said& s, Block& b, bool machine_coordinates) {
  b.in_machine = machine_coordinates;
  double* to[3] = {&b.to.x, &b.to.y, &b.to.z};
  for (int i = 0; i < 3; ++i) {
    const char c = static_cast<char>('X' + i);
    b.words[i] = s.is(c);
    if (!s.is(c)) continue;
    const double v = s.of(c) * units();
    if (machine_coordinates) {
      *to[i] = v;
      b.known_to[i] = false;
    } else if (absolute_) {
      *to[i] = v;
      b.known_to[i] = true;
    } else {
      *to[i] += v;
    }
  }
}

void Interpreter::straight(const Said& s, int mode, bool machine_coordinates) {
  Block b = block();
  target(s, b, machine_coordinates);
  if (!b.words[0] && !b.words[1] && !b.words[2]) return;
  b.move = mode == 0 ? MoveKind::kRapid : MoveKind::kLine;
  if (mode != 0 && feed_mode_ == 93 && feed_ > 0.0) b.feed_mm_min = feed_ * norm(b.to - b.from);
  put(b);
  if (machine_coordinates) {
    // Where that is in the work's coordinates is not known: the height is taken as clear of everything.
    double* at[3] = {&at_.x, &at_.y, &at_.z};
    const double before[3] = {b.from.x, b.from.y, b.from.z};
    for (int i = 0; i < 3; ++i) {
      if (b.words[i]) *at[i] = before[i];
    }
  }
}

void Interpreter::arc(const Said& s, bool clockwise) {
  Block b = block();
  target(s, b, false);
  b.move = clockwise ? MoveKind::kArcCw : MoveKind::kArcCcw;
  if (!plane_xy_) return;
  if (!known_[0] || !known_[1]) {
    fault(23, "CHK-ARC", "an arc starts where the position is not known");
    return;
  }
  if (s.is('R')) {
    const double r = s.of('R') * units();
    const geometry::Vec2 chord = xy(b.to) - xy(b.from);
    const double half = 0.5 * norm(chord);
    if (half < 1e-9) {
      fault(24, "CHK-ARC-ZERO", "an arc by radius ends where it starts");
      return;
    }
    if (std::abs(r) < half - 1e-3 * units()) {
      fault(23, "CHK-ARC",
            "the radius of " + mm(std::abs(r)) + " does not span its chord of " + mm(2.0 * half));
      return;
    }
    const double height = std::sqrt(std::max(0.0, r * r - half * half));
    const double side = (r > 0.0) == clockwise ? -1.0 : 1.0;
    const geometry::Vec2 left = (0.5 / half) * geometry::Vec2{-chord.y, chord.x};
    b.centre = xy(b.from) + 0.5 * chord + (side * height) * left;
  } else {
    if (!s.is('I') && !s.is('J'))
      return fault(23, "CHK-ARC", "the arc has neither a centre (I, J) nor a radius (R)");
    const double i = s.of('I') * units();
    const double j = s.of('J') * units();
    b.centre = absolute_arcs_ ? geometry::Vec2{i, j} : xy(b.from) + geometry::Vec2{i, j};
  }
  b.radius_start = norm(xy(b.from) - b.centre);
  b.radius_end = norm(xy(b.to) - b.centre);
  put(b);
}

void Interpreter::tap(const Said& s) {
  Block b = block();
  target(s, b, false);
  b.move = MoveKind::kLine;
  b.synchronised = true;
  b.pitch_mm = s.of('K') * units();
  b.feed_mm_min = b.pitch_mm * std::abs(speed());
  if (!(b.pitch_mm > 0.0)) fault(26, "CHK-CYCLE", "G33.1 without a pitch above zero");
  const Block down = b;
  put(b);
  std::swap(b.from, b.to);
  b.spindle_rpm = -b.spindle_rpm;
  b.words[2] = true;
  for (int i = 0; i < 3; ++i) {
    b.known_from[i] = down.known_to[i];
    b.known_to[i] = down.known_from[i];
  }
  put(b);
}

}  // namespace capstan::verify::linuxcnc

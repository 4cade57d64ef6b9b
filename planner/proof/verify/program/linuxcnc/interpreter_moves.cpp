#include <cmath>

#include "planner/proof/verify/findings.h"
#include "planner/proof/verify/program/linuxcnc/interpreter.h"

// Straight moves, arcs and taps, as the words of one block give them.

namespace capstan::verify::linuxcnc {

using model::MoveKind;

void Interpreter::tap(const BlockSaid& s) {
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

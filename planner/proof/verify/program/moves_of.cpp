#include <cmath>

#include "planner/proof/verify/program/program_checks.h"

namespace capstan::verify {

std::vector<StepMoves> moves_of(const ProgramCase& c) {
  std::vector<StepMoves> out;
  const auto half_unit_of = [](int decimals) { return 0.5 * std::pow(10.0, -decimals); };
  const double half_unit = half_unit_of(c.machine.control.decimals);
  for (const Block& b : c.program.blocks) {
    if ((b.kind != Block::Kind::kMove && b.kind != Block::Kind::kDwell) || b.in_machine) continue;
    const model::Cutter* cutter = c.cutter(b.tool);
    const long marker_step = b.marker >= 0 ? c.step_of_marker[static_cast<std::size_t>(b.marker)] : -1;
    const Findings::Where at = c.where(b);
    if (out.empty() || out.back().order + 1 != at.order || out.back().cutter != cutter) {
      StepMoves s;
      s.order = at.order - 1;
      s.id = at.step;
      s.cutter = cutter;
      s.feed_rounding_mm_min = half_unit_of(c.machine.control.feed_decimals);
      s.speed_rounding_rpm = half_unit_of(c.reader.speed_decimals);
      if (c.plan != nullptr && marker_step >= 0) {
        s.planned = &c.plan->steps[static_cast<std::size_t>(marker_step)];
        s.setup = s.planned->setup;
      }
      out.push_back(std::move(s));
    }
    Move m;
    m.kind = b.move;
    m.synchronised = b.synchronised;
    m.from = b.from;
    m.to = b.to;
    if (!b.known_from[2]) m.from.z = kUnknownHeightMm;
    if (!b.known_to[2]) m.to.z = kUnknownHeightMm;
    // From an unknown place nothing is swept but the height itself.
    if (!b.known_from[0]) m.from.x = m.to.x;
    if (!b.known_from[1]) m.from.y = m.to.y;
    m.centre = b.centre;
    m.feed_mm_min = b.feed_mm_min;
    m.spindle_rpm = b.spindle_rpm;
    m.dwell_s = b.dwell_s;
    m.rounding_mm = half_unit;
    m.where = b.line;
    out.back().moves.push_back(m);
  }
  return out;
}

}  // namespace capstan::verify

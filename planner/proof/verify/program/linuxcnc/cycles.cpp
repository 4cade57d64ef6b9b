#include <algorithm>
#include <cmath>

#include "planner/proof/verify/findings.h"
#include "planner/proof/verify/program/linuxcnc/interpreter.h"
#include "planner/proof/verify/program/peck.h"

// Canned cycles, made into moves.

namespace capstan::verify::linuxcnc {

using model::MoveKind;

namespace {
/// G73 backs off and G83 stops short by this much.
/// Source: LinuxCNC 2.9 manual, G83: ".010 of an inch"; converted.
constexpr double kPeckClearanceMm = 0.254;
constexpr int kMostPecks = 100000;
}  // namespace

void Interpreter::one_hole(int mode, double x, double y, double z, double r, double q, double p,
                           double clear) {
  const double back = return_to_r_ ? r : std::max(clear, r);
  if (at_.z < r) to({at_.x, at_.y, r}, MoveKind::kRapid);
  to({x, y, at_.z}, MoveKind::kRapid);
  to({x, y, r}, MoveKind::kRapid);
  if (mode == 830 || mode == 730) {
    double bottom = r;
    for (int n = 0; bottom > z && n < kMostPecks && cycle_blocks_ <= kCycleBlockCap; ++n) {
      bottom = peck_bottom(bottom, q, z);
      to({x, y, bottom}, MoveKind::kLine);
      if (bottom <= z) break;
      if (mode == 730) {
        to({x, y, bottom + kPeckClearanceMm}, MoveKind::kRapid);
      } else {
        to({x, y, r}, MoveKind::kRapid);
        to({x, y, std::min(r, bottom + kPeckClearanceMm)}, MoveKind::kRapid);
      }
    }
  } else {
    to({x, y, z}, MoveKind::kLine, mode == 840);
  }
  if ((mode == 820 || mode == 840 || mode == 860 || mode == 890) && p > 0.0) dwell(p);
  const int turning = spindle_;
  if (mode == 860) spindle_ = 0;
  if (mode == 840) spindle_ = -spindle_;
  const bool feeds_out = mode == 840 || mode == 850 || mode == 890;
  // NIST's interpreter, of which Mach3's is made, comes out at feed all the way.
  to({x, y, feeds_out && !ways_.mach3 ? r : back}, feeds_out ? MoveKind::kLine : MoveKind::kRapid,
     mode == 840);
  spindle_ = turning;
  to({x, y, back}, MoveKind::kRapid);
}

void Interpreter::cycle(const BlockSaid& s) {
  const int mode = motion_;
  if (mode == 870 || mode == 880) {
    fault(26, "CHK-CYCLE", "G87 and G88 are not followed", true);
    return;
  }
  if (!absolute_) {
    fault(26, "CHK-CYCLE", "cycles in G91 are not followed", true);
    return;
  }
  if (s.is('Z')) cycle_z_ = s.of('Z') * units();
  if (s.is('R')) cycle_r_ = s.of('R') * units();
  if (s.is('Q')) cycle_q_ = s.of('Q') * units();
  has_q_ = has_q_ || s.is('Q');
  if (s.is('P')) cycle_p_ = s.of('P') * ways_.unit_of_p_s;
  if (!cycle_known_ && (!s.is('Z') || !s.is('R'))) {
    fault(26, "CHK-CYCLE", "a cycle begins without Z and R");
    return;
  }
  cycle_known_ = true;
  if (!(cycle_r_ > cycle_z_)) {
    fault(26, "CHK-CYCLE", "R " + mm(cycle_r_) + " is not above the bottom, Z " + mm(cycle_z_));
    return;
  }
  if ((mode == 830 || mode == 730) && !(cycle_q_ > 0.0)) {
    fault(26, "CHK-CYCLE", "the peck Q is " + mm(cycle_q_) + "; it must be above zero");
    return;
  }
  const double x = s.is('X') ? s.of('X') * units() : at_.x;
  const double y = s.is('Y') ? s.of('Y') * units() : at_.y;
  if (!known_[2]) {
    fault(26, "CHK-CYCLE", "a cycle begins where the height is not known");
    return;
  }
  const double repeats = s.is('L') ? std::clamp(s.of('L'), 0.0, 1000.0) : 1.0;
  for (int i = 0; i < static_cast<int>(repeats) && cycle_blocks_ <= kCycleBlockCap; ++i)
    one_hole(mode, x, y, cycle_z_, cycle_r_, cycle_q_, cycle_p_, cycle_clear_);
}

}  // namespace capstan::verify::linuxcnc

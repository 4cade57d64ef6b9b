#include <algorithm>
#include <cmath>

#include "planner/proof/verify/findings.h"
#include "planner/proof/verify/program/fanuc/interpreter.h"
#include "planner/proof/verify/program/peck.h"

// Canned cycles made into moves, as FANUC B-63944EN-2/02, 5.1, describes them: 1 to the place of the hole,
// 2 by rapid to R, 3 feed to Z, 4 what is done at the bottom, 5 back to R, 6 by rapid to the initial level
// (G98) or not (G99). 5.2: rigid tapping, called by M29; Haas's is always rigid, and its J brings the tap out
// faster.

namespace capstan::verify::fanuc {

using model::MoveKind;

namespace {
constexpr int kMostPecks = 100000;
}

/// Feeds of Q, each followed by a rapid to R (G83) and back to d above the last bottom, or by a short way up
/// (G73). Haas's I, J and K: the first feed is I, each further one less by J, none less than K (96-8000, G73
/// and G83); setting 52, which adds a way above R, is taken as 0.
void Interpreter::pecks(double x, double y) {
  const double d = motion_ == 830 ? ways_.peck_clearance_mm : ways_.chip_break_mm;
  double bottom = r_, one = shrinks_ ? i_ : q_;
  for (int n = 0; bottom > z_ && n < kMostPecks && cycle_blocks_ <= kCycleBlockCap; ++n) {
    bottom = peck_bottom(bottom, one, z_);
    if (shrinks_) one = std::max(one - j_, k_);
    to({x, y, bottom}, MoveKind::kLine);
    if (bottom <= z_) break;
    to({x, y, motion_ == 830 ? r_ : std::min(r_, bottom + d)}, MoveKind::kRapid);
    if (motion_ == 830) to({x, y, std::min(r_, bottom + d)}, MoveKind::kRapid);
  }
}

void Interpreter::tap(double x, double y, double faster_back) {
  const bool rigid = ways_.m29 ? rigid_ : true;
  if (!rigid)
    fault(22, "CHK-TAP-FEED",
          "a tapping cycle without M29 S before it: the control does not hold spindle and feed in step");
  if (!(speed_ > 0.0)) fault(15, "CHK-SPINDLE", "a tapping cycle without a speed (S)");
  if (!(feed_ > 0.0)) fault(18, "CHK-FEED", "a tapping cycle without a feed (F)");
  const double pitch = feed_mode_ == 95 ? feed_ : feed_ / std::max(speed_, 1e-9);
  Block b = block();
  b.synchronised = rigid;
  b.move = MoveKind::kLine;
  b.pitch_mm = pitch;
  b.feed_mm_min = pitch * speed_;
  b.spindle_rpm = motion_ == 740 ? -speed_ : speed_;
  b.to = {x, y, z_};
  for (int i = 0; i < 3; ++i) b.words[i] = b.known_to[i] = true;
  put(b);
  if (p_s_ > 0.0) dwell(p_s_);
  std::swap(b.from, b.to);
  b.spindle_rpm = -b.spindle_rpm;
  b.feed_mm_min *= faster_back;
  b.spindle_rpm *= faster_back;
  for (int i = 0; i < 3; ++i) b.known_from[i] = true;
  put(b);
  spindle_ = 0;
}

void Interpreter::one_hole(double x, double y, double faster_back) {
  const double back = to_r_ ? r_ : std::max(initial_, r_);
  to({x, y, at_.z}, MoveKind::kRapid);
  to({x, y, r_}, MoveKind::kRapid);
  if (motion_ == 840 || motion_ == 740) {
    tap(x, y, faster_back);
    to({x, y, back}, MoveKind::kRapid);
    return;
  }
  if (motion_ == 830 || motion_ == 730) {
    pecks(x, y);
  } else {
    to({x, y, z_}, MoveKind::kLine);
  }
  // Haas also waits behind the last peck (96-8000, G73 and G83).
  const bool pecked = ways_.haas && (motion_ == 830 || motion_ == 730);
  if ((motion_ == 820 || motion_ == 890 || pecked) && p_s_ > 0.0) dwell(p_s_);
  const int turning = spindle_;
  if (motion_ == 860) spindle_ = 0;
  if (motion_ == 850 || motion_ == 890) to({x, y, r_}, MoveKind::kLine);
  to({x, y, back}, MoveKind::kRapid);
  spindle_ = turning;
}

/// Haas's I, J and K hold as Q does, and one of the two ways is stated. False where pecks are not followed.
bool Interpreter::peck_words(const BlockWords& s) {
  if (!ways_.haas || (motion_ != 830 && motion_ != 730)) return true;
  const bool any = s.is('I') || s.is('J') || s.is('K');
  if (any && s.is('Q')) {
    fault(26, "CHK-UNVERIFIABLE", "pecks with both Q and one of I, J and K are not followed", true);
    return false;
  }
  if (s.is('Q')) shrinks_ = false;
  if (!any) return true;
  if (!s.is('I') || !s.is('J') || !s.is('K')) {
    fault(26, "CHK-CYCLE", "pecks with one of I, J and K and not all three: state them, or Q");
    return false;
  }
  i_ = s.of('I') * units();
  j_ = s.of('J') * units();
  k_ = s.of('K') * units();
  shrinks_ = true;
  if (i_ > 0.0 && j_ >= 0.0 && k_ > 0.0) return true;
  fault(26, "CHK-CYCLE",
        "the pecks I " + mm(i_) + ", J " + mm(j_) + ", K " + mm(k_) +
            ": I and K must be above zero, and J not below it");
  return false;
}

void Interpreter::cycle(const BlockWords& s) {
  const auto wrong = [&](const std::string& why) { fault(26, "CHK-CYCLE", why); };
  if (motion_ == 760 || motion_ == 870 || motion_ == 880)
    return fault(26, "CHK-CYCLE", "G" + std::to_string(motion_ / 10) + " is not followed", true);
  if (!absolute_) return fault(26, "CHK-CYCLE", "cycles in G91 are not followed", true);
  if (smooth_) wrong("a canned cycle while G5.1 Q1 is on; state G5.1 Q0 before");
  if (s.is('Z')) z_ = s.of('Z') * units();
  if (s.is('R')) r_ = s.of('R') * units();
  if (s.is('Q')) q_ = s.of('Q') * units();
  if (!peck_words(s)) return;
  if (s.is('P')) p_s_ = seconds_of_p(s);
  has_z_ = has_z_ || s.is('Z');
  has_r_ = has_r_ || s.is('R');
  if (!has_z_ || !has_r_) return wrong("a cycle begins without Z and R");
  if (!(r_ > z_)) return wrong("R " + mm(r_) + " is not above the bottom, Z " + mm(z_));
  if ((motion_ == 830 || motion_ == 730) && !shrinks_ && !(q_ > 0.0))
    return wrong("the peck Q is " + mm(q_) + "; it must be above zero");
  if (!known_[2]) return wrong("a cycle begins where the height is not known");
  if (at_.z < r_ - 1e-9)
    wrong("R " + mm(r_) + " is above the level from which the cycle is called, " + mm(at_.z));
  const double x = s.is('X') ? s.of('X') * units() : at_.x;
  const double y = s.is('Y') ? s.of('Y') * units() : at_.y;
  const char repeats = ways_.haas ? 'L' : 'K';
  const double times = s.is(repeats) ? std::clamp(s.of(repeats), 0.0, 1000.0) : 1.0;
  const double faster = ways_.haas && s.is('J') ? std::max(1.0, s.of('J')) : 1.0;
  for (int i = 0; i < static_cast<int>(times) && cycle_blocks_ <= kCycleBlockCap; ++i) one_hole(x, y, faster);
}

}  // namespace capstan::verify::fanuc

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string_view>
#include <utility>
#include <vector>

#include "planner/ground/base/number.h"
#include "planner/proof/verify/findings.h"
#include "planner/proof/verify/program/peck.h"
#include "planner/proof/verify/program/siemens/interpreter.h"

// Cycles made into moves, as the manuals of the cycles describe them. All begin alike, above the hole: by
// rapid to the reference plane brought forward by the safety clearance (RFP + SDIS), and all end by rapid at
// the return plane (RTP). DPR, where it is given, counts from RFP and holds in place of DP.

namespace capstan::verify::siemens {

using model::MoveKind;

namespace {

constexpr int kMostPecks = 100000;
constexpr double kChipBreakMm = 1.0;  ///< _VRT 0

enum Parameter : std::size_t { kRtp, kRfp, kSdis, kDp, kDpr, kDtb };
// CYCLE83
enum Peck : std::size_t {
  kFdep = 5,
  kFdpr,
  kDam,
  kPeckDtb,
  kDts,
  kFrf,
  kVari,
  kAxn,
  kMdep,
  kVrt,
  kDtd,
  kDis1
};
// CYCLE84
enum Tap : std::size_t { kSdac = 6, kMpit, kPit, kPoss, kSst, kSst1 };
// CYCLE840
enum ChuckTap : std::size_t { kSdr = 6, kChuckSdac, kEnc, kChuckMpit, kChuckPit };
// CYCLE85, CYCLE86
enum Bore : std::size_t { kFfr = 6, kRff = 7, kSdir = 6, kRpa, kRpo, kRpap };

/// How many parameters have a meaning that is followed; further ones are modes, 0 where left out.
std::size_t known_parameters(int cycle) {
  switch (cycle) {
    case 81:
      return 5;
    case 83:
      return 17;
    case 84:
      return 12;
    case 85:
      return 8;
    case 86:
    case 840:
      return 11;
    case 832:
      return 3;
    default:
      return 6;  // 82, 89
  }
}

/// Pitches of metric coarse threads, ISO 261.
constexpr std::array<std::pair<double, double>, 18> kCoarse = {{{3, 0.5},
                                                                {4, 0.7},
                                                                {5, 0.8},
                                                                {6, 1.0},
                                                                {8, 1.25},
                                                                {10, 1.5},
                                                                {12, 1.75},
                                                                {14, 2.0},
                                                                {16, 2.0},
                                                                {18, 2.5},
                                                                {20, 2.5},
                                                                {22, 2.5},
                                                                {24, 3.0},
                                                                {27, 3.0},
                                                                {30, 3.5},
                                                                {36, 4.0},
                                                                {42, 4.5},
                                                                {48, 5.0}}};

double coarse_pitch(double size) {
  const auto* at =
      std::find_if(kCoarse.begin(), kCoarse.end(), [&](const auto& row) { return row.first == size; });
  return at == kCoarse.end() ? 0.0 : at->second;
}

}  // namespace

/// Numbers; of CYCLE832 also the words _OFF, _FINISH, _SEMIFIN and _ROUGH.
std::optional<CycleCall> Interpreter::parameters(const Item& call) {
  static constexpr std::array<std::pair<std::string_view, double>, 4> kTypes = {
      {{"_OFF", 0.0}, {"_FINISH", 1.0}, {"_SEMIFIN", 2.0}, {"_ROUGH", 3.0}}};
  constexpr std::string_view kCycle = "CYCLE";
  CycleCall out;
  for (const int known : {81, 82, 83, 84, 85, 86, 89, 832, 840}) {  // by name: CYCLE081 is another subprogram
    if (call.name == std::string(kCycle) + std::to_string(known)) out.number = known;
  }
  if (out.number == 0) {
    fault(33, "CHK-UNVERIFIABLE", call.name + "() is not followed", true);
    return std::nullopt;
  }
  const std::size_t known = known_parameters(out.number);
  for (std::size_t i = 0; i < call.params.size(); ++i) {
    const std::string& p = call.params[i];
    std::optional<double> value;
    if (!p.empty()) value = parse_double(p.front() == '+' ? p.substr(1) : p);
    for (const auto& [word, means] : kTypes) {
      if (out.number == 832 && i == 1 && p == word) value = means;
    }
    if (!p.empty() && (!value || !std::isfinite(*value))) {
      fault(33, "CHK-UNVERIFIABLE",
            "parameter " + std::to_string(i + 1) + " of " + call.name + ", " + p.substr(0, 20) +
                ", is no number and not followed",
            true);
      return std::nullopt;
    }
    if (i >= known && value.value_or(0.0) != 0.0) {
      fault(33, "CHK-UNVERIFIABLE",
            "parameter " + std::to_string(i + 1) + " of " + call.name + ", " + plain(*value) +
                ", is a mode that is not followed; leave it out or 0",
            true);
      return std::nullopt;
    }
    out.params.push_back(value);
  }
  return out;
}

/// HOLES1, a row: reference point SPCA, SPCO, its angle STA1, FDIS to the first hole, DBH between holes, NUM;
/// it is begun at the end that is nearer to the tool. HOLES2, a circle: centre CPA, CPO, radius RAD, angle
/// STA1 of the first hole, INDA from each to the next (0: NUM holes divide the circle). Each place is reached
/// by rapid, and the modal call runs there. Sources: 840D sl operating manual, position patterns; the order
/// of the parameters by what others wrote (tests/controls/siemens/golden/README.md).
void Interpreter::pattern(const Item& call, bool modal) {
  constexpr std::size_t kParameters = 6;
  constexpr double kMostHoles = 10000.0, kDegrees = 180.0 / std::numbers::pi;
  const auto wrong = [&](const std::string& why) { fault(26, "CHK-CYCLE", call.name + ": " + why); };
  if (modal) return wrong("a pattern is no cycle to call modally; it runs the one that is");
  if (!modal_) return wrong("no cycle is called modally (MCALL): nothing would be made at its places");
  if (!absolute_) return fault(26, "CHK-CYCLE", "cycles in G91 are not followed", true);
  std::array<double, kParameters> v{};
  for (std::size_t i = 0; i < call.params.size(); ++i) {
    const std::string& p = call.params[i];
    const auto value = p.empty() ? 0.0 : parse_double(p.front() == '+' ? p.substr(1) : p);
    if (!value || !std::isfinite(*value) || (i >= kParameters && *value != 0.0))
      return fault(33, "CHK-UNVERIFIABLE",
                   "parameter " + std::to_string(i + 1) + " of " + call.name + ", " + p.substr(0, 20) +
                       ", is no number or a mode that is not followed",
                   true);
    if (i < kParameters) v[i] = *value;
  }
  const double u = units(), number = v[5];
  if (call.params.size() < kParameters) return wrong("NUM, the sixth parameter, is missing");
  if (!(number >= 1.0) || number > kMostHoles || number != std::floor(number))
    return wrong("NUM " + plain(number) + " is no number of holes from 1 to " + plain(kMostHoles));
  const auto n = static_cast<std::size_t>(number);
  std::vector<geometry::Vec2> places;
  const bool row = call.name == "HOLES1";
  if (row ? v[3] < 0.0 || v[4] < 0.0 : !(v[2] > 0.0))
    return wrong(row ? "FDIS and DBH are distances; one of them is below zero"
                     : "RAD is " + mm(v[2] * u) + "; it must be above zero");
  const double first = (row ? v[2] : v[3]) / kDegrees;
  if (!(first > -std::numbers::pi) || first > std::numbers::pi + kClose)
    return wrong("STA1 is an angle above -180 and to 180 degrees");
  for (std::size_t i = 0; i < n; ++i) {
    const double k = static_cast<double>(i);
    if (row) {
      const double along = (v[3] + k * v[4]) * u;
      places.push_back({v[0] * u + along * std::cos(first), v[1] * u + along * std::sin(first)});
    } else {
      const double angle = first + k * (v[4] != 0.0 ? v[4] / kDegrees : 2.0 * std::numbers::pi / number);
      places.push_back({v[0] * u + v[2] * u * std::cos(angle), v[1] * u + v[2] * u * std::sin(angle)});
    }
  }
  if (!known_[0] || !known_[1] || !known_[2]) return wrong("it begins where the position is not known");
  if (row && n > 1) {
    const double to_first = norm(places.front() - xy(at_)), to_last = norm(places.back() - xy(at_));
    if (std::abs(to_first - to_last) <= kClose)
      return fault(26, "CHK-UNVERIFIABLE",
                   "HOLES1 begins at the end that is nearer to the tool, and both are equally far", true);
    if (to_last < to_first) std::reverse(places.begin(), places.end());
  }
  const CycleCall cycle = *modal_;
  for (const geometry::Vec2 p : places) {
    if (cycle_blocks_ > kCycleBlockCap) return;
    to({p.x, p.y, at_.z}, MoveKind::kRapid);
    run_cycle(cycle);
  }
}

void Interpreter::call_block(const Item& call, bool modal) {
  constexpr std::size_t kLongestMessage = 124;
  if (call.name == "MSG") {
    const std::string& text = call.params.front();
    const bool quoted = text.empty() || (text.size() > 1 && text.front() == '"' && text.back() == '"');
    if (modal || call.params.size() > 1 || !quoted || text.size() > kLongestMessage + 2)
      fault(
          33, "CHK-SYNTAX",
          "MSG takes one text between quotes, of " + std::to_string(kLongestMessage) + " characters at most");
    if (quoted && text.size() > 2) keep_told(text.substr(1, text.size() - 2), line_, true, out_);
    return;
  }
  if (call.name == "HOLES1" || call.name == "HOLES2") return pattern(call, modal);
  if (call.name == "POCKET3" || call.name == "POCKET4") return pocket(call, modal);
  if (call.name == "CYCLE71") return face(call, modal);
  const auto c = parameters(call);
  if (!c) return;
  if (c->number == 832) {
    if (modal) fault(26, "CHK-CYCLE", "CYCLE832 is no cycle to call modally");
    return tolerance_cycle(*c);
  }
  if (!modal) return run_cycle(*c);
  if (modal_) fault(26, "CHK-CYCLE", "a modal call while another is on; end that by MCALL alone");
  modal_ = c;
  cycle_active_ = true;
}

/// 1 finishing, 2 semi-finishing, 3 roughing, within the tolerance; 0 takes it off, and then machine data
/// round.
void Interpreter::tolerance_cycle(const CycleCall& c) {
  const double type = c.of(1), tolerance = c.of(0) * units();
  if (type != 0.0 && type != 1.0 && type != 2.0 && type != 3.0)
    return fault(33, "CHK-UNVERIFIABLE",
                 "the type of machining " + plain(type) + " of CYCLE832 is not followed; state 0 to 3", true);
  if (type != 0.0 && !(tolerance > 0.0))
    fault(33, "CHK-CYCLE", "CYCLE832 has the tolerance " + mm(tolerance) + "; it must be above zero");
  // The cycle states CTOL itself, or takes it off: what stood before it is gone, and G642 behind it rounds by
  // it.
  contour_tolerance_ = type == 0.0 ? kNoTolerance : tolerance;
  by_contour_tolerance_ = type != 0.0;
  tolerance_ = naive_ = contour_tolerance_;
}

std::optional<Interpreter::Planes> Interpreter::planes(const CycleCall& c) {
  const auto wrong = [&](const std::string& why) {
    fault(26, "CHK-CYCLE", "CYCLE" + std::to_string(c.number) + ": " + why);
    return std::nullopt;
  };
  if (!c.at(kRtp) || !c.at(kRfp) || (!c.at(kDp) && !c.at(kDpr)))
    return wrong("RTP, RFP or the depth is missing");
  if (!c.at(kDp) && c.of(kDpr) == 0.0) return wrong("DPR is 0 and DP is missing: there is no depth");
  if (c.of(kSdis) < 0.0) return wrong("SDIS is " + mm(c.of(kSdis) * units()) + "; it has no sign");
  Planes p;
  p.back = c.of(kRtp) * units();
  p.reference = c.of(kRfp) * units();
  p.start = (c.of(kRfp) + c.of(kSdis)) * units();
  p.bottom = c.of(kDp) * units();
  if (c.of(kDpr) != 0.0) {
    p.bottom = p.reference - std::abs(c.of(kDpr)) * units();
    if (c.at(kDp) && std::abs(p.bottom - c.of(kDp) * units()) > kClose)
      return wrong("DP and DPR say different depths");
  }
  if (!(p.bottom < p.reference))
    return wrong("the depth " + mm(p.bottom) + " is not below RFP " + mm(p.reference));
  if (p.back < p.start - kClose)
    return wrong("RTP " + mm(p.back) + " is below RFP + SDIS, " + mm(p.start) +
                 ": the tool would go down by rapid at its end");
  return p;
}

/// Above 0 seconds, below 0 turns of the spindle.
void Interpreter::pause(double dtb) {
  if (dtb > 0.0) dwell(dtb);
  if (dtb < 0.0 && speed() != 0.0) dwell(-60.0 * dtb / std::abs(speed()));
}

void Interpreter::run_cycle(const CycleCall& c) {
  if (!absolute_) return fault(26, "CHK-CYCLE", "cycles in G91 are not followed", true);
  const auto p = planes(c);
  if (!p) return;
  if (!known_[0] || !known_[1] || !known_[2])
    return fault(26, "CHK-CYCLE", "a cycle begins where the position is not known");
  if (at_.z < p->start - kClose)
    fault(26, "CHK-CYCLE",
          "RFP + SDIS " + mm(p->start) + " is above the height from which the cycle is called, " + mm(at_.z));
  to_height(p->start, MoveKind::kRapid);
  switch (c.number) {
    case 83:
      peck(c, *p);
      break;
    case 84:
      tap(c, *p);
      break;
    case 85:
      ream(c, *p);
      break;
    case 86:
      bore(c, *p);
      break;
    case 840:
      tap_in_chuck(c, *p);
      break;
    default:
      to_height(p->bottom, MoveKind::kLine);
      if (c.number != 81) pause(c.of(kDtb));
      if (c.number == 89) to_height(p->start, MoveKind::kLine);
  }
  to_height(p->back, MoveKind::kRapid);
}

/// Pecks down to FDEP and on, each shorter by DAM (or by the factor -DAM), none shorter than _MDEP; VARI 1
/// comes up to RFP + SDIS after each and goes back by rapid to _DIS1 above where the last ended, VARI 0 goes
/// up by _VRT at feed.
void Interpreter::peck(const CycleCall& c, const Planes& p) {
  const double u = units();
  if (c.of(kAxn) == 1.0 || c.of(kAxn) == 2.0)
    return fault(33, "CHK-UNVERIFIABLE", "CYCLE83 along another axis than Z is not followed", true);
  double bottom = c.of(kFdpr) != 0.0 ? p.reference - std::abs(c.of(kFdpr)) * u : c.of(kFdep) * u;
  if (!(bottom < p.reference)) return fault(26, "CHK-CYCLE", "CYCLE83: the first depth is not below RFP");
  const double frf = c.at(kFrf) && c.of(kFrf) > 0.0 ? c.of(kFrf) : 1.0, feed = feed_;
  const double dam = c.of(kDam), least = std::max(c.of(kMdep) * u, dam > 0.0 ? dam * u : 0.0);
  double one = p.reference - bottom;
  feed_ = feed * frf;
  for (int n = 0; n < kMostPecks && cycle_blocks_ <= kCycleBlockCap; ++n) {
    bottom = std::max(bottom, p.bottom);
    to_height(bottom, MoveKind::kLine);
    feed_ = feed;
    const bool last = bottom <= p.bottom + kClose;
    pause(last && c.of(kDtd) != 0.0 ? c.of(kDtd) : c.of(kPeckDtb));
    if (last) return;
    if (c.of(kVari) == 1.0) {
      // Left out, the control computes the distance: 0.6 mm, or a fiftieth of a depth of more than 30 mm.
      const double depth = p.reference - p.bottom;
      const double limit = c.of(kDis1) > 0.0 ? c.of(kDis1) * u : std::clamp(depth / 50.0, 0.6, 7.0);
      to_height(p.start, MoveKind::kRapid);
      pause(c.of(kDts));
      to_height(std::min(p.start, bottom + limit), MoveKind::kRapid);
    } else {
      to_height(bottom + (c.of(kVrt) > 0.0 ? c.of(kVrt) * u : kChipBreakMm), MoveKind::kLine);
    }
    one = std::max(dam < 0.0 ? -dam * one : one - dam * u, least);
    if (!(one > 0.0)) return fault(26, "CHK-CYCLE", "CYCLE83: its pecks become nothing before the bottom");
    bottom -= one;
  }
}

/// Spindle and feed in step, down with SST and up with SST1; SDAC is how the spindle turns behind it.
void Interpreter::tap(const CycleCall& c, const Planes& p) {
  double pitch = c.of(kPit) * units();
  if (c.of(kMpit) != 0.0) {
    const double coarse = std::copysign(coarse_pitch(std::abs(c.of(kMpit))), c.of(kMpit));
    if (coarse == 0.0 || (pitch != 0.0 && std::abs(pitch - coarse) > kClose))
      fault(22, "CHK-TAP-FEED",
            "CYCLE84: MPIT " + plain(c.of(kMpit)) + " is no thread's size, or PIT says another");
    pitch = coarse;
  }
  const double down = c.of(kSst) > 0.0 ? c.of(kSst) : speed_;
  const double up = c.of(kSst1) > 0.0 ? c.of(kSst1) : down;
  if (pitch == 0.0) fault(22, "CHK-TAP-FEED", "CYCLE84 has neither PIT nor MPIT, the thread's pitch");
  if (!(down > 0.0)) fault(15, "CHK-SPINDLE", "CYCLE84 has no speed (SST)");
  const double sdac = c.of(kSdac), way = pitch < 0.0 ? -1.0 : 1.0;
  if (sdac != 3.0 && sdac != 4.0 && sdac != 5.0)
    fault(26, "CHK-CYCLE", "CYCLE84: SDAC is " + plain(sdac) + "; it says 3, 4 or 5, as M3, M4 and M5");
  Block b = block();
  b.from_cycle = b.synchronised = true;
  b.move = MoveKind::kLine;
  b.pitch_mm = std::abs(pitch);
  b.feed_mm_min = b.pitch_mm * down;
  b.spindle_rpm = way * down;
  b.to.z = p.bottom;
  for (int i = 0; i < 3; ++i) b.words[i] = b.known_to[i] = true;
  put(b);
  pause(c.of(kDtb));
  std::swap(b.from, b.to);
  b.feed_mm_min = b.pitch_mm * up;
  b.spindle_rpm = -way * up;
  put(b);
  spindle_ = 0;
  if (sdac == 3.0 || sdac == 4.0) start(sdac == 3.0 ? 1 : -1);
}

/// With a compensating chuck and the spindle's encoder (ENC 0): the axis follows the turns of the spindle by
/// the lead, down as the spindle turns, back with SDR; SDAC is how it turns behind the cycle. SDR 0 reverses
/// by itself. Source: Cycles 11.02, 2.1.7.
void Interpreter::tap_in_chuck(const CycleCall& c, const Planes& p) {
  const auto wrong = [&](const std::string& why) { fault(26, "CHK-CYCLE", "CYCLE840: " + why); };
  if (c.of(kEnc) != 0.0)
    return fault(33, "CHK-UNVERIFIABLE",
                 "CYCLE840 without the encoder (ENC " + plain(c.of(kEnc)) + ") is not followed; state 0",
                 true);
  double pitch = c.of(kChuckPit) * units();
  if (c.of(kChuckMpit) != 0.0) {
    const double coarse = coarse_pitch(std::abs(c.of(kChuckMpit)));
    if (coarse == 0.0 || (pitch != 0.0 && std::abs(pitch - coarse) > kClose))
      fault(22, "CHK-TAP-FEED",
            "CYCLE840: MPIT " + plain(c.of(kChuckMpit)) + " is no thread's size, or PIT says another");
    pitch = coarse;
  }
  if (!(pitch > 0.0))
    fault(22, "CHK-TAP-FEED", "CYCLE840 has neither PIT nor MPIT above 0, the thread's pitch");
  if (speed() == 0.0) fault(15, "CHK-SPINDLE", "CYCLE840 begins with the spindle standing");
  const int way = spindle_;
  const double back = c.of(kSdr), behind = c.of(kChuckSdac);
  if (back != 0.0 && back != (way < 0 ? 3.0 : 4.0))
    wrong("SDR is " + plain(back) +
          ": the tap would not turn back as it came (3 as M3, 4 as M4, 0 by itself)");
  if (back != 0.0 && behind != 3.0 && behind != 4.0 && behind != 5.0)
    wrong("SDAC is " + plain(behind) + "; it says 3, 4 or 5, as M3, M4 and M5");
  Block b = block();
  b.from_cycle = b.synchronised = b.in_chuck = true;
  b.move = MoveKind::kLine;
  b.pitch_mm = pitch;
  b.feed_mm_min = pitch * speed_;
  b.to.z = p.bottom;
  for (int i = 0; i < 3; ++i) b.words[i] = b.known_to[i] = true;
  put(b);
  pause(c.of(kDtb));
  std::swap(b.from, b.to);
  b.spindle_rpm = -b.spindle_rpm;
  put(b);
  spindle_ = 0;
  if (back == 0.0 || behind != 5.0) start(back == 0.0 ? way : behind == 4.0 ? -1 : 1);
}

/// Down at FFR, up at RFF.
void Interpreter::ream(const CycleCall& c, const Planes& p) {
  const double feed = feed_;
  if (!(c.of(kFfr) > 0.0) || !(c.of(kRff) > 0.0)) fault(18, "CHK-FEED", "CYCLE85 has no feed (FFR, RFF)");
  feed_ = c.of(kFfr) * units();
  stated_ |= kStatedFeed;
  to_height(p.bottom, MoveKind::kLine);
  pause(c.of(kDtb));
  feed_ = c.of(kRff) * units();
  to_height(p.start, MoveKind::kLine);
  feed_ = feed;
}

/// Down, stop turned to POSS, off the wall by RPA, RPO and RPAP, up, and back over the hole.
void Interpreter::bore(const CycleCall& c, const Planes& p) {
  if (c.of(kSdir) != 3.0 && c.of(kSdir) != 4.0)
    fault(26, "CHK-CYCLE", "CYCLE86: SDIR is " + plain(c.of(kSdir)) + "; it says 3 or 4, as M3 and M4");
  const int way = c.of(kSdir) == 4.0 ? -1 : 1;
  if (spindle_ != way)
    fault(15, "CHK-SPINDLE",
          "CYCLE86 would start or reverse the spindle itself (SDIR), and feeds at once; start it before");
  start(way);
  const geometry::Vec3 hole = at_;
  const double u = units();
  to_height(p.bottom, MoveKind::kLine);
  pause(c.of(kDtb));
  spindle_ = 0;
  to({at_.x + c.of(kRpa) * u, at_.y + c.of(kRpo) * u, at_.z + c.of(kRpap) * u}, MoveKind::kRapid);
  to_height(p.back, MoveKind::kRapid);
  to({hole.x, hole.y, at_.z}, MoveKind::kRapid);
}

}  // namespace capstan::verify::siemens

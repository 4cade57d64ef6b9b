#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <span>

#include "planner/proof/verify/findings.h"
#include "planner/proof/verify/program/heidenhain/interpreter.h"
#include "planner/proof/verify/program/peck.h"

// Cycles. Those with lines .0, .1 act where they stand; of those with Q parameters 247 does, and 200 to 203,
// 205, 207 and 251 to 253 run where they are called, along Z below the tool. All begin by rapid at the set-up
// clearance Q200 above the surface Q203, and end by rapid at the second one, Q204, where that is higher.

namespace capstan::verify::heidenhain {

using model::MoveKind;

namespace {

enum Q : int {
  kClearance = 200,
  kDepth = 201,
  kPlunge = 202,
  kSurface = 203,
  kSecond = 204,
  kLeastPlunge = 205,
  kFeed = 206,
  kFeedOut = 208,
  kDwellTop = 210,
  kDwellDepth = 211,
  kDecrement = 212,
  kBreaks = 213,
  kOffWall = 214,
  kOperation = 215,
  kPitch = 239,
  kFeedToStart = 253,
  kBreakBy = 256,
  kBreakDepth = 257,
  kAboveFirst = 258,
  kAboveLast = 259,
  kAngle = 336,
  kPreset = 339,
  kStart = 379,
  kDepthReference = 395
};

struct Known {
  int cycle;
  std::array<int, 20> needed;   ///< 0: none
  std::array<int, 4> may_have;  ///< of newer versions: `complete` says with which values
};
constexpr std::array<Known, 10> kKnown = {{
    {200, {kClearance, kDepth, kFeed, kPlunge, kDwellTop, kSurface, kSecond, kDwellDepth}, {kDepthReference}},
    {201, {kClearance, kDepth, kFeed, kDwellDepth, kFeedOut, kSurface, kSecond}, {}},
    {202,
     {kClearance, kDepth, kFeed, kDwellDepth, kFeedOut, kSurface, kSecond, kOffWall, kAngle},
     {kDepthReference}},
    {203,
     {kClearance, kDepth, kFeed, kPlunge, kDwellTop, kSurface, kSecond, kDecrement, kBreaks, kLeastPlunge,
      kDwellDepth, kFeedOut, kBreakBy},
     {kDepthReference}},
    {205,
     {kClearance, kDepth, kFeed, kPlunge, kSurface, kSecond, kDecrement, kLeastPlunge, kAboveFirst,
      kAboveLast, kBreakDepth, kBreakBy, kDwellDepth},
     {kStart, kFeedToStart, kFeedOut, kDepthReference}},
    {207, {kClearance, kDepth, kPitch, kSurface, kSecond}, {}},
    {247, {kPreset}, {}},
    // Pockets (pockets.cpp). Lists: a public table of each cycle's parameters in the control's order.
    {251,
     {kOperation, 218, 219,   220, 368,        224,      367,     207, 351, kDepth,
      kPlunge,    369, kFeed, 338, kClearance, kSurface, kSecond, 370, 366, 385},
     {}},
    {252,
     {kOperation, 223, 368, 207, 351, kDepth, kPlunge, 369, kFeed, 338, kClearance, kSurface, kSecond, 370,
      366, 385},
     {}},
    {253,
     {kOperation, 218, 219, 368, 374, 367, 207, 351, kDepth, kPlunge, 369, kFeed, 338, kClearance, kSurface,
      kSecond, 366, 385},
     {}},
}};

/// A feed that is written MAX or FMAX: by rapid.
constexpr double kRapidFeed = std::numeric_limits<double>::infinity();
constexpr int kMostPecks = 100000;

/// The number of a parameter; MAX where the cycle comes out by it.
std::optional<double> value_of(int parameter, const std::string& text) {
  if (parameter == kFeedOut && (text == "MAX" || text == "FMAX")) return kRapidFeed;
  return number_behind(text, "");
}

bool in(std::span<const int> all, int one) {
  return one != 0 && std::find(all.begin(), all.end(), one) != all.end();
}

}  // namespace

void Interpreter::cycle_definition(const std::vector<std::string>& w) {
  if (w.size() < 3) return fault(26, "CHK-CYCLE", "CYCL DEF has no number");
  if (w[2].find('.') != std::string::npos) return old_cycle(w[2], w);
  const auto number = number_behind(w[2], "");
  if (!number || *number != std::floor(*number) || *number < 0.0 || *number > 9999.0)
    return fault(26, "CHK-CYCLE", "CYCL DEF " + w[2].substr(0, 20) + " is no cycle's number");
  q_cycle(static_cast<int>(*number), w);
}

/// 9: waits where it stands. 32: the tolerance of paths; 32.1 without T leaves it to machine data.
void Interpreter::old_cycle(const std::string& number, const std::vector<std::string>& w) {
  if (number == "9.0") {
    waits_for_dwell_ = true;
    return;
  }
  if (number == "9.1") {
    const double seconds = w.size() == 5 && w[3] == "DWELL" ? number_behind(w[4], "").value_or(-1.0) : -1.0;
    if (!waits_for_dwell_ || seconds < 0.0)
      fault(33, "CHK-WORD", "cycle 9.1 takes DWELL and seconds, behind 9.0");
    waits_for_dwell_ = false;
    if (seconds >= 0.0) dwell(seconds);
    return;
  }
  if (number == "32.0") {
    tolerance_part_ = 1;
    tolerance_ = naive_ = kNoTolerance;
    return;
  }
  if (number == "32.1" && tolerance_part_ == 1) {
    tolerance_part_ = 2;
    if (w.size() == 3) return;
    const auto t = w.size() == 4 ? number_behind(w[3], "T") : std::nullopt;
    if (!t || !(*t > 0.0))
      return fault(33, "CHK-CYCLE", "cycle 32.1 takes T, a tolerance above zero, or nothing");
    tolerance_ = naive_ = *t * units();
    return;
  }
  if (number == "32.2" && tolerance_part_ == 2) {
    tolerance_part_ = 0;
    const bool known = w.size() > 3 && (w[3] == "HSC-MODE:0" || w[3] == "HSC-MODE:1") &&
                       (w.size() == 4 || (w.size() == 5 && number_behind(w[4], "TA")));
    if (!known)
      fault(33, "CHK-UNVERIFIABLE", "cycle 32.2 is followed with HSC-MODE:0 or 1 and TA only", true);
    return;
  }
  unfollowed("CYCL DEF " + number.substr(0, 20));
}

void Interpreter::q_cycle(int number, const std::vector<std::string>& w) {
  if (number != 247) cycle_.reset();  // that one acts where it stands, and leaves the one that is defined
  const auto* known =
      std::find_if(kKnown.begin(), kKnown.end(), [&](const Known& k) { return k.cycle == number; });
  if (known == kKnown.end()) return unfollowed("CYCL DEF " + std::to_string(number));
  CycleDefinition c;
  c.number = number;
  const std::string name = "cycle " + std::to_string(number) + ": ";
  for (std::size_t i = 3; i < w.size(); ++i) {
    const std::size_t equals = w[i].find('=');
    if (w[i].front() != 'Q' || equals == std::string::npos) {
      if (c.q.empty()) continue;  // its name
      return fault(33, "CHK-SYNTAX", name + w[i].substr(0, 20) + " stands among its parameters");
    }
    const auto q = number_behind(w[i].substr(0, equals), "Q");
    std::string text = w[i].substr(equals + 1);
    if (text.empty() && i + 1 < w.size() && w[i + 1].find('=') == std::string::npos) text = w[++i];
    const auto value = q ? value_of(static_cast<int>(*q), text) : std::nullopt;
    if (!value) {
      fault(33, "CHK-UNVERIFIABLE", name + w[i].substr(0, 20) + " is no number and not followed", true);
      return;
    }
    const int parameter = static_cast<int>(*q);
    if (*q != parameter || (!in(known->needed, parameter) && !in(known->may_have, parameter))) {
      fault(33, "CHK-UNVERIFIABLE", name + w[i].substr(0, 20) + " is not followed", true);
      return;
    }
    if (!c.q.emplace(parameter, *value).second)
      fault(33, "CHK-WORD-TWICE", name + "Q" + std::to_string(parameter) + " stands twice");
  }
  for (const int q : known->needed) {
    if (q != 0 && !c.has(q)) return fault(26, "CHK-CYCLE", name + "Q" + std::to_string(q) + " is missing");
  }
  if (number == 247) return preset(c);
  if (!complete(c)) return;
  cycle_ = std::move(c);
}

/// What would run otherwise than is followed.
bool Interpreter::complete(const CycleDefinition& c) {
  const auto unverifiable = [&](const std::string& why) {
    fault(33, "CHK-UNVERIFIABLE", "cycle " + std::to_string(c.number) + ": " + why, true);
    return false;
  };
  if (c.of(kDepthReference) != 0.0) return unverifiable("Q395 counts the depth otherwise; state 0");
  if (c.number == 200 && c.of(kPlunge) < -c.of(kDepth) - kClose)
    return unverifiable("Q202 is less than the depth: how it pecks depends on the control's version");
  if (c.number == 203 || c.number == 205) return pecks_alike(c);
  if (c.number == 202 && c.of(kOffWall) != 0.0)
    return unverifiable("Q214 moves the bar off the wall by a distance of the control's own; state 0");
  if (c.number == 201 && c.of(kFeedOut) == kRapidFeed)
    return unverifiable("Q208 is MAX: a reamer that comes out by rapid");
  return true;
}

/// Whether all versions of the control make the same pecks of this. 203 without breaks, or after the last of
/// Q213, comes back to other heights; 205 with Q258 unlike Q259 divides what lies between as is nowhere said.
bool Interpreter::pecks_alike(const CycleDefinition& c) {
  const auto unverifiable = [&](const std::string& why) {
    fault(33, "CHK-UNVERIFIABLE", "cycle " + std::to_string(c.number) + ": " + why, true);
    return false;
  };
  const auto wrong = [&](const std::string& why) {
    fault(26, "CHK-CYCLE", "cycle " + std::to_string(c.number) + ": " + why);
    return false;
  };
  if (!(c.of(kPlunge) > 0.0))
    return wrong("the plunge Q202 is " + plain(c.of(kPlunge)) + "; it is above zero");
  if (c.of(kDecrement) < 0.0 || c.of(kLeastPlunge) < 0.0)
    return wrong("Q212 and Q205 are distances; one of them is below zero");
  const bool whole = c.of(kPlunge) >= -c.of(kDepth) - kClose;
  if (c.number == 203) {
    if (whole) return true;
    if (!(c.of(kBreakBy) > 0.0))
      return wrong("Q256, how far it comes up to break the chip, is not above zero");
    if (c.of(kDecrement) == 0.0 && c.of(kBreaks) * c.of(kPlunge) >= -c.of(kDepth) - kClose) return true;
    return unverifiable(
        "where it is fed again behind the last of Q213 breaks depends on the control's version");
  }
  const bool knows_start = pecking_ == "itnc530" || pecking_ == "tnc640", knows_out = pecking_ == "tnc640";
  if (pecking_ == "explicit") {
    if (!c.has(kFeedOut))
      return unverifiable(
          "without Q208 how it comes out is the version's; state pecking_cycle of the machine");
  } else if (c.has(kStart) != knows_start || c.has(kFeedToStart) != knows_start ||
             c.has(kFeedOut) != knows_out || c.has(kDepthReference) != knows_out) {
    return wrong("its parameters are not those of this control (pecking_cycle " + pecking_ +
                 "): Q379 and Q253 of itnc530 and tnc640, Q208 and Q395 of tnc640");
  }
  if (c.of(kStart) != 0.0) return unverifiable("a deepened starting point (Q379) is not followed; state 0");
  if (c.of(kBreakDepth) != 0.0)
    return unverifiable("chips broken within a plunge (Q257) are not followed; state 0");
  if (c.of(kAboveFirst) != c.of(kAboveLast))
    return unverifiable("Q258 and Q259 differ: what lies between them is not said; state them alike");
  if (!(c.of(kAboveFirst) > 0.0))
    return wrong("Q258 is " + plain(c.of(kAboveFirst)) + ": the rapid would end in the bottom of the hole");
  return true;
}

/// Activates a row of the preset table; shifts, mirrors, turns and scales of the work end with it.
void Interpreter::preset(const CycleDefinition& c) {
  const double row = c.of(kPreset);
  if (row < 1.0 || row > static_cast<double>(kOffsets.size()) || row != std::floor(row))
    return fault(3, "CHK-WORK-OFFSET",
                 "cycle 247: Q339 is " + plain(row) + "; rows from 1 to " + std::to_string(kOffsets.size()) +
                     " of the preset table are followed");
  const int code = offset_code(kOffsets[static_cast<std::size_t>(row) - 1]);
  if (offset_ != code && offset_ != 0) known_[0] = known_[1] = known_[2] = false;
  offset_ = code;
  stated_ |= kStatedOffset;
}

std::optional<Interpreter::Heights> Interpreter::heights(const CycleDefinition& c) {
  const auto wrong = [&](const std::string& why) {
    fault(26, "CHK-CYCLE", "cycle " + std::to_string(c.number) + ": " + why);
    return std::nullopt;
  };
  const double u = units(), surface = c.of(kSurface) * u;
  if (c.of(kClearance) < 0.0 || c.of(kSecond) < 0.0)
    return wrong("Q200 and Q204 are distances; one of them is below zero");
  if (!(c.of(kDepth) < 0.0)) return wrong("the depth Q201 is " + plain(c.of(kDepth)) + "; it is below zero");
  Heights h;
  h.start = surface + c.of(kClearance) * u;
  h.bottom = surface + c.of(kDepth) * u;
  h.back = surface + std::max(c.of(kClearance), c.of(kSecond)) * u;
  return h;
}

void Interpreter::call_cycle() {
  if (!cycle_) return fault(26, "CHK-CYCLE", "a cycle is called and none is defined that is followed");
  const CycleDefinition c = *cycle_;
  const auto h = heights(c);
  if (!h) return;
  if (!known_[0] || !known_[1] || !known_[2])
    return fault(26, "CHK-CYCLE", "a cycle begins where the position is not known");
  if (at_.z < h->start - kClose)
    fault(26, "CHK-CYCLE",
          "Q203 + Q200, " + mm(h->start) + ", is above the height from which the cycle is called, " +
              mm(at_.z));
  if (c.number >= 251 && c.number <= 253) return pocket(c, *h);
  const double feed = feed_;
  to_height(h->start, MoveKind::kRapid);
  if (c.number == 200) drill(c, *h);
  if (c.number == 201) ream(c, *h);
  const int turns = spindle_;
  if (c.number == 202) bore(c, *h);
  if (c.number == 203 || c.number == 205) peck(c, *h);
  if (c.number == 207) tap(c, *h);
  to_height(h->back, MoveKind::kRapid);
  if (c.number == 202 && turns != 0) start(turns);
  feed_ = feed;
}

void Interpreter::drill(const CycleDefinition& c, const Heights& h) {
  if (!(c.of(kFeed) > 0.0)) fault(18, "CHK-FEED", "cycle 200 has no feed (Q206)");
  feed_ = c.of(kFeed) * units();
  stated_ |= kStatedFeed;
  to_height(h.bottom, MoveKind::kLine);
  if (c.of(kDwellDepth) > 0.0) dwell(c.of(kDwellDepth));
}

/// Down at Q206, up at Q208, or as down where that is 0.
void Interpreter::ream(const CycleDefinition& c, const Heights& h) {
  if (!(c.of(kFeed) > 0.0) || c.of(kFeedOut) < 0.0)
    fault(18, "CHK-FEED", "cycle 201 has no feed (Q206, Q208)");
  feed_ = c.of(kFeed) * units();
  stated_ |= kStatedFeed;
  to_height(h.bottom, MoveKind::kLine);
  if (c.of(kDwellDepth) > 0.0) dwell(c.of(kDwellDepth));
  if (c.of(kFeedOut) > 0.0) feed_ = c.of(kFeedOut) * units();
  to_height(h.start, MoveKind::kLine);
}

/// Down by Q202 from the surface on, each time less by Q212 and no less than Q205, the last one what is left.
/// Between two, 203 comes up by Q256 (at a feed of the control's own: as a rapid); 205 out to the clearance
/// and back to Q258 above the bottom, by rapid.
void Interpreter::peck(const CycleDefinition& c, const Heights& h) {
  if (!(c.of(kFeed) > 0.0) || c.of(kFeedOut) < 0.0)
    fault(18, "CHK-FEED", "cycle " + std::to_string(c.number) + " has no feed (Q206, Q208)");
  const double u = units();
  double bottom = c.of(kSurface) * u, one = c.of(kPlunge) * u;
  feed_ = c.of(kFeed) * u;
  stated_ |= kStatedFeed;
  for (int n = 0; n < kMostPecks && cycle_blocks_ <= kCycleBlockCap; ++n) {
    bottom = peck_bottom(bottom, one, h.bottom);
    to_height(bottom, MoveKind::kLine);
    if (bottom <= h.bottom + kClose) break;
    if (c.number == 203) {
      to_height(std::min(h.start, bottom + c.of(kBreakBy) * u), MoveKind::kRapid);
    } else {
      to_height(h.start, MoveKind::kRapid);
      to_height(std::min(h.start, bottom + c.of(kAboveFirst) * u), MoveKind::kRapid);
    }
    if (c.of(kDecrement) > 0.0) one = std::max(one - c.of(kDecrement) * u, c.of(kLeastPlunge) * u);
    if (!(one > 0.0))
      return fault(26, "CHK-CYCLE",
                   "cycle " + std::to_string(c.number) + ": its plunges become nothing before the bottom");
  }
  if (c.of(kDwellDepth) > 0.0) dwell(c.of(kDwellDepth));
  out_of(c, h);
}

/// Down, the spindle stopped at the angle Q336, out at Q208; as before the cycle it turns again at its end
/// (cycle 202, "restores the coolant and spindle conditions").
void Interpreter::bore(const CycleDefinition& c, const Heights& h) {
  if (!(c.of(kFeed) > 0.0) || c.of(kFeedOut) < 0.0)
    fault(18, "CHK-FEED", "cycle 202 has no feed (Q206, Q208)");
  feed_ = c.of(kFeed) * units();
  stated_ |= kStatedFeed;
  to_height(h.bottom, MoveKind::kLine);
  if (c.of(kDwellDepth) > 0.0) dwell(c.of(kDwellDepth));
  spindle_ = 0;
  out_of(c, h);
}

/// At Q208: at Q206 where that is 0, by rapid where it is MAX or there is none.
void Interpreter::out_of(const CycleDefinition& c, const Heights& h) {
  const double out = c.has(kFeedOut) ? c.of(kFeedOut) : kRapidFeed;
  if (out != kRapidFeed && out > 0.0) feed_ = out * units();
  to_height(h.start, out == kRapidFeed ? MoveKind::kRapid : MoveKind::kLine);
}

/// Spindle and feed in step, down and back to the clearance; the spindle stands then.
void Interpreter::tap(const CycleDefinition& c, const Heights& h) {
  const double pitch = c.of(kPitch) * units();
  if (pitch == 0.0) fault(22, "CHK-TAP-FEED", "cycle 207 has no pitch (Q239)");
  if (!(speed_ > 0.0)) fault(15, "CHK-SPINDLE", "cycle 207 has no speed (S of TOOL CALL)");
  const double way = pitch < 0.0 ? -1.0 : 1.0;
  Block b = block();
  b.from_cycle = b.synchronised = true;
  b.move = MoveKind::kLine;
  b.pitch_mm = std::abs(pitch);
  b.feed_mm_min = b.pitch_mm * speed_;
  b.spindle_rpm = way * speed_;
  b.to.z = h.bottom;
  for (int i = 0; i < 3; ++i) b.words[i] = b.known_to[i] = true;
  put(b);
  std::swap(b.from, b.to);
  b.spindle_rpm = -b.spindle_rpm;
  put(b);
  spindle_ = 0;
}

}  // namespace capstan::verify::heidenhain

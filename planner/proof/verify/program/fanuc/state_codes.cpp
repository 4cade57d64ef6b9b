#include <algorithm>
#include <cmath>

#include "planner/proof/verify/findings.h"
#include "planner/proof/verify/program/fanuc/interpreter.h"

// Codes that set the state of the control: units, planes, distances, compensations, offsets, path modes.

namespace capstan::verify::fanuc {

void Interpreter::unit_code(bool inch, const BlockWords& s) {
  if (units_stated_ && inch != inch_)
    fault(2, "CHK-UNITS",
          "the unit of length is switched from " + std::string(inch_ ? "inch" : "mm") + " to " +
              (inch ? "inch" : "mm"));
  if (s.axes() || s.is('F') || s.is('I') || s.is('J'))
    fault(2, "CHK-UNITS", "G20 and G21 need a block of their own; here words of lengths are beside it");
  inch_ = inch;
  units_stated_ = true;
  stated_ |= kStatedUnits;
}

void Interpreter::feed_code(int mode) {
  if (mode != feed_mode_) {
    feed_ = 0.0;  // F of the other mode means something else: it is stated anew
    stated_ &= ~static_cast<unsigned>(kStatedFeed);
  }
  feed_mode_ = mode;
  stated_ |= kStatedFeedMode;
}

void Interpreter::length_code(int g, const BlockWords& s) {
  const bool moves_z = s.is('Z') || s.code(280);
  if (g == 490) {
    // Alone it moves Z down by the offset, unless G53 or G28 took that away before or does so in this block.
    if (length_ >= 0 && !offset_away_ && !s.code(530) && !s.code(280))
      fault(8, "CHK-LENGTH-MOVE",
            "G49 itself moves Z down by the length offset; state it with G53 Z, or behind G28 Z");
    length_ = -1;
    return;
  }
  if (!s.is('H')) return fault(5, "CHK-TOOL-NUMBER", "G43 has no H, the number of the tool's length");
  if (!moves_z)
    fault(8, "CHK-LENGTH-MOVE", "G43 without Z moves Z by the length offset itself; state Z in its block");
  const int before = length_;
  length_ = static_cast<int>(std::clamp(s.of('H'), 0.0, 1e9));
  if (length_ == 0) length_ = -1;  // H0 is no offset
  offset_away_ = false;
  stated_ |= kStatedLength;
  if (length_ != before) known_[2] = false;  // the tip's height is another one now
}

void Interpreter::offset_code_of(int g, const BlockWords& s) {
  int code = g;
  if (g == 541 || g == 1540) {
    const double p = s.is('P') ? s.of('P') : 0.0;
    code = g * 1000 + static_cast<int>(std::clamp(p, 0.0, 999.0));
    const bool own = (g == 1540) == ways_.haas;
    if (!own || p < 1.0 || p != std::floor(p) || p > ways_.extended_offsets)
      fault(3, "CHK-WORK-OFFSET",
            (g == 541 ? "G54.1 P" : "G154 P") + plain(p) +
                " is none of this machine's work offsets; it has " + std::to_string(ways_.extended_offsets) +
                " beyond G59");
  }
  if (offset_ != code && offset_ != 0) known_[0] = known_[1] = known_[2] = false;
  offset_ = code;
  stated_ |= kStatedOffset;
}

void Interpreter::path_code(int g, const BlockWords& s) {
  if (g == 1870) {
    if (!ways_.haas)
      return fault(33, "CHK-CODE", "G187 is Haas's; this control has another meaning for it, or none");
    accuracy_mm_ = s.is('E') ? s.of('E') * units() : ways_.tolerance_mm;
    if (tolerance_ > 0.0) tolerance_ = naive_ = accuracy_mm_;
    return;
  }
  if (g == 51) {
    const double q = s.is('Q') ? s.of('Q') : -1.0;
    if (ways_.haas || (q != 0.0 && q != 1.0))
      return fault(33, "CHK-CODE", "G5.1 is followed with Q1 and Q0 on a FANUC only");
    smooth_ = q == 1.0;
    return;
  }
  tolerance_ = naive_ = g == 610 ? 0.0 : accuracy_mm_;
}

void Interpreter::state_code(int g, const BlockWords& s) {
  if (is_offset(g)) return offset_code_of(g, s);
  switch (g) {
    case 170:
    case 180:
    case 190:
      plane(g / 10);
      break;
    case 400:
      radius_ = -1;
      stated_ |= kStatedRadius;
      break;
    case 410:
    case 420:
      left_ = g == 410;
      radius_ = static_cast<int>(std::clamp(s.is('D') ? s.of('D') : tool_, 0.0, 1e9));
      break;
    case 430:
    case 490:
      length_code(g, s);
      break;
    case 51:
    case 610:
    case 640:
    case 1870:
      path_code(g, s);
      break;
    case 900:
    case 910:
      absolute_ = g == 900;
      stated_ |= kStatedDistance;
      break;
    case 980:
    case 990:
      to_r_ = g == 990;
      break;
    default: {
      static constexpr int kElsewhere[] = {0,   10,  20,  30,  40,  200, 210, 280, 530, 730, 740, 760,
                                           800, 810, 820, 830, 840, 850, 860, 870, 880, 890, 940, 950};
      if (std::find(std::begin(kElsewhere), std::end(kElsewhere), g) == std::end(kElsewhere))
        fault(33, "CHK-CODE",
              "G" + plain(g / 10.0) + " is not followed: what it moves, shifts or sets is not known");
    }
  }
}

}  // namespace capstan::verify::fanuc

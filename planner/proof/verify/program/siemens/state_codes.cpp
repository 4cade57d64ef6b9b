#include <algorithm>
#include <cmath>

#include "planner/proof/verify/findings.h"
#include "planner/proof/verify/program/siemens/interpreter.h"

// Codes that set the state of the control: units, offsets, path modes, tools and their lengths, spindle,
// coolant, stops.

namespace capstan::verify::siemens {
namespace {

/// Ends of subprograms, gear steps and axis mode of the spindle, and calls of ISO mode: no builder's,
/// whatever a file lists. Source: Siemens, SINUMERIK 840D sl, list of M commands; ISO milling, M96 to M99.
constexpr bool is_own_m(int m) { return m == 17 || (m >= 40 && m <= 45) || m == 70 || (m >= 96 && m <= 99); }

}  // namespace

void Interpreter::unit(bool inch) {
  if (units_stated_ && inch != inch_)
    fault(2, "CHK-UNITS",
          "the unit of length is switched from " + std::string(inch_ ? "inch" : "mm") + " to " +
              (inch ? "inch" : "mm"));
  inch_ = inch;
  units_stated_ = true;
  stated_ |= kStatedUnits;
}

void Interpreter::work_offset(int code) {
  if (offset_ != code && offset_ != 0) known_[0] = known_[1] = known_[2] = false;
  offset_ = code;
  if (code != 0) stated_ |= kStatedOffset;
}

/// G64 and a missing ADIS= or CTOL= round by machine data, which nobody here knows.
void Interpreter::path_mode(int g, const BlockWords& s) {
  double tolerance = kNoTolerance;
  if (g == 60) tolerance = 0.0;
  if (g == 641 && s.adis) tolerance = std::max(*s.adis, s.adispos.value_or(0.0)) * units();
  if (g == 642) tolerance = contour_tolerance_;
  by_contour_tolerance_ = g == 642;
  tolerance_ = naive_ = tolerance;
}

void Interpreter::state_code(int g, const BlockWords& s) {
  if (g >= 505 && g <= 599) return work_offset(10 * g);
  switch (g) {
    case 0:
    case 1:
    case 2:
    case 3:
    case 4:
    case 53:
    case 153:
      break;  // motion()
    case 17:
    case 18:
    case 19:
      plane(g);
      break;
    case 40:
      radius_ = -1;
      stated_ |= kStatedRadius;
      break;
    case 41:
    case 42:
      left_ = g == 41;
      radius_ = tool_;
      break;
    case 54:
    case 55:
    case 56:
    case 57:
      work_offset(10 * g);
      break;
    case 500:
      work_offset(0);
      break;
    case 60:
    case 64:
    case 641:
    case 642:
      path_mode(g, s);
      break;
    case 70:
    case 700:
    case 71:
    case 710:
      unit(g == 70 || g == 700);
      feed_unit_known_ = g == 700 || g == 710;
      break;
    case 90:
    case 91:
      absolute_ = g == 90;
      stated_ |= kStatedDistance;
      break;
    case 94:
    case 95:
      if (g != feed_mode_) {
        feed_ = 0.0;  // F of the other mode means something else: it is stated anew
        stated_ &= ~static_cast<unsigned>(kStatedFeed);
      }
      feed_mode_ = g;
      stated_ |= kStatedFeedMode;
      break;
    default:
      fault(33, "CHK-CODE",
            "G" + std::to_string(g) + " is not followed: what it moves, shifts or sets is not known");
  }
}

/// D1 is the length of the tool in the spindle; it acts with the next move of Z. D0 takes it away.
void Interpreter::edge(double d) {
  const int before = length_;
  length_off_ = d == 0.0;
  if (d == 0.0) {
    length_ = -1;
  } else if (d == 1.0 && tool_ > 0) {
    length_ = tool_;
    stated_ |= kStatedLength;
  } else {
    fault(5, "CHK-TOOL-NUMBER",
          tool_ > 0 ? "D" + plain(d) + " is another edge's length; programs of one edge state D1"
                    : "D" + plain(d) + " is stated and no tool is loaded");
    length_ = -1;
  }
  if (length_ != before) known_[2] = false;  // the tip's height is another one now
}

void Interpreter::select_tool(const BlockWords& s) {
  if (s.is('T')) next_tool_ = s.of('T');
  if (!s.tool_name) return;
  const auto named = std::find_if(out_.tools.begin(), out_.tools.end(),
                                  [&](const HeaderTool& t) { return t.id == *s.tool_name; });
  if (named == out_.tools.end()) {
    fault(4, "CHK-TOOL", "no line of the header names the tool \"" + *s.tool_name + "\" (CAPSTAN TOOL)");
    next_tool_ = 0.0;
    return;
  }
  next_tool_ = named->tool;
}

void Interpreter::change_tool() {
  Block b = block();
  b.kind = Block::Kind::kToolChange;
  if (next_tool_ < 0.0) fault(4, "CHK-TOOL", "M6 changes the tool, and no T says to which");
  const int next = static_cast<int>(std::clamp(next_tool_, 0.0, 1e9));
  if (tool_ != next) known_[2] = false;  // nobody knows where this one's tip is
  b.tool = tool_ = next;
  out_.blocks.push_back(b);
  length_ = -1;  // which edge acts by itself is machine data
  length_off_ = false;
  spindle_ = 0;
}

void Interpreter::state_codes(const BlockWords& s) {
  if (s.ctol) contour_tolerance_ = *s.ctol < 0.0 ? kNoTolerance : *s.ctol * units();  // below 0: machine data
  for (int i = 0; i < s.g_count; ++i) state_code(s.g[i], s);
  if (s.ctol && by_contour_tolerance_) tolerance_ = naive_ = contour_tolerance_;
  select_tool(s);
  if (s.is('F') && !s.code(4)) {
    if (!feed_unit_known_) {
      fault(2, "CHK-UNVERIFIABLE",
            "F behind G70 or G71 counts in the unit of the control's basic system, which is machine data; "
            "state "
            "G700 or G710",
            true);
      feed_unit_known_ = true;  // said once
    }
    feed_ = s.of('F') * units();
    stated_ |= kStatedFeed;
  }
  if (s.is('S') && !s.code(4)) {
    speed_ = s.of('S');
    stated_ |= kStatedSpeed;
  }
}

void Interpreter::before_move(const BlockWords& s) {
  for (int i = 0; i < s.m_count; ++i) {
    switch (s.m[i]) {
      case 3:
      case 4:
        start(s.m[i] == 3 ? 1 : -1);
        break;
      case 6:
        change_tool();
        break;
      case 7:
      case 8:
        coolant(s.m[i]);
        break;
      case 19:
        spindle_ = 0;
        break;
      case 0:
      case 1:
      case 2:
      case 5:
      case 9:
      case 30:
        break;
      default:
        if (!is_own_m(s.m[i]) && builders(s.m[i])) break;
        fault(33, "CHK-CODE", "M" + std::to_string(s.m[i]) + " is not followed: what it does is not known",
              true);
    }
  }
  if (s.positions_spindle) spindle_ = 0;
  if (s.is('D')) edge(s.of('D'));
}

/// Where the machine's tools are proved out it stands between two of them, with the tool away and all off.
void Interpreter::optional_stop() {
  const bool away = machine_z_ && *machine_z_ >= top_mm_ - 1e-6;
  if (!proves_out_ || !away || spindle_ != 0 || flood_ || mist_ || through_)
    out_.odd.emplace_back(line_, "M1");
}

void Interpreter::after_move(const BlockWords& s) {
  if (s.m_code(5)) spindle_ = 0;
  if (s.m_code(9)) coolant(9);
  if (s.m_code(1)) optional_stop();
  if (s.m_code(0)) {
    Block b = block();
    b.kind = Block::Kind::kStop;
    out_.stops.push_back(b);
    out_.blocks.push_back(b);
  }
  if (!s.m_code(2) && !s.m_code(30)) return;
  Block b = block();
  b.kind = Block::Kind::kEnd;
  out_.blocks.push_back(b);
  out_.ended = true;
}

}  // namespace capstan::verify::siemens

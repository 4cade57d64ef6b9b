#include "planner/proof/verify/program/linuxcnc/interpreter.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>

#include "planner/proof/verify/findings.h"

namespace capstan::verify::linuxcnc {

using model::MoveKind;

namespace {

/// To where the probe touches: G38.2, which is an error where there is no touch, and G31, which is none.
constexpr int kToward = 382, kMach3sToward = 310;

constexpr bool is_motion(int g) {
  return g == 0 || g == 10 || g == 20 || g == 30 || g == 331 || g == 730 || g == 800 ||
         (g >= 810 && g <= 890) || g == kToward || g == kMach3sToward;
}
constexpr bool is_cycle(int g) { return g == 730 || (g >= 810 && g <= 890); }

/// M codes that LinuxCNC has and this reader does not follow, times ten.
/// M100 to M199 run programs of the shop. Source: LinuxCNC 2.9 manual, M-codes.
constexpr bool is_of_shop(int m) { return m % 10 == 0 && m >= 1000 && m <= 1990; }
constexpr bool is_other_m(int m) {
  return m % 10 == 0 && (m == 190 || (m >= 500 && m <= 530) || (m >= 610 && m <= 680) ||
                         (m >= 700 && m <= 730) || m == 980 || m == 990 || is_of_shop(m));
}

/// Mach3 runs a macro of the shop for each M that it has not itself: M47 goes back to the program's head, M98
/// and M99 are its subroutines.
constexpr bool may_be_macro(int m) { return m % 10 == 0 && m != 470 && m != 980 && m != 990; }

/// A tool or offset number; out of range becomes one that no table has.
int whole(double v) { return v >= 0.0 && v < 1e9 ? static_cast<int>(v) : 1000000000; }

std::string code_text(char letter, int tenths) {
  std::string out = letter + std::to_string(tenths / 10);
  if (tenths % 10 != 0) out += "." + std::to_string(tenths % 10);
  return out;
}

}  // namespace

bool Interpreter::gather(const Line& l, BlockSaid& s) {
  for (const Word& w : l.words) {
    if (w.letter == 'G' || w.letter == 'M') {
      const double tenths = std::round(w.value * 10.0);
      if (!(tenths >= 0.0 && tenths < 10000.0) || std::abs(w.value * 10.0 - tenths) > 1e-6) {
        fault(33, "CHK-CODE", std::string(1, w.letter) + plain(w.value) + " is not a code");
        return false;
      }
      const bool g = w.letter == 'G';
      int& count = g ? s.g_count : s.m_count;
      if (count >= (g ? 32 : 16)) continue;
      (g ? s.g : s.m)[count++] = static_cast<int>(tenths);
      continue;
    }
    const int i = w.letter - 'A';
    if (s.has[i])
      fault(33, "CHK-WORD-TWICE", std::string("the word ") + w.letter + " occurs twice in one block");
    s.has[i] = true;
    s.value[i] = w.value;
  }
  return true;
}

void Interpreter::length_code(int g, const BlockSaid& s) {
  const int before = length_;
  if (g == 490) {
    length_ = -1;
  } else if (g == 430) {
    length_ = s.is('H') ? whole(s.of('H')) : tool_;
    if (length_ == 0) length_ = -1;  // H0 is no offset
    stated_ |= kStatedLength;
  } else {
    length_ = 0;
    stated_ |= kStatedLength;
    fault(5, "CHK-DYNAMIC-LENGTH", "G43.1 sets a length offset that no tool table proves", true);
  }
  if (length_ != before || length_ == 0) known_[2] = false;  // the tip's height is another one now
}

void Interpreter::state_code(int g, const BlockSaid& s) {
  switch (g) {
    case 170:
    case 180:
    case 190:
      plane(g / 10);
      break;
    case 200:
    case 210: {
      const bool inch = g == 200;
      if (units_stated_ && inch != inch_)
        fault(2, "CHK-UNITS",
              "the unit of length is switched from " + std::string(inch_ ? "inch" : "mm") + " to " +
                  (inch ? "inch" : "mm"));
      inch_ = inch;
      units_stated_ = true;
      stated_ |= kStatedUnits;
      break;
    }
    case 400:
      radius_ = -1;
      stated_ |= kStatedRadius;
      break;
    case 410:
    case 420:
      left_ = g == 410;
      radius_ = s.is('D') ? whole(s.of('D')) : tool_;
      break;
    case 430:
    case 431:
    case 490:
      length_code(g, s);
      break;
    case 540:
    case 550:
    case 560:
    case 570:
    case 580:
    case 590:
    case 591:
    case 592:
    case 593:
      // The work's coordinates of where the tool stands are others now.
      if (offset_ != g && offset_ != 0) known_[0] = known_[1] = known_[2] = false;
      offset_ = g;
      stated_ |= kStatedOffset;
      break;
    case 610:
    case 611:
      tolerance_ = naive_ = 0.0;
      exact_stop_ = g == 611;
      break;
    case 640:  // without P as fast as it likes
      tolerance_ = ways_.mach3 ? ways_.tolerance_mm : s.is('P') ? s.of('P') * units() : kNoTolerance;
      naive_ = s.is('Q') ? s.of('Q') * units() : tolerance_;
      exact_stop_ = false;
      break;
    case 530:
    case 40:
      break;
    case 900:
      absolute_ = true;
      stated_ |= kStatedDistance;
      break;
    case 910:
      absolute_ = false;
      stated_ |= kStatedDistance;
      break;
    case 901:
    case 911:
      absolute_arcs_ = g == 901;
      arcs_stated_ = true;
      break;
    case 930:
    case 940:
    case 950:
      feed_mode_ = g / 10;
      feed_ = 0.0;  // LinuxCNC forgets F at each of them, the mode that is on included
      stated_ &= ~static_cast<unsigned>(kStatedFeed);
      stated_ |= kStatedFeedMode;
      break;
    case 970:
      break;
    case 980:
      return_to_r_ = false;
      break;
    case 990:
      return_to_r_ = true;
      break;
    default:
      if (!is_motion(g))
        fault(33, "CHK-CODE",
              code_text('G', g) + " is not followed: what it moves, shifts or sets is not known");
  }
}

void Interpreter::state_codes(const BlockSaid& s) {
  for (int i = 0; i < s.g_count; ++i) {
    // The unit comes first: it tells what the other words mean.
    if (s.g[i] == 200 || s.g[i] == 210 || (s.g[i] >= 930 && s.g[i] <= 950)) state_code(s.g[i], s);
  }
  if (s.is('F')) {
    feed_ = feed_mode_ == 93 ? s.of('F') : s.of('F') * units();
    stated_ |= kStatedFeed;
  }
  if (s.is('S')) {
    speed_ = s.of('S');
    stated_ |= kStatedSpeed;
  }
  if (s.is('T')) next_tool_ = whole(s.of('T'));
}

void Interpreter::machine_codes(const BlockSaid& s) {
  for (int i = 0; i < s.m_count; ++i) {
    switch (s.m[i]) {
      case 60: {
        Block b = block();
        b.kind = Block::Kind::kToolChange;
        if (next_tool_ < 0) fault(4, "CHK-TOOL", "M6 changes the tool, and no T says to which");
        if (tool_ != std::max(0, next_tool_)) known_[2] = false;  // nobody knows where this one's tip is
        b.tool = tool_ = std::max(0, next_tool_);
        out_.blocks.push_back(b);
        spindle_ = 0;  // LinuxCNC stops the spindle for a change
        break;
      }
      case 30:
      case 40:
        start(s.m[i] == 30 ? 1 : -1);
        break;
      case 50:
        spindle_ = 0;
        break;
      case 70:
      case 80:
      case 90:
        coolant(s.m[i] / 10);
        break;
      case 10:
      case 480:
      case 490:
        out_.odd.emplace_back(line_, code_text('M', s.m[i]));
        break;
      case 0:
      case 600:
      case 20:
      case 300:
        break;
      default:
        if ((ways_.mach3 ? may_be_macro(s.m[i]) : is_of_shop(s.m[i])) && builders(s.m[i] / 10)) break;
        fault(33, is_other_m(s.m[i]) ? "CHK-UNVERIFIABLE" : "CHK-CODE",
              code_text('M', s.m[i]) +
                  (is_other_m(s.m[i]) ? " is not followed" : " is none of " + name() + "'s"),
              is_other_m(s.m[i]));
    }
  }
}

void Interpreter::motion(const BlockSaid& s, bool machine_coordinates) {
  const bool axes = s.is('X') || s.is('Y') || s.is('Z');
  for (int i = 0; i < s.g_count; ++i) {
    if (!is_motion(s.g[i])) continue;
    if ((s.g[i] == kToward || s.g[i] == kMach3sToward) && !axes)
      fault(33, "CHK-WORD", code_text('G', s.g[i]) + " names no axis; " + name() + " refuses it");
    if (s.g[i] == 800) stated_ |= kStatedCycle;
    if (is_cycle(s.g[i]) && !is_cycle(motion_)) {
      cycle_known_ = false;
      cycle_clear_ = known_[2] ? at_.z : 1e300;
    }
    motion_ = s.g[i] == 800 ? -1 : s.g[i];
    cycle_active_ = is_cycle(motion_);
  }
  const bool centre = s.is('I') || s.is('J');
  if (!axes && !(centre && (motion_ == 20 || motion_ == 30))) return;
  if (motion_ >= 0 && !units_stated_) {
    fault(2, "CHK-UNITS",
          "a move before the unit of length was stated (G20 or G21): the control takes the unit that the "
          "program before left");
    units_stated_ = true;
  }
  switch (motion_) {
    case 0:
    case 10:
      straight(s, motion_ / 10, machine_coordinates);
      break;
    case 20:
    case 30:
      arc(s, motion_ == 20);
      break;
    case 331:
      tap(s);
      break;
    case kToward:
    case kMach3sToward:
      toward(s);
      break;
    case -1:
      fault(33, "CHK-UNVERIFIABLE", "the words of axes have no motion: state G0, G1 or another before them");
      break;
    default:
      cycle(s);
  }
}

/// A line of % opens a program where nothing stands before it, and ends it otherwise.
void Interpreter::percent(const Line& l) {
  if (!l.percent) return;
  if (!any_line_) {
    percent_ = true;
  } else if (!percent_) {
    fault(32, "CHK-END", "a % here, in a program that does not begin with one, is refused by " + name());
  } else {
    percent_end_ = true;
  }
}

void Interpreter::line(const Line& l, long number) {
  line_ = number;
  if (percent_end_) {
    if (!l.words.empty() && !out_.ended) {
      fault(32, "CHK-END", "the control ends at the % before this line; what follows is not run");
    }
    return;
  }
  percent(l);
  any_line_ = any_line_ || l.percent || !l.words.empty() || !l.comments.empty() || !l.fault.empty();
  for (const std::string& c : l.comments) {
    if (!read_comment(c, line_, out_)) continue;
    marker_ = static_cast<int>(out_.markers.size()) - 1;
    stated_ = 0;
  }
  command(l.command);
  if (!l.fault.empty()) {
    const int property = l.no_number ? 1 : 33;
    const char* code = l.no_number ? "CHK-NUMBER" : l.unverifiable ? "CHK-UNVERIFIABLE" : "CHK-SYNTAX";
    fault(property, code, l.fault, l.unverifiable);
  }
  if (l.deleted) {
    fault(33, "CHK-UNVERIFIABLE", "a block that may be skipped (/) is taken as not skipped", true);
  }
  if (l.words.empty() || out_.ended) {
    if (out_.ended && !l.words.empty()) fault(32, "CHK-END", "text goes on after the end of the program");
    return;
  }
  BlockSaid s;
  if (!gather(l, s)) return;
  block_rules(l, s);
  state_codes(s);
  machine_codes(s);
  bool g53 = false, dwells = false;
  for (int i = 0; i < s.g_count; ++i) {
    const int g = s.g[i];
    g53 = g53 || g == 530;
    dwells = dwells || g == 40;
    if (g == 200 || g == 210 || (g >= 930 && g <= 950)) continue;
    state_code(g, s);
  }
  if (dwells) {
    dwell(s.of('P') * ways_.unit_of_p_s);
  } else {
    motion(s, g53);
  }
  for (int i = 0; i < s.m_count; ++i) {
    // M1 stops only where the operator has said so.
    if (s.m[i] == 0 || s.m[i] == 600) {
      Block b = block();
      b.kind = Block::Kind::kStop;
      out_.stops.push_back(b);
      out_.blocks.push_back(b);
    }
    if (s.m[i] != 20 && s.m[i] != 300) continue;
    Block b = block();
    b.kind = Block::Kind::kEnd;
    out_.blocks.push_back(b);
    out_.ended = true;
  }
}

Program Interpreter::finish(long lines) {
  out_.lines = lines;
  return std::move(out_);
}

namespace {

/// All lines of a program, one after the other.
Program read_with(std::string_view text, Interpreter machine) {
  Line line;
  long number = 0;
  if (text.size() > kProgramCap) return too_large_program();
  while (!text.empty()) {
    const std::size_t end = text.find('\n');
    std::string_view one = text.substr(0, end);
    text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
    ++number;
    if (one.size() > machine.longest_line()) {
      line = {};
      line.fault = "the line has " + std::to_string(one.size()) + " characters; " + machine.name() +
                   " reads " + std::to_string(machine.longest_line()) + " at most";
    } else {
      split_line(one, line);
    }
    machine.line(line, number);
  }
  return machine.finish(number);
}

}  // namespace

Program read_program(std::string_view text, std::string_view shop_codes, std::string_view through_coolant) {
  return read_with(text, Interpreter(shop_codes, through_coolant));
}

Program read_mach3(std::string_view text, const model::Machine& machine) {
  return read_with(text, Interpreter(machine));
}

}  // namespace capstan::verify::linuxcnc

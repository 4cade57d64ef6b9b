#include "planner/proof/verify/program/grbl/interpreter.h"

#include <algorithm>
#include <cmath>

#include "planner/proof/verify/findings.h"
#include "planner/proof/verify/reader_options.h"

// One block after another, in the order of Grbl's gcode.c: feed mode, feed, speed, tool, spindle, coolant,
// dwell, plane, unit, length, work offset, distance mode, motion, and last what stops or ends the program.

namespace capstan::verify::grbl {

namespace {

constexpr int kToward = 382;  ///< G38.2, to a touch, and an alarm where there is none

constexpr bool is_motion(int g) {
  return g == 0 || g == 10 || g == 20 || g == 30 || g == kToward || g == 800;
}

/// By how much the number of G43.1 and the header's length of a tool may differ: both are written with the
/// machine's decimals, three at least of a micrometre.
constexpr double kEqualLengthMm = 0.0015;

}  // namespace

Interpreter::Interpreter(const model::Machine& machine) {
  by_m6_ = option(machine, "tool_change") == "m6";
  touches_off_ = verify::touches_off(machine);
  has_mist_ = option(machine, "mist") == "yes";
  // It follows the exact path, which every tolerance allows.
  tolerance_ = naive_ = std::max(0.0, machine.control.path_tolerance_mm);
}

bool Interpreter::gather(const Line& l, BlockSaid& s) {
  for (const Word& w : l.words) {
    if (w.letter == 'G' || w.letter == 'M') {
      const double tenths = std::round(w.value * 10.0);
      if (!(tenths >= 0.0 && tenths < 2550.0) || std::abs(w.value * 10.0 - tenths) > 1e-6) {
        fault(33, "CHK-CODE", std::string(1, w.letter) + plain(w.value) + " is not a code");
        return false;
      }
      const bool g = w.letter == 'G';
      int& count = g ? s.g_count : s.m_count;
      if (count >= (g ? 32 : 16)) {
        fault(33, "CHK-WORD", "more codes stand in one block than are followed");
        return false;
      }
      (g ? s.g : s.m)[count++] = static_cast<int>(tenths);
      continue;
    }
    const int i = w.letter - 'A';
    if (s.has[i])
      fault(33, "CHK-WORD-TWICE", std::string("the word ") + w.letter + " stands twice in one block");
    s.has[i] = true;
    s.value[i] = w.value;
  }
  return true;
}

/// Touched off at its change, a tool has its length in the zero of Z: in that of the work offset which acted
/// then, and in no other.
void Interpreter::touched_off() {
  if (!touches_off_) return;
  const bool acts = tool_ > 0 && touched_in_ != 0 && touched_in_ == offset_;
  length_ = acts ? tool_ : -1;
  stated_ = acts ? stated_ | kStatedLength : stated_ & ~static_cast<unsigned>(kStatedLength);
}

/// G43.1 Z: the length as a number, which is the header's of this tool. G49: none.
void Interpreter::length_code(const BlockSaid& s) {
  bool sets = false, ends = false;
  for (int i = 0; i < s.g_count; ++i) {
    sets = sets || s.g[i] == 431;
    ends = ends || s.g[i] == 490;
  }
  if (ends && !touches_off_) {
    if (length_ >= 0) known_[2] = false;
    length_ = -1;
  }
  if (!sets) return;
  known_[2] = false;
  length_ = -1;
  stated_ |= kStatedLength;
  if (touches_off_)
    return fault(
        5, "CHK-DYNAMIC-LENGTH",
        "G43.1 adds a length to a zero of Z that was set with the tool itself; take it out, or state "
        "tool_length: g43.1 under the machine's control");
  const auto& tools = out_.tools;
  const auto at =
      std::find_if(tools.begin(), tools.end(), [&](const HeaderTool& t) { return t.tool == tool_; });
  const double said = s.of('Z') * units();
  if (at == tools.end() || !at->length_mm)
    return fault(5, "CHK-DYNAMIC-LENGTH",
                 "G43.1 Z" + plain(s.of('Z')) + " is a length that no line of the header has of T" +
                     std::to_string(tool_),
                 true);
  if (std::abs(*at->length_mm - said) > kEqualLengthMm)
    return fault(5, "CHK-DYNAMIC-LENGTH",
                 "G43.1 sets a length of " + mm(said) + "; the header has " + mm(*at->length_mm) + " of T" +
                     std::to_string(tool_));
  length_ = tool_;
}

void Interpreter::state_code(int g) {
  switch (g) {
    case 170:
    case 180:
    case 190:
      return plane(g / 10);
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
      return;
    }
    case 400:
      stated_ |= kStatedRadius;
      return;
    case 540:
    case 550:
    case 560:
    case 570:
    case 580:
    case 590:
      if (offset_ != g && offset_ != 0) known_[0] = known_[1] = known_[2] = false;
      offset_ = g;
      stated_ |= kStatedOffset;
      touched_off();
      return;
    case 900:
    case 910:
      absolute_ = g == 900;
      stated_ |= kStatedDistance;
      return;
    case 930:
    case 940:
      if (feed_mode_ != g / 10) feed_ = 0.0;  // F of the other mode is forgotten
      feed_mode_ = g / 10;
      stated_ |= kStatedFeedMode;
      return;
    default:
      return;  // of their own, or faults: code_rules
  }
}

void Interpreter::state_codes(const BlockSaid& s) {
  for (int i = 0; i < s.g_count; ++i) {
    const int g = s.g[i];
    if (g == 200 || g == 210 || g == 930 || g == 940) state_code(g);  // F is of their unit
  }
  if (s.is('F')) {
    feed_ = feed_mode_ == 93 ? s.of('F') : s.of('F') * units();
    stated_ |= kStatedFeed;
  }
  if (s.is('S')) {
    speed_ = s.of('S');
    stated_ |= kStatedSpeed;
  }
  if (s.is('T')) next_tool_ = static_cast<int>(std::clamp(s.of('T'), 0.0, 1e9));
}

/// Whoever changes the tool may move it, to touch off: where it is then nobody knows.
void Interpreter::change_tool() {
  Block b = block();
  b.kind = Block::Kind::kToolChange;
  if (next_tool_ < 0) fault(4, "CHK-TOOL", "M6 changes the tool, and no T says to which");
  b.tool = tool_ = std::max(0, next_tool_);
  out_.blocks.push_back(b);
  known_[0] = known_[1] = known_[2] = false;
  machine_z_.reset();
  anywhere_ = true;
  if (touches_off_ && !by_m6_)
    fault(
        4, "CHK-TOOL-CHANGE",
        "the tool is changed at M0, a hold in which Grbl refuses to jog: whether Z was set with it cannot be "
        "told; state tool_length: g43.1 under the machine's control, or tool_change: m6",
        true);
  touched_in_ = offset_;
  touched_off();
}

void Interpreter::machine_codes(const BlockSaid& s) {
  for (int i = 0; i < s.m_count; ++i) {
    switch (s.m[i]) {
      case 60:
        if (by_m6_) {
          change_tool();
        } else {
          fault(4, "CHK-TOOL-CHANGE",
                "M6 is refused by Grbl, and nothing that sends this machine's programs carries it out "
                "(tool_change: m0); state T and M0");
        }
        break;
      case 30:
      case 40:
        start(s.m[i] == 30 ? 1 : -1);
        break;
      case 50:
        spindle_ = 0;
        break;
      case 70:
        mist_ = true;
        if (!has_mist_)
          fault(29, "CHK-CODE", "M7 is not compiled into this machine's Grbl (mist: no), which refuses it");
        break;
      case 80:
        flood_ = true;
        break;
      case 90:
        mist_ = flood_ = false;
        break;
      default:
        break;  // what stops and ends: flow; faults: code_rules
    }
  }
}

void Interpreter::motion(const BlockSaid& s, bool machine_coordinates) {
  for (int i = 0; i < s.g_count; ++i) {
    if (!is_motion(s.g[i])) continue;
    if (s.g[i] == 800) stated_ |= kStatedCycle;
    motion_ = s.g[i] == 800 ? -1 : s.g[i];
  }
  const bool axes = s.is('X') || s.is('Y') || s.is('Z'), centre = s.is('I') || s.is('J');
  if (!axes && !(centre && (motion_ == 20 || motion_ == 30))) return;
  if (motion_ < 0)
    return fault(33, "CHK-WORD", "the words of axes have no motion (G80); Grbl refuses the block");
  if (!units_stated_) {
    fault(2, "CHK-UNITS",
          "a move before the unit of length was stated (G20 or G21): the control takes the unit that the "
          "program before left");
    units_stated_ = true;
  }
  if (anywhere_ && !machine_coordinates)
    fault(
        9, "CHK-HEIGHT",
        "the tool moves in the work's coordinates behind its change, which leaves it anywhere; state G53 G0 "
        "Z with the top of Z before");
  anywhere_ = false;
  if (motion_ == kToward) return toward(s);
  if (motion_ == 0 || motion_ == 10) return straight(s, motion_ / 10, machine_coordinates);
  arc(s, motion_ == 20);
}

/// What stops or ends the program acts when the block's move has ended. M1 is passed over.
void Interpreter::flow(const BlockSaid& s) {
  for (int i = 0; i < s.m_count; ++i) {
    if (s.m[i] == 10) out_.odd.emplace_back(line_, "M1");
    if (s.m[i] == 0) {
      if (!by_m6_ && next_tool_ > 0 && next_tool_ != tool_) {
        change_tool();
        continue;
      }
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

void Interpreter::line(const Line& l, long number) {
  line_ = number;
  for (const std::string& c : l.comments) {
    if (!read_comment(c, line_, out_)) continue;
    marker_ = static_cast<int>(out_.markers.size()) - 1;
    stated_ = 0;
    touched_off();
  }
  if (!l.fault.empty()) fault(l.no_number ? 1 : 33, l.no_number ? "CHK-NUMBER" : "CHK-SYNTAX", l.fault);
  if (l.skips)
    fault(33, "CHK-SYNTAX",
          "Grbl passes over / and runs the block, whatever the operator has set; take it out");
  if (l.length > kLongestBlock)
    fault(33, "CHK-SYNTAX",
          "the block has " + std::to_string(l.length) +
              " characters without blanks and comments; Grbl takes " + std::to_string(kLongestBlock) +
              " at most");
  if (l.words.empty()) return;
  if (out_.ended) return fault(32, "CHK-END", "text goes on after the end of the program");
  BlockSaid s;
  if (!gather(l, s)) return;
  block_rules(s);
  state_codes(s);
  machine_codes(s);
  bool g53 = false;
  for (int i = 0; i < s.g_count; ++i) {
    const int g = s.g[i];
    g53 = g53 || g == 530;
    if (g == 40) dwell(s.of('P'));
    if (g != 200 && g != 210 && g != 930 && g != 940) state_code(g);
  }
  length_code(s);
  bool dwells = false, lengths = false;
  for (int i = 0; i < s.g_count; ++i) {
    dwells = dwells || s.g[i] == 40;
    lengths = lengths || s.g[i] == 431 || s.g[i] == 490;
  }
  BlockSaid moved = s;
  if (lengths) moved.has['Z' - 'A'] = false;  // Z is the length
  if (!dwells) motion(moved, g53);
  flow(s);
}

Program Interpreter::finish(long lines) {
  out_.lines = lines;
  return std::move(out_);
}

Program read_program(std::string_view text, const model::Machine& machine) {
  if (text.size() > kProgramCap) return too_large_program();
  Interpreter control(machine);
  long number = 0;
  while (!text.empty()) {
    const std::size_t end = text.find('\n');
    control.line(split_line(text.substr(0, end)), ++number);
    text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
  }
  return control.finish(number);
}

}  // namespace capstan::verify::grbl

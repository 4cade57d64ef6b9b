#include "planner/proof/verify/program/fanuc/interpreter.h"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "planner/proof/verify/findings.h"
#include "planner/proof/verify/program/fanuc/subprograms.h"
#include "planner/proof/verify/reader_options.h"

// One block after another: the frame of the tape, words, codes before the move, the move, codes behind it.
// FANUC B-63844EN/02, 11: M00, M01, M02, M05, M09 and M30 act when the block's move has ended.

namespace capstan::verify::fanuc {

using model::MoveKind;

namespace {

constexpr bool is_cycle(int g) { return g == 730 || g == 740 || g == 760 || (g >= 810 && g <= 890); }
constexpr bool is_motion(int g) { return g == 0 || g == 10 || g == 20 || g == 30 || g == 800 || is_cycle(g); }
/// What turns the spindle, changes or unclamps tools and pallets, or leaves the program's order, is no
/// builder's, whatever a file lists. Source: FANUC B-63844EN/02, 11 and 12.3 (M19, M96 to M99, M198); Haas
/// 96-8000, M codes (M16, M36, M39, M41, M42, M46, M50, M75, M82, M86, M95, M109).
constexpr bool is_own_m(int m, bool haas) {
  if (m == 19 || (m >= 96 && m <= 99) || m == 198) return true;
  return haas && (m == 16 || m == 36 || m == 39 || m == 41 || m == 42 || m == 46 || m == 50 || m == 75 ||
                  m == 82 || m == 86 || m == 95 || m == 109);
}

}  // namespace

bool Interpreter::BlockWords::code(int tenths) const {
  return std::find(g, g + g_count, tenths) != g + g_count;
}
bool Interpreter::BlockWords::m_code(int code) const {
  return std::find(m, m + m_count, code) != m + m_count;
}

Interpreter::Interpreter(const model::Machine& machine) {
  const auto is = [&](const char* name, std::string_view value) { return option(machine, name) == value; };
  ways_.haas = machine.control.dialect == "haas";
  ways_.seconds = is("dwell", "seconds");
  ways_.m29 = is("tap", "m29");
  ways_.proves_out = is("prove_out", "m1") || is("prove_out", "skip_m0");
  ways_.quadrants = is("arcs", "quadrant");
  ways_.helices = is("helices", "yes");
  ways_.codes = listed_codes(option(machine, "codes"));
  builders_codes(option(machine, "shop_codes"), option(machine, "through_coolant"));
  ways_.longest_block = static_cast<std::size_t>(option_number(machine, "line_length"));
  ways_.largest_radius_mm = option_number(machine, "largest_radius_mm");
  ways_.last_decimal_mm = std::pow(10.0, -machine.control.decimals);
  ways_.extended_offsets = static_cast<int>(option_number(machine, "extended_offsets"));
  ways_.peck_clearance_mm = option_number(machine, "peck_clearance_mm");
  // Haas has one setting, 22, for both.
  ways_.chip_break_mm = ways_.haas ? ways_.peck_clearance_mm : option_number(machine, "chip_break_mm");
  ways_.tolerance_mm = std::max(0.0, machine.control.path_tolerance_mm);
  const model::LinearAxis& z = machine.axes[2];
  ways_.top_mm = z.travel_max_mm > z.travel_min_mm ? z.travel_max_mm : 0.0;
  accuracy_mm_ = tolerance_ = naive_ = ways_.tolerance_mm;
}

/// The ends of the tape. False when the block is outside of the program.
bool Interpreter::frame(const Line& l) {
  if (closed_) {
    if (!l.words.empty())
      fault(32, "CHK-END", "the tape ends at the % before this block; what follows is not run");
    return false;
  }
  if (l.percent) {
    if (!opened_ && any_)
      fault(32, "CHK-END", "a % here, in a program that does not begin with one, ends the tape");
    closed_ = opened_ || any_;
    opened_ = true;
    return l.words.empty() && !closed_;
  }
  if (!l.words.empty() && !opened_ && !any_)
    fault(32, "CHK-END", "the program does not begin with %: what precedes the first % is not read");
  any_ = any_ || !l.words.empty();
  return true;
}

bool Interpreter::gather(const Line& l, BlockWords& s) {
  for (const Word& w : l.words) {
    if (w.letter == 'G' || w.letter == 'M') {
      const double tenths = std::round(w.value * 10.0);
      if (!(tenths >= 0.0 && tenths < 100000.0) || std::abs(w.value * 10.0 - tenths) > 1e-6 ||
          (w.letter == 'M' && w.point)) {
        fault(33, "CHK-CODE", std::string(1, w.letter) + plain(w.value) + " is not a code");
        return false;
      }
      const bool g = w.letter == 'G';
      int& count = g ? s.g_count : s.m_count;
      const std::size_t most = g ? std::size(s.g) : std::size(s.m);
      if (static_cast<std::size_t>(count) >= most) {
        fault(33, "CHK-CODE",
              "the block has more than " + std::to_string(most) + " codes of " + w.letter +
                  " and was not followed: write some of them in a block of their own");
        return false;
      }
      (g ? s.g : s.m)[count++] = static_cast<int>(g ? tenths : tenths / 10);
      continue;
    }
    const int i = w.letter - 'A';
    if (s.has[i])
      fault(33, "CHK-WORD-TWICE", std::string("the word ") + w.letter + " occurs twice in one block");
    s.has[i] = true;
    s.value[i] = w.value;
    s.point[i] = w.point;
  }
  return true;
}

void Interpreter::set_words(const BlockWords& s) {
  if (s.is('F')) {
    feed_ = s.of('F') * units();
    stated_ |= kStatedFeed;
  }
  if (s.is('S')) {
    speed_ = s.of('S');
    stated_ |= kStatedSpeed;
  }
  if (s.is('T')) next_tool_ = static_cast<int>(std::clamp(s.of('T'), 0.0, 1e9));
}

void Interpreter::change_tool() {
  Block b = block();
  b.kind = Block::Kind::kToolChange;
  if (next_tool_ < 0) fault(4, "CHK-TOOL", "M6 changes the tool, and no T says to which");
  if (smooth_) fault(27, "CHK-SMOOTH", "M6 while G5.1 Q1 is on; state G5.1 Q0 before");
  if (tool_ != std::max(0, next_tool_)) known_[2] = false;  // nobody knows where this one's tip is
  b.tool = tool_ = std::max(0, next_tool_);
  out_.blocks.push_back(b);
  spindle_ = 0;
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
      case 29:
        if (!ways_.m29) fault(33, "CHK-CODE", "M29 is not followed: this machine taps rigidly without it");
        if (!s.is('S')) fault(22, "CHK-TAP-FEED", "M29 has no S, the speed at which is tapped");
        rigid_ = ways_.m29;
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
        if (!is_own_m(s.m[i], ways_.haas) && builders(s.m[i])) break;
        fault(33, "CHK-CODE", "M" + std::to_string(s.m[i]) + " is not followed: what it does is not known",
              true);
    }
  }
}

/// Where the machine's tools are proved out it stands between two of them, with the tool away and all off.
void Interpreter::optional_stop() {
  const bool away = machine_z_ && *machine_z_ >= ways_.top_mm - 1e-6;
  if (!ways_.proves_out || !away || spindle_ != 0 || flood_ || mist_ || through_)
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
  if (smooth_) fault(32, "CHK-END", "the program ends with G5.1 Q1 on; state G5.1 Q0 before");
  Block b = block();
  b.kind = Block::Kind::kEnd;
  out_.blocks.push_back(b);
  out_.ended = true;
}

/// By way of the point that the words name to the reference point, axis by axis as named: 0i, 6.1.
void Interpreter::way_home(const BlockWords& s) {
  if (!s.axes()) return fault(33, "CHK-CODE", "G28 names no axis: which ones go home is not known");
  if (s.is('X') || s.is('Y'))
    return fault(9, "CHK-MACHINE-MOVE", "G28 of X or Y: where their reference point is, is not known");
  const double by = absolute_ ? s.of('Z') * units() : at_.z + s.of('Z') * units();
  const bool goes_down = absolute_ ? !known_[2] || by < at_.z : s.of('Z') < 0.0;
  if (goes_down)
    fault(10, "CHK-MACHINE-MOVE",
          "G28 goes by way of Z" + plain(by) + " of the work first; state G91 G28 Z0.");
  if (absolute_ || s.of('Z') != 0.0) straight(s, 0, false);
  Block b = block();
  b.in_machine = true;
  b.words[2] = true;
  b.to.z = ways_.top_mm;
  b.known_to[2] = false;
  const double before = at_.z;
  put(b);
  at_.z = before;  // of the work; not known any more
  offset_away_ = true;
  length_ = -1;
}

void Interpreter::motion(const BlockWords& s) {
  for (int i = 0; i < s.g_count; ++i) {
    const int g = s.g[i];
    if (!is_motion(g)) continue;
    if (g == 800) {
      stated_ |= kStatedCycle;
      if (rigid_ || motion_ == 840 || motion_ == 740) spindle_ = 0;
    }
    if (is_cycle(g) && !is_cycle(motion_)) {
      has_r_ = has_z_ = false;
      shrinks_ = false;
      q_ = p_s_ = 0.0;  // cancelled with the cycle that stated them: 30i 5.1
      initial_ = known_[2] ? at_.z : 1e300;
    }
    if (!is_cycle(g)) rigid_ = false;
    motion_ = g == 800 ? -1 : g;
    cycle_active_ = is_cycle(motion_);
  }
  if (s.code(280)) return way_home(s);
  const bool centre = s.is('I') || s.is('J');
  if (!s.axes() && is_cycle(motion_) && s.is('R'))
    return fault(26, "CHK-CYCLE",
                 "a block of a cycle with R and no axis drills on some controls (30i 5.1) and not on others: "
                 "state X and Y with it");
  if (!s.axes() && !(centre && (motion_ == 20 || motion_ == 30))) return;
  if (!units_stated_) {
    fault(2, "CHK-UNITS", "a move before the unit of length was stated (G20 or G21)");
    units_stated_ = true;
  }
  if (s.code(530)) {
    straight(s, 0, true);
    if (s.is('Z')) {  // the length offset goes as Z moves: 0i, 14.1.2
      offset_away_ = true;
      length_ = -1;
    }
    return;
  }
  if (motion_ == 0 || motion_ == 10) return straight(s, motion_ / 10, false);
  if (motion_ == 20 || motion_ == 30) {
    const std::size_t before = out_.blocks.size();
    arc(s, motion_ == 20);
    if (out_.blocks.size() > before) arc_rules(out_.blocks.back());
    return;
  }
  if (motion_ < 0)
    return fault(33, "CHK-UNVERIFIABLE",
                 "the words of axes have no motion: state G0, G1 or another before them");
  cycle(s);
}

double Interpreter::seconds_of_p(const BlockWords& s) {
  return s.point['P' - 'A'] ? s.of('P') : 0.001 * s.of('P');
}

void Interpreter::line(const Line& l, long number) {
  line_ = number;
  if (!frame(l)) return;
  for (const std::string& c : l.comments) {
    if (!read_comment(plain_comment(c), line_, out_)) continue;
    marker_ = static_cast<int>(out_.markers.size()) - 1;
    stated_ = 0;
  }
  if (!l.fault.empty())
    fault(l.no_number ? 1 : 33,
          l.no_number      ? "CHK-NUMBER"
          : l.unverifiable ? "CHK-UNVERIFIABLE"
                           : "CHK-SYNTAX",
          l.fault, l.unverifiable);
  if (l.words.empty()) return;
  if (out_.ended) return fault(32, "CHK-END", "text goes on after the end of the program");
  BlockWords s;
  if (!gather(l, s)) return;
  // A stop that may be passed over is as good as one that the operator chooses.
  const std::size_t words = s.is('N') ? 2 : 1;
  const bool only_stop =
      s.g_count == 0 && s.m_count == 1 && (s.m[0] == 0 || s.m[0] == 1) && l.words.size() == words;
  if (l.skipped && only_stop) return optional_stop();
  if (l.skipped)
    fault(33, "CHK-UNVERIFIABLE", "a block that may be skipped (/) is taken as not skipped", true);
  if (l.length > ways_.longest_block)
    fault(33, "CHK-SYNTAX",
          "the block has " + std::to_string(l.length) + " characters; this machine's have " +
              std::to_string(ways_.longest_block) + " at most: write it as several");
  known_codes(s);
  word_rules(s);
  range_rules(s);
  code_rules(s);
  point_rules(s);
  for (int i = 0; i < s.g_count; ++i) {
    if (s.g[i] == 200 || s.g[i] == 210) unit_code(s.g[i] == 200, s);
    if (s.g[i] == 940 || s.g[i] == 950) feed_code(s.g[i] / 10);
  }
  set_words(s);
  before_move(s);
  for (int i = 0; i < s.g_count; ++i) state_code(s.g[i], s);
  if (s.code(40)) {
    dwell(s.is('X') ? s.of('X') : seconds_of_p(s));
  } else {
    motion(s);
  }
  after_move(s);
}

Program Interpreter::finish(long lines) {
  if (opened_ && !closed_ && out_.ended)
    fault(32, "CHK-END", "the tape has no % behind the program: a control waits there for more");
  out_.lines = lines;
  return std::move(out_);
}

Program read_program(std::string_view text, const model::Machine& machine) {
  if (text.size() > kProgramCap) return too_large_program();
  Interpreter control(machine);
  Line line;
  long number = 0;
  const bool haas = machine.control.dialect == "haas";
  for (const RunLine& row : haas ? lines_of(text) : run_lines(text, kCycleBlockCap)) {
    split_line(row.text, line);
    control.line(line, number = row.number);
  }
  return control.finish(number);
}

}  // namespace capstan::verify::fanuc

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string>
#include <string_view>

#include "planner/ground/base/number.h"
#include "planner/proof/verify/findings.h"
#include "planner/proof/verify/program/fanuc/interpreter.h"

// What a control refuses in one block, what this machine's has not (codes, helices, large radii), and what
// one FANUC or Haas reads otherwise than the next: a word that no code of the block uses, two codes of one
// group (the last holds, and nobody means that), numbers without their decimal points.

namespace capstan::verify::fanuc {

using model::MoveKind;

namespace {

/// Groups of FANUC B-63844EN/02, 3, "G code list"; 0: of its block only.
int group_of_g(int g) {
  if (is_offset(g)) return 14;
  switch (g) {
    case 0:
    case 10:
    case 20:
    case 30:
      return 1;
    case 170:
    case 180:
    case 190:
      return 2;
    case 900:
    case 910:
      return 3;
    case 940:
    case 950:
      return 5;
    case 200:
    case 210:
      return 6;
    case 400:
    case 410:
    case 420:
      return 7;
    case 430:
    case 490:
      return 8;
    case 980:
    case 990:
      return 10;
    case 610:
    case 640:
      return 15;
    default:
      return (g >= 730 && g <= 760) || (g >= 800 && g <= 890) ? 9 : 0;
  }
}

/// By which the two radii of an arc may differ: FANUC B-63844EN/02, 4.4 (parameter 3410), the least setting.
constexpr double kClosureMm = 0.002;

int group_of_m(int m) {
  if (m == 0 || m == 1 || m == 2 || m == 30) return 1;
  if (m >= 3 && m <= 5) return 2;
  return m >= 7 && m <= 9 ? 3 : 0;
}

}  // namespace

/// Numbers that no control of these takes: N has five digits (0i 12.2) and so has S, a length five before the
/// point (increment system IS-B), O four, at Haas five. F and T: default, unsourced.
void Interpreter::range_rules(const BlockWords& s) {
  struct Most {
    char letter;
    double value;
  };
  constexpr double kLength = 99999.999, kFeed = 240000.0, kFeedPerTurn = 500.0;
  const bool per_turn = s.code(950) || (feed_mode_ == 95 && !s.code(940));
  for (const Most& m : {Most{'N', 99999.0}, Most{'O', ways_.haas ? 99999.0 : 9999.0}, Most{'S', 99999.0},
                        Most{'T', 99999999.0}, Most{'X', kLength}, Most{'Y', kLength}, Most{'Z', kLength},
                        Most{'I', kLength}, Most{'J', kLength}, Most{'R', kLength}, Most{'Q', kLength},
                        Most{'F', per_turn ? kFeedPerTurn : kFeed}}) {
    if (s.is(m.letter) && std::abs(s.of(m.letter)) > m.value)
      fault(33, "CHK-WORD",
            std::string(1, m.letter) + plain(s.of(m.letter)) + " is more than the control takes, " +
                plain(m.value));
  }
}

void Interpreter::word_rules(const BlockWords& s) {
  int motion = motion_;
  bool cycles = false;
  for (int i = 0; i < s.g_count; ++i) {
    if (group_of_g(s.g[i]) == 1 || group_of_g(s.g[i]) == 9) motion = s.g[i] == 800 ? -1 : s.g[i];
  }
  cycles = group_of_g(motion) == 9;
  const bool arcs = motion == 20 || motion == 30;
  const bool dwells = s.code(40), offset = s.code(541) || s.code(1540), accuracy = s.code(1870);
  const bool pecks = motion == 730 || motion == 830, taps = motion == 740 || motion == 840;
  const auto unused = [&](char c, bool used) {
    if (s.is(c) && !used)
      fault(33, "CHK-WORD",
            std::string("no code of this block uses its word ") + c + "; what it does is not known");
  };
  for (const char c : {'A', 'B', 'C', 'U', 'V', 'W'}) {
    if (s.is(c))
      fault(33, "CHK-WORD",
            std::string("the word ") + c +
                " moves an axis that this machine's three are not; it is not followed");
  }
  unused('D', s.code(410) || s.code(420));
  unused('E', accuracy);
  unused('H', s.code(430));
  const bool shrinks = pecks && ways_.haas;
  unused('I', arcs || shrinks);
  unused('J', arcs || shrinks || (taps && ways_.haas));
  unused('K', shrinks || (cycles && !ways_.haas));
  unused('L', cycles && ways_.haas);
  unused('P', dwells || offset || accuracy || motion == 820 || motion == 890 || taps || shrinks);
  unused('Q', pecks || s.code(51));
  unused('R', arcs || cycles);
  if (arcs && s.is('R') && (s.is('I') || s.is('J')))
    fault(23, "CHK-ARC", "an arc with both R and a centre: R is taken, and the centre passed over");
  if (arcs && s.axes() && !s.is('R') && !s.is('I') && !s.is('J'))
    fault(23, "CHK-ARC", "the arc has neither a centre (I, J) nor a radius (R)");
  for (const char c : {'F', 'S', 'T', 'H', 'D', 'L', 'K', 'P'}) {
    if (s.is(c) && s.of(c) < 0.0)
      fault(33, "CHK-WORD", std::string("the word ") + c + " is " + plain(s.of(c)) + ", below zero");
  }
  for (const char c : {'S', 'T', 'H', 'D', 'L', 'K', 'N', 'O'}) {
    if (c == 'K' && shrinks) continue;  // a length
    if (s.is(c) && s.point[c - 'A'])
      fault(33, "CHK-WORD",
            std::string("the word ") + c + " has a decimal point; it takes whole numbers only");
  }
  if (s.is('O') && named_) fault(32, "CHK-END", "another program (O) begins here");
  named_ = named_ || s.is('O');
}

void Interpreter::code_rules(const BlockWords& s) {
  std::array<bool, 16> groups{};
  for (int i = 0; i < s.g_count; ++i) {
    const auto group = static_cast<std::size_t>(group_of_g(s.g[i]));
    if (group != 0 && groups[group])
      fault(33, "CHK-WORD", "two G codes of one group in one block: the last holds; state one");
    groups[group] = group != 0;
  }
  if (groups[1] && groups[9]) fault(33, "CHK-WORD", "a motion (G0 to G3) and a cycle in one block");
  std::array<bool, 4> ms{};
  for (int i = 0; i < s.m_count; ++i) {
    const auto group = static_cast<std::size_t>(group_of_m(s.m[i]));
    if (group != 0 && ms[group])
      fault(33, "CHK-WORD", "two M codes of one kind (stop, spindle, coolant) in one block");
    ms[group] = group != 0;
  }
  const bool moves = s.axes() || groups[1] || groups[9];
  if (s.code(40)) {
    if (!s.is('P') && !s.is('X')) fault(33, "CHK-WORD", "G4 has neither P nor X, the time that it waits");
    if (s.is('Y') || s.is('Z') || s.is('R') || groups[1] || groups[9] || (s.is('X') && s.is('P')))
      fault(33, "CHK-WORD", "G4 is with a motion or words of axes in one block; its motion is not followed");
  }
  if (s.code(530) && !absolute_ && !s.code(900))
    fault(33, "CHK-WORD", "G53 in incremental mode (G91) is passed over; state G90 before it");
  if ((motion_ == 20 || motion_ == 30) && s.code(530) && !s.code(0) && !s.code(10))
    fault(33, "CHK-WORD", "G53 behind an arc; state G0 with it");
  if (s.m_code(6) && moves) fault(7, "CHK-TOOL-CHANGE", "M6 in a block that moves: state it alone");
  if (rigid_ && s.axes() && !groups[9] && motion_ != 840 && motion_ != 740)
    fault(22, "CHK-TAP-FEED", "a move between M29 and its tapping cycle");
}

/// Without its point a length counts least increments, or millimetres, by a parameter of the machine.
void Interpreter::point_rules(const BlockWords& s) {
  const bool per_turn = feed_mode_ == 95 || s.code(950);
  for (const char c : std::string_view("XYZIJKRQFE")) {
    if (c == 'K' && !(ways_.haas && (motion_ == 830 || motion_ == 730 || s.code(830) || s.code(730))))
      continue;
    if (!s.is(c) || s.point[c - 'A'] || s.of(c) == 0.0) continue;
    if (c == 'F' && !per_turn && !ways_.haas) continue;  // mm/min either way
    if (c == 'J' && (motion_ == 840 || motion_ == 740 || s.code(840) || s.code(740)))
      continue;  // Haas: a factor
    if (c == 'Q' && s.code(51)) continue;
    fault(2, "CHK-POINT",
          std::string(1, c) + plain(s.of(c)) +
              " has no decimal point: it counts thousandths on one machine and " +
              "whole units on another (FANUC parameter 3401, Haas settings 77 and 162); write " + c +
              plain(s.of(c)) + ".");
  }
  const bool waits = s.is('P') && !s.code(541) && !s.code(1540) && !s.code(1870);
  if (waits && s.point['P' - 'A'] && !ways_.seconds)
    fault(33, "CHK-WORD", "P has a decimal point; this machine's P counts whole milliseconds");
}

Interpreter::ListedCodes Interpreter::listed_codes(std::string_view text) {
  ListedCodes out;
  while (!text.empty()) {
    const std::string_view word = text.substr(0, text.find(' '));
    text.remove_prefix(std::min(text.size(), word.size() + 1));
    if (word.empty()) continue;
    out.all = false;
    const auto number = parse_double(word.substr(1));
    if (!number || !(*number >= 0.0 && *number < 10000.0)) continue;
    if (word.front() == 'G') out.g.insert(static_cast<int>(std::lround(10.0 * *number)));
    if (word.front() == 'M') out.m.insert(static_cast<int>(std::lround(*number)));
  }
  return out;
}

/// Each code that the machine lacks is told once, where it stands first.
void Interpreter::known_codes(const BlockWords& s) {
  if (ways_.codes.all) return;
  const auto lacks = [&](const std::string& code) {
    fault(33, "CHK-CODE",
          "the machine's list of codes has no " + code +
              ": write the block without it, or add it to 'codes' under the machine's control if it has it");
  };
  for (int i = 0; i < s.g_count; ++i) {
    if (ways_.codes.g.insert(s.g[i]).second) lacks("G" + plain(0.1 * s.g[i]));
  }
  for (int i = 0; i < s.m_count; ++i) {
    if (ways_.codes.m.insert(s.m[i]).second) lacks("M" + std::to_string(s.m[i]));
  }
}

/// FANUC B-63844EN/02, 4.4 and 4.5.
void Interpreter::arc_rules(const Block& b) {
  const double radius_mm = std::max(b.radius_start, b.radius_end);
  if (!ways_.helices && b.from.z != b.to.z)
    fault(23, "CHK-ARC", "the arc goes up or down, and this machine's control takes no helices");
  if (ways_.largest_radius_mm > 0.0 && radius_mm > ways_.largest_radius_mm)
    fault(23, "CHK-ARC",
          "the arc has a radius of " + mm(radius_mm) + "; this machine's control takes " +
              mm(ways_.largest_radius_mm) + " at most");
  if (!ways_.quadrants || !(b.radius_start > 0.0)) return;
  // At either end its radii differ by as much as the control takes, or by what the last decimal rounds of end
  // and centre.
  const double slack_rad = 2.0 * std::max(kClosureMm, 2.0 * ways_.last_decimal_mm) / b.radius_start;
  const double way = b.move == MoveKind::kArcCw ? -1.0 : 1.0;
  const auto angle = [&](const geometry::Vec3& p) {
    return way * std::atan2(p.y - b.centre.y, p.x - b.centre.x);
  };
  constexpr double kQuadrant = 0.5 * std::numbers::pi;
  const double first = angle(b.from);
  double sweep = angle(b.to) - first;
  while (sweep <= 0.0) sweep += 4.0 * kQuadrant;
  double next = kQuadrant * std::ceil(first / kQuadrant) - first;  // to where the quadrant ends
  if (next <= slack_rad) next += kQuadrant;
  if (sweep > next + slack_rad)
    fault(23, "CHK-ARC",
          "the arc goes on over the end of a quadrant; this machine's control takes arcs of one quadrant");
}

}  // namespace capstan::verify::fanuc

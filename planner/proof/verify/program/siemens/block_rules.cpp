#include <array>
#include <cmath>
#include <string>
#include <string_view>

#include "planner/proof/verify/findings.h"
#include "planner/proof/verify/program/siemens/interpreter.h"

// What the control refuses in one block, and words that do nothing there or nothing that is known.

namespace capstan::verify::siemens {
namespace {

/// Groups of the list of G functions in the programming manual fundamentals; 0: of its block only.
int group_of(int g) {
  if (g <= 3) return 1;
  if (g >= 17 && g <= 19) return 6;
  if (g >= 40 && g <= 42) return 7;
  if ((g >= 54 && g <= 57) || g == 500 || (g >= 505 && g <= 599)) return 8;
  if (g == 60 || g == 64 || (g >= 641 && g <= 646)) return 10;
  if (g == 70 || g == 71 || g == 700 || g == 710) return 13;
  if (g == 90 || g == 91) return 14;
  return g == 94 || g == 95 ? 15 : 0;
}
constexpr std::size_t kGroups = 16;

int group_of_m(int m) {
  if (m <= 2 || m == 30) return 1;
  if ((m >= 3 && m <= 5) || m == 19) return 2;
  return m >= 7 && m <= 9 ? 3 : 0;
}

}  // namespace

void Interpreter::code_rules(const BlockWords& s) {
  std::array<bool, kGroups> groups{};
  for (int i = 0; i < s.g_count; ++i) {
    const auto group = static_cast<std::size_t>(group_of(s.g[i]));
    if (group != 0 && groups[group])
      fault(33, "CHK-WORD", "two G codes of one group in one block, which the control refuses");
    groups[group] = group != 0;
  }
  std::array<bool, 4> ms{};
  for (int i = 0; i < s.m_count; ++i) {
    const auto group = static_cast<std::size_t>(group_of_m(s.m[i]));
    if (group != 0 && ms[group])
      fault(33, "CHK-WORD", "two M codes of one kind (stop, spindle, coolant) in one block");
    ms[group] = group != 0;
  }
  if (s.m_code(6) && (s.axes() || s.is('D')))
    fault(7, "CHK-TOOL-CHANGE", "M6 in a block that moves or states D: state it with T alone");
}

void Interpreter::word_rules(const BlockWords& s) {
  int motion = motion_;
  for (int i = 0; i < s.g_count; ++i) {
    if (s.g[i] >= 0 && s.g[i] <= 3) motion = s.g[i];
  }
  const bool arcs = motion >= 2 && !s.in_machine();
  const auto unused = [&](const std::string& word, bool there, bool used) {
    if (there && !used)
      fault(33, "CHK-WORD", "nothing in this block uses its word " + word + "; what it does is not known");
  };
  for (const char c : std::string_view("ABCEHKLOPQUVW")) {
    unused(std::string(1, c), s.is(c), false);
  }
  unused("I", s.is('I'), arcs);
  unused("J", s.is('J'), arcs);
  unused("CR=", s.is('R'), arcs);
  unused("TURN=", s.turns.has_value(), arcs);
  unused("ADIS=", s.adis.has_value(), s.code(641) || s.code(642));
  unused("ADISPOS=", s.adispos.has_value(), s.code(641) || s.code(642));
  if (arcs && s.axes() && !s.is('R') && !s.is('I') && !s.is('J'))
    fault(23, "CHK-ARC", "the arc has neither a centre (I, J) nor a radius (CR=)");
  if (s.is('R') && (s.is('I') || s.is('J'))) fault(23, "CHK-ARC", "an arc with both CR= and a centre");
  if (s.is('T') && s.tool_name) fault(33, "CHK-WORD-TWICE", "the word T occurs twice in one block");
  for (const char c : std::string_view("FSTD")) {
    if (s.is(c) && s.of(c) < 0.0)
      fault(33, "CHK-WORD", std::string("the word ") + c + " is " + plain(s.of(c)) + ", below zero");
  }
  // Default, unsourced: what no machine has.
  struct Most {
    char letter;
    double value;
    bool whole;
  };
  constexpr double kLength = 999999.999;
  for (const Most& m : {Most{'N', 99999999.0, true}, Most{'T', 32000.0, true}, Most{'D', 9.0, true},
                        Most{'S', 999999.999, false}, Most{'F', 999999.999, false}, Most{'X', kLength, false},
                        Most{'Y', kLength, false}, Most{'Z', kLength, false}, Most{'I', kLength, false},
                        Most{'J', kLength, false}, Most{'R', kLength, false}}) {
    if (!s.is(m.letter)) continue;
    const double v = s.of(m.letter);
    if (std::abs(v) > m.value)
      fault(33, "CHK-WORD",
            std::string(1, m.letter) + plain(v) + " is more than the control takes, " + plain(m.value));
    if (m.whole && v != std::floor(v))
      fault(33, "CHK-WORD", std::string("the word ") + m.letter + " is " + plain(v) + ", no whole number");
  }
}

}  // namespace capstan::verify::siemens

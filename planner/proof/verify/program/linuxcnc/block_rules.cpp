#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <string_view>

#include "planner/proof/verify/findings.h"
#include "planner/proof/verify/program/linuxcnc/interpreter.h"

// What LinuxCNC refuses in one block, or reads otherwise than this reader does. A control stops where it
// refuses a block, with the tool where it is; a word that is read here and not there, or the other way about,
// makes every other check one of another program. Each rule was tried on LinuxCNC's own interpreter
// (rs274, 2.9).

namespace capstan::verify::linuxcnc {
namespace {

/// Codes, times ten, of which a block may have one. Source: LinuxCNC 2.9 manual, "Modal groups".
int group_of_g(int g) {
  switch (g) {
    case 40:
    case 100:
    case 280:
    case 300:
    case 530:
    case 920:
      return 1;
    case 170:
    case 180:
    case 190:
      return 3;
    case 900:
    case 910:
      return 4;
    case 901:
    case 911:
      return 5;
    case 930:
    case 940:
    case 950:
      return 6;
    case 200:
    case 210:
      return 7;
    case 400:
    case 410:
    case 420:
      return 8;
    case 430:
    case 431:
    case 490:
      return 9;
    case 540:
    case 550:
    case 560:
    case 570:
    case 580:
    case 590:
    case 591:
    case 592:
    case 593:
      return 10;
    case 610:
    case 611:
    case 640:
      return 11;
    case 980:
    case 990:
      return 12;
    default:
      // G80 cancels beside any other motion.
      return g == 0 || g == 10 || g == 20 || g == 30 || g == 310 || g == 331 || g == 382 || g == 730 ||
                     (g >= 810 && g <= 890)
                 ? 2
                 : 0;
  }
}

int group_of_m(int m) {
  switch (m) {
    case 0:
    case 10:
    case 20:
    case 300:
    case 600:
      return 1;
    case 30:
    case 40:
    case 50:
      return 2;
    case 60:
      return 3;
    case 70:
    case 80:
    case 90:
      return 4;
    case 480:
    case 490:
      return 5;
    default:
      return 0;
  }
}

std::string_view in_group(int group) {
  static constexpr std::array<std::string_view, 13> kNames = {"",
                                                              "codes of their own block",
                                                              "motions",
                                                              "planes",
                                                              "distance modes",
                                                              "arc modes",
                                                              "feed modes",
                                                              "units",
                                                              "radius compensations",
                                                              "length offsets",
                                                              "work offsets",
                                                              "path modes",
                                                              "cycle returns"};
  return kNames[static_cast<std::size_t>(group)];
}

constexpr int kMostM = 4;
bool cycle_code(int g) { return g == 730 || (g >= 810 && g <= 890); }

}  // namespace

void Interpreter::block_rules(const Line& l, const BlockSaid& s) {
  for (std::size_t i = 1; i < l.words.size(); ++i) {
    if (l.words[i].letter == 'N')
      fault(33, "CHK-WORD", "N follows other words; " + name() + " reads it at the start of a block only");
  }
  word_rules(s);
  code_rules(s);
  if (ways_.mach3) {
    mach3_rules(l, s);
  } else if (std::find(s.g, s.g + s.g_count, 310) != s.g + s.g_count) {
    fault(33, "CHK-CODE", "G31 is none of LinuxCNC's");
  }
}

void Interpreter::word_rules(const BlockSaid& s) {
  bool groups[13] = {};
  int motion = motion_;
  bool dwells = false, offset = false, blend = false, length = false, radius = false, new_unit = false;
  for (int i = 0; i < s.g_count; ++i) {
    const int g = s.g[i];
    if (group_of_g(g) == 2) motion = g;
    if (g == 800 && motion == motion_) motion = -1;
    dwells = dwells || g == 40;
    offset = offset || g == 100;
    blend = blend || g == 640;
    length = length || g == 430;
    radius = radius || g == 410 || g == 420;
    new_unit = new_unit || ((g == 200 || g == 210) && (!units_stated_ || (g == 200) != inch_));
    const int group = group_of_g(g);
    if (group != 0 && groups[group])
      fault(33, "CHK-WORD", "two " + std::string(in_group(group)) + " in one block are refused by " + name());
    groups[group] = group != 0;
  }
  const bool arcs = motion == 20 || motion == 30;
  const bool cycles = cycle_code(motion);
  const auto unused = [&](char c, bool used) {
    if (s.is(c) && !used)
      fault(33, "CHK-WORD",
            std::string("no code of this block uses its word ") + c + "; " + name() + " refuses it");
  };
  for (const char c : {'A', 'B', 'C', 'U', 'V', 'W'}) {
    if (s.is(c))
      fault(33, "CHK-WORD",
            std::string("the word ") + c +
                " moves an axis that this machine's three are not; it is not followed");
  }
  unused('E', false);
  unused('D', radius);
  unused('H', length);
  unused('I', arcs);
  unused('J', arcs);
  unused('K', motion == 331);
  unused('L', cycles);
  // The G64 of Mach3 has no word of its own, whatever the motion of the block may use.
  const bool bare = blend && ways_.mach3;
  unused('P', !bare && (dwells || blend || (arcs && !ways_.mach3) || cycles));
  unused('Q', !bare && (blend || motion == 730 || motion == 830));
  unused('R', arcs || cycles);
  if (arcs && s.is('P') && !dwells && !blend && s.of('P') != 1.0)
    fault(33, "CHK-WORD", "an arc of P" + plain(s.of('P')) + " turns is not followed");
  if (arcs && s.is('R') && (s.is('I') || s.is('J')))
    fault(23, "CHK-ARC", "an arc with both R and a centre is refused by " + name());
  for (const char c : {'F', 'S', 'T', 'H', 'D', 'L'}) {
    if (s.is(c) && s.of(c) < 0.0)
      fault(33, "CHK-WORD",
            std::string("the word ") + c + " is " + plain(s.of(c)) + "; " + name() +
                " refuses what is below zero");
  }
  for (const char c : {'T', 'H', 'D', 'L'}) {
    if (s.is(c) && s.of(c) != std::floor(s.of(c)))
      fault(33, "CHK-WORD",
            std::string("the word ") + c + " is " + plain(s.of(c)) + "; it must be a whole number");
  }
  if (s.is('L') && s.of('L') == 0.0)
    fault(26, "CHK-CYCLE", name() + " refuses a cycle with L0; L counts its repeats, 1 or more");
  if (new_unit && s.is('F'))
    fault(2, "CHK-UNITS",
          "the block changes the unit of length and sets F; " + name() +
              " takes F in the unit before: set F in the next block");
}

void Interpreter::code_rules(const BlockSaid& s) {
  const bool axes = s.is('X') || s.is('Y') || s.is('Z');
  bool g53 = false, dwells = false, motion_said = false, absolute = absolute_;
  int motion = motion_, feed_mode = feed_mode_;
  for (int i = 0; i < s.g_count; ++i) {
    const int g = s.g[i];
    g53 = g53 || g == 530;
    dwells = dwells || g == 40;
    if (g == 900 || g == 910) absolute = g == 900;
    if (g >= 930 && g <= 950) feed_mode = g / 10;
    if (group_of_g(g) != 2) continue;
    motion = g;
    motion_said = true;
  }
  if (dwells) {
    if (!s.is('P') || s.of('P') < 0.0)
      fault(33, "CHK-WORD",
            s.is('P') ? "G4 waits for P" + plain(s.of('P')) + " seconds; P must be 0 or more"
                      : std::string("G4 has no P, the seconds that it waits"));
    if (axes || motion_said)
      fault(33, "CHK-WORD", "G4 is with a motion or words of axes in one block; its motion is not followed");
  }
  if (motion_said && (motion == 20 || motion == 30) && !s.is('I') && !s.is('J') && !s.is('R'))
    fault(23, "CHK-ARC", "the arc has neither a centre (I, J) nor a radius (R)");
  if (g53 && motion != 0 && motion != 10) fault(33, "CHK-WORD", name() + " refuses G53 without G0 or G1");
  if (g53 && !absolute)
    fault(33, "CHK-WORD", name() + " refuses G53 in incremental mode (G91); state G90 before it");
  if (feed_mode == 93 && axes && motion != 0 && motion >= 0 && !s.is('F'))
    fault(18, "CHK-FEED", "a feed move in inverse time (G93) needs an F of its own in its block");
  if (motion == 331 && axes && spindle_ == 0) {
    bool starts = false;
    for (int i = 0; i < s.m_count; ++i) starts = starts || s.m[i] == 30 || s.m[i] == 40;
    if (!starts)
      fault(15, "CHK-SPINDLE", "G33.1 begins with the spindle stopped; start it before (S and M3 or M4)");
  }
  if (motion_said && (motion == 730 || motion == 830) && !s.is('Q'))
    fault(26, "CHK-CYCLE", "the peck cycle has no Q, the depth of one peck");
  if (motion_said && (motion == 820 || motion == 860 || motion == 890) && !s.is('P'))
    fault(26, "CHK-CYCLE", "the cycle has no P, the seconds that it dwells at its bottom");
  if (s.m_count > kMostM)
    fault(33, "CHK-WORD", "more than four M codes in one block are refused by " + name());
  bool groups[6] = {};
  for (int i = 0; i < s.m_count; ++i) {
    const int group = group_of_m(s.m[i]);
    if (group != 0 && groups[group])
      fault(33, "CHK-WORD",
            "two M codes of one kind (stop, spindle, coolant) in one block are refused by " + name());
    groups[group] = group != 0;
  }
}

void Interpreter::command(const std::string& name) {
  if (name.empty() || ways_.mach3) return;
  const std::string what = name == "ABORT"           ? "ends the program here"
                           : name.starts_with("PY")  ? "runs Python, which is not followed"
                           : name.starts_with("LOG") ? "writes into a file of the control"
                                                     : "opens a file of the control for probed points";
  fault(33, "CHK-COMMENT",
        "the comment (" + name + ",...) is a command to LinuxCNC: it " + what + "; take it out");
}

}  // namespace capstan::verify::linuxcnc

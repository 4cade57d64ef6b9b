#include <array>
#include <cmath>
#include <string>
#include <string_view>

#include "planner/proof/verify/findings.h"
#include "planner/proof/verify/program/grbl/interpreter.h"

// What Grbl 1.1 refuses in one block (gcode.c), or reads otherwise than this reader does. It stops the
// program at such a block, with the tool where it is.

namespace capstan::verify::grbl {
namespace {

/// Codes, times ten, of which a block may have one: gcode.h, modal groups. -1: none of Grbl's codes.
int group_of_g(int g) {
  switch (g) {
    case 40:
    case 100:
    case 280:
    case 281:
    case 300:
    case 301:
    case 530:
    case 920:
    case 921:
      return 1;
    case 0:
    case 10:
    case 20:
    case 30:
    case 382:
    case 383:
    case 384:
    case 385:
    case 800:
      return 2;
    case 170:
    case 180:
    case 190:
      return 3;
    case 900:
    case 910:
      return 4;
    case 911:
      return 5;
    case 930:
    case 940:
      return 6;
    case 200:
    case 210:
      return 7;
    case 400:
      return 8;
    case 431:
    case 490:
      return 9;
    case 540:
    case 550:
    case 560:
    case 570:
    case 580:
    case 590:
      return 10;
    case 610:
      return 11;
    default:
      return -1;
  }
}

/// Of Grbl's codes those that shift the work, or move by places that the program does not state.
constexpr std::array<int, 9> kUnfollowed = {100, 280, 281, 300, 301, 383, 384, 385, 920};

int group_of_m(int m) {
  switch (m) {
    case 0:
    case 10:
    case 20:
    case 300:
      return 1;
    case 30:
    case 40:
    case 50:
      return 2;
    case 70:
    case 80:
    case 90:
      return 3;
    case 60:
      return 4;  // who sends the program takes it
    default:
      return -1;
  }
}

std::string code_text(char letter, int tenths) {
  std::string out = letter + std::to_string(tenths / 10);
  if (tenths % 10 != 0) out += "." + std::to_string(tenths % 10);
  return out;
}

}  // namespace

void Interpreter::block_rules(const BlockSaid& s) {
  code_rules(s);
  word_rules(s);
}

void Interpreter::code_rules(const BlockSaid& s) {
  std::array<int, 12> said{};
  bool axis_code = false, g53 = false, dwells = false, lengths = false;
  int motion = motion_;
  for (int i = 0; i < s.g_count; ++i) {
    const int g = s.g[i], group = group_of_g(g);
    if (group < 0) {
      fault(33, "CHK-CODE", code_text('G', g) + " is none of Grbl's codes, which refuses the block");
      continue;
    }
    bool unfollowed = g == 921;
    for (const int u : kUnfollowed) unfollowed = unfollowed || g == u;
    if (unfollowed)
      fault(33, "CHK-CODE",
            code_text('G', g) + " is not followed: what it moves, shifts or sets is not known");
    if (++said[static_cast<std::size_t>(group)] > 1)
      fault(33, "CHK-WORD",
            "two G codes of one group in one block (" + code_text('G', g) +
                " is the second) are refused by Grbl");
    if (group == 2) motion = g == 800 ? -1 : g;
    axis_code = axis_code || (group == 2 && g != 800);
    g53 = g53 || g == 530;
    dwells = dwells || g == 40;
    lengths = lengths || group == 9;
  }
  std::array<int, 5> ms{};
  for (int i = 0; i < s.m_count; ++i) {
    const int group = group_of_m(s.m[i]);
    if (group < 0) {
      fault(33, "CHK-CODE", code_text('M', s.m[i]) + " is none of Grbl's codes, which refuses the block");
    } else if (++ms[static_cast<std::size_t>(group)] > 1) {
      fault(33, "CHK-WORD", "two M codes of one kind (stop, spindle, coolant) in one block");
    }
  }
  const bool axes = s.is('X') || s.is('Y') || s.is('Z');
  if (lengths && axis_code)
    fault(33, "CHK-WORD", "a length (G43.1, G49) and a motion stand in one block; Grbl refuses it");
  bool sets = false;
  for (int i = 0; i < s.g_count; ++i) sets = sets || s.g[i] == 431;
  if (sets && (!s.is('Z') || s.is('X') || s.is('Y')))
    fault(5, "CHK-DYNAMIC-LENGTH", "G43.1 takes Z, the length, and no other axis");
  if (lengths && !sets && axes) fault(33, "CHK-WORD", "G49 stands with words of axes; Grbl refuses it");
  if (g53 && motion != 0 && motion != 10)
    fault(33, "CHK-WORD", "G53 stands with neither G0 nor G1; Grbl refuses it");
  if (g53 && !absolute_) fault(33, "CHK-WORD", "G53 in incremental mode (G91): state G90 before it");
  if (dwells && !s.is('P')) fault(33, "CHK-WORD", "G4 has no P, the seconds that it waits");
  if (dwells && (axes || axis_code))
    fault(33, "CHK-WORD",
          "G4 stands with a motion or words of axes in one block; its motion is not followed");
  const bool arcs = motion == 20 || motion == 30;
  if (arcs && axes && !dwells && !lengths && !s.is('I') && !s.is('J') && !s.is('R'))
    fault(23, "CHK-ARC", "the arc has neither a centre (I, J) nor a radius (R)");
  if (motion == 382 && axis_code && !axes) fault(33, "CHK-WORD", "G38.2 names no axis; Grbl refuses it");
  if (arcs && axis_code && !axes) fault(23, "CHK-ARC", "the arc has no end (X, Y); Grbl refuses it");
  if (feed_mode_ == 93 && axes && motion > 0 && !s.is('F'))
    fault(18, "CHK-FEED", "a feed move in inverse time (G93) needs an F of its own in its block");
}

void Interpreter::word_rules(const BlockSaid& s) {
  int motion = motion_;
  bool dwells = false;
  for (int i = 0; i < s.g_count; ++i) {
    if (group_of_g(s.g[i]) == 2) motion = s.g[i] == 800 ? -1 : s.g[i];
    dwells = dwells || s.g[i] == 40;
  }
  const bool arcs = motion == 20 || motion == 30;
  const auto unused = [&](char c, bool used) {
    if (s.is(c) && !used)
      fault(33, "CHK-WORD", std::string("no code of this block uses its word ") + c + "; Grbl refuses it");
  };
  for (const char c : std::string_view("ABCDEHKLOQUVW")) unused(c, false);
  unused('I', arcs && !s.is('R'));
  unused('J', arcs && !s.is('R'));
  unused('R', arcs);
  unused('P', dwells);
  for (const char c : std::string_view("FNPST")) {
    if (s.is(c) && s.of(c) < 0.0)
      fault(33, "CHK-WORD",
            std::string("the word ") + c + " is " + plain(s.of(c)) + "; Grbl refuses what is below zero");
  }
  constexpr double kMostTool = 255.0;         // gcode.h, MAX_TOOL_NUMBER
  constexpr double kMostNumber = 10000000.0;  // gcode.h, MAX_LINE_NUMBER
  if (s.is('T') && (s.of('T') > kMostTool || s.of('T') != std::floor(s.of('T'))))
    fault(
        4, "CHK-TOOL",
        "T" + plain(s.of('T')) + " is no whole number from 0 to " + plain(kMostTool) + ", which Grbl takes");
  if (s.is('N') && s.of('N') > kMostNumber)
    fault(33, "CHK-WORD", "N" + plain(s.of('N')) + " is more than Grbl takes, " + plain(kMostNumber));
}

}  // namespace capstan::verify::grbl

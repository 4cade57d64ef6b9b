#include "planner/proof/verify/program/grbl/reader.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "planner/ground/base/number.h"
#include "tests/proof/verify/plans.h"

// What Grbl 1.1 makes of blocks, by its sources (reader.h names them).

namespace capstan::verify::grbl {
namespace {

using Kind = Block::Kind;

model::Machine machine(std::vector<model::ControlOption> options = {}) {
  model::Machine m = testing::machine();
  m.control.dialect = "grbl";
  if (!options.empty()) m.control_options = model::ControlOptions{std::move(options)};
  return m;
}
const std::vector<model::ControlOption> kStated{{"tool_length", "g43.1"}, {"tool_change", "m0"}};

constexpr const char* kStart =
    "(CAPSTAN TOOL T1 H1 length=102 diameter=10 id=\"em\" endmill)\nG21 G17 G90 G94 G40 G49 G80\nG53 G0 Z0\n"
    "G54\nT1 M6\nG53 G0 Z0\nS1000 M3\nG0 X5 Y6\nG0 Z20\n";
constexpr long kLinesOfStart = 9;

Program read(const std::string& body, std::vector<model::ControlOption> options = {}) {
  return read_program(kStart + body + "M5\nM30\n", machine(std::move(options)));
}
bool finds(const Program& p, const std::string& code) {
  return std::any_of(p.faults.begin(), p.faults.end(), [&](const auto& f) { return f.code == code; });
}
std::string faults(const Program& p) {
  std::string out;
  for (const auto& f : p.faults) out += std::to_string(f.line) + " " + f.code + " " + f.message + "\n";
  return out;
}
/// Those behind the start.
std::vector<Block> blocks(const Program& p) {
  std::vector<Block> out;
  for (const Block& b : p.blocks) {
    if (b.line > kLinesOfStart) out.push_back(b);
  }
  return out;
}

TEST(GrblReader, MovesArcsAndWaitsAreThoseOfTheText) {
  const auto p = read("G1 Z-1 F300\ng1x10 ; on\nG2 X20 Y16 I5 J5\nG4 P0.5\nG0 Z20\n");
  EXPECT_EQ(faults(p), "");
  const auto b = blocks(p);
  ASSERT_EQ(b.size(), 6U);  // with the end
  EXPECT_EQ(b[0].to.z, -1.0);
  EXPECT_EQ(b[0].feed_mm_min, 300.0);
  EXPECT_EQ(b[0].spindle_rpm, 1000.0);
  EXPECT_EQ(b[0].work_offset, 540);
  EXPECT_EQ(b[1].to.x, 10.0);
  EXPECT_EQ(b[2].move, model::MoveKind::kArcCw);
  EXPECT_EQ(b[2].centre.x, 15.0);
  EXPECT_EQ(b[2].centre.y, 11.0);
  EXPECT_EQ(b[3].kind, Kind::kDwell);
  EXPECT_EQ(b[3].dwell_s, 0.5);
}

// A touch-off leaves the tool anywhere; its length acts from there.
TEST(GrblReader, BehindAChangeTheLengthActsAndThePlaceIsNotKnown) {
  const auto p = read("G53 G0 Z0\nM5\nT2 M6\nG1 Z5 F100\n");
  const auto b = blocks(p);
  const auto change =
      std::find_if(b.begin(), b.end(), [](const Block& c) { return c.kind == Kind::kToolChange; });
  ASSERT_NE(change, b.end());
  EXPECT_EQ(change->tool, 2);
  const Block& behind = *(change + 1);
  EXPECT_FALSE(behind.known_from[2]);
  EXPECT_FALSE(behind.known_from[0]);
  EXPECT_EQ(behind.length_offset, 2);
  EXPECT_TRUE(finds(p, "CHK-HEIGHT"));  // no G53 between
  EXPECT_FALSE(finds(read("G53 G0 Z0\nM5\nT2 M6\nG53 G0 Z0\nG0 X1\n"), "CHK-HEIGHT"));
  EXPECT_TRUE(finds(read("G43.1 Z102\n"), "CHK-DYNAMIC-LENGTH"));
}

// It sets Z of the work offset that acts at the change, and of no other.
TEST(GrblReader, ATouchedOffLengthActsInTheWorkOffsetOfItsChangeAlone) {
  const auto length = [](const std::string& body) {
    const auto b = blocks(read("M5\nG53 G0 Z0\n" + body + "G53 G0 Z0\nG0 X1 Y1\nG1 Z-1 F100\n"));
    const auto cut =
        std::find_if(b.begin(), b.end(), [](const Block& c) { return c.move == model::MoveKind::kLine; });
    EXPECT_NE(cut, b.end()) << body;
    return cut == b.end() ? -2 : cut->length_offset;
  };
  const auto stated = [](const std::string& body) {
    const auto b = blocks(read("M5\nG53 G0 Z0\n(CAPSTAN STEP id=\"a\" n=2)\n" + body));
    return !b.empty() && (b.back().stated & kStatedLength) != 0U;
  };
  EXPECT_EQ(length(""), 1);
  EXPECT_EQ(length("G54\n"), 1);
  EXPECT_EQ(length("G55\n"), -1);
  EXPECT_EQ(length("G55\nT1 M6\n"), 1);
  EXPECT_EQ(length("G55\nT2 M6\n"), 2);
  EXPECT_EQ(length("T2 M6\nG55\n"), -1);
  EXPECT_EQ(length("G55 T2 M6\n"), -1);  // M6 acts first
  EXPECT_EQ(length("G55\nT2 M6\nG54\n"), -1);
  EXPECT_EQ(length("G55\nG54\n"), 1);
  EXPECT_TRUE(stated("G54\n"));
  EXPECT_FALSE(stated("G55\n"));
  EXPECT_TRUE(stated("G55\nT1 M6\n"));
}

// The one that acts is what whoever used the control before left.
TEST(GrblReader, BeforeAWorkOffsetIsStatedATouchOffSetsNoneThatIsKnown) {
  std::string text = kStart;
  text.erase(text.find("G54\n"), 4);
  text.insert(text.find("G0 X5"), "G54\n");
  const auto p = read_program(text + "G1 Z-1 F100\nM5\nM30\n", machine());
  EXPECT_EQ(blocks(p).front().length_offset, -1);
}

// M0 is a hold, and a hold refuses to jog.
TEST(GrblReader, ATouchOffAtM0CannotBeVerified) {
  const std::vector<model::ControlOption> at_m0{{"tool_change", "m0"}};
  const auto p = read("M5\nG53 G0 Z0\nT2\nM0\nG53 G0 Z0\n", at_m0);
  const auto f = std::find_if(p.faults.begin(), p.faults.end(), [](const auto& one) {
    return one.code == "CHK-TOOL-CHANGE" && one.line == kLinesOfStart + 4;
  });
  ASSERT_NE(f, p.faults.end()) << faults(p);
  EXPECT_TRUE(f->undecided);
  EXPECT_NE(f->message.find("tool_length: g43.1"), std::string::npos);
}

TEST(GrblReader, AStatedLengthIsTheHeadersOfTheTool) {
  const std::string change = "M5\nG53 G0 Z0\nT1\nM0\nG53 G0 Z0\n";
  const auto with = [&](const std::string& block) {
    std::string start = kStart;
    start.replace(start.find("T1 M6"), 5, "T1\nM0");
    return read_program(start + block + "G1 Z5 F100\nM5\nM30\n", machine(kStated));
  };
  const auto right = with("G43.1 Z102\n");
  EXPECT_EQ(faults(right), "");
  EXPECT_EQ(blocks(right)[1].length_offset, 1);
  EXPECT_EQ(right.stops.size(), 0U);  // it is a change of tools
  EXPECT_TRUE(finds(with("G43.1 Z112\n"), "CHK-DYNAMIC-LENGTH"));
  EXPECT_TRUE(finds(with("G43.1 Z102 X5\n"), "CHK-DYNAMIC-LENGTH"));
  EXPECT_EQ(blocks(with("G43.1 Z102\nG49\n")).back().length_offset, -1);
  // With the tool that is in the spindle M0 is a stop.
  EXPECT_EQ(with("G43.1 Z102\nT1\nM0\n").stops.size(), 1U);
  EXPECT_TRUE(finds(with("T2 M6\n"), "CHK-TOOL-CHANGE"));
}

// serial.c takes ? ! ~, 0x18 and all beyond ASCII out of the input.
TEST(GrblReader, CharactersThatAreCommandsAreFaultsInCommentsToo) {
  for (const char* text : {"(what?)\n", "(now!)\n", "; ~\n", "G1 X1 (\xc3\xa9)\n", "G1 X1\x18\n"})
    EXPECT_TRUE(finds(read(text), "CHK-SYNTAX")) << text;
  EXPECT_EQ(faults(read("(plain words, 100 % of them; and more)\n")), "");
}

// protocol.c: '\r' ends a line as '\n' does, and a comment with it.
TEST(GrblReader, ACarriageReturnWithinALineIsAFaultInCommentsToo) {
  for (const char* text : {"(a comment\rG0 Z-40\rG0 X200 Y200\r)\n", "; a comment\rG0 Z-40\n",
                           "G1 X1\rG0 Z-40\n", "(a comment)\r\r\n"})
    EXPECT_TRUE(finds(read(text), "CHK-SYNTAX")) << text;
  EXPECT_EQ(faults(read("(a comment)\r\nG1 X1 F100\r\n")), "");
}

TEST(GrblReader, WhatGrblRefusesIsAFault) {
  for (const char* text : {"G43 H1\n", "G64 P0.01\n", "G81 X1 Y1 Z-1 R2\n", "G33.1 Z-5 K1\n", "G59.1\n",
                           "G61.1\n", "G95\n", "G41 D1\n", "M48\n", "M60\n"})
    EXPECT_TRUE(finds(read(text), "CHK-CODE")) << text;
  for (const char* text :
       {"G1 X1 A5 F100\n", "G1 X1 P2 F100\n", "G0 G1 X1\n", "G53 X1 G2 I1\n", "G4\n", "G4 P1 X2\n", "S-5\n",
        "G49 G0 X1\n", "G80\nX5\n", "G1 X1 E5 F100\n", "D1\n", "M3 M4\n", "M8 M9\n", "G91\nG53 G0 Z0\n"})
    EXPECT_TRUE(finds(read(text), "CHK-WORD")) << text;
  for (const char* text : {"G10 L2 P1 X1\n", "G92 X0\n", "G28\n", "G38.3 Z-5 F50\n", "G30\n"})
    EXPECT_TRUE(finds(read(text), "CHK-CODE")) << text;
  EXPECT_TRUE(finds(read("G2 X9 Y9\n"), "CHK-ARC"));
  EXPECT_TRUE(finds(read("T256 M6\n"), "CHK-TOOL"));
  EXPECT_TRUE(finds(read("T-1 M6\n"), "CHK-WORD"));
  EXPECT_TRUE(finds(read("/G1 X1 F100\n"), "CHK-SYNTAX"));
  EXPECT_TRUE(finds(read("%\n"), "CHK-SYNTAX"));
  EXPECT_TRUE(finds(read("(open\n"), "CHK-SYNTAX"));
  EXPECT_TRUE(finds(read("G1 X\n"), "CHK-NUMBER"));
  EXPECT_TRUE(finds(read("G1 X1.2.3 F1\n"), "CHK-NUMBER"));
  EXPECT_TRUE(finds(read("G1 X1 X2 F1\n"), "CHK-WORD-TWICE"));
  EXPECT_TRUE(finds(read("G20\n"), "CHK-UNITS"));
  EXPECT_TRUE(finds(read("M7\n"), "CHK-CODE"));
  EXPECT_EQ(faults(read("M7\n", {{"mist", "yes"}})), "");
}

TEST(GrblReader, G382EndsAtATouchWhoseAxisIsNotKnownBehindIt) {
  const Program p = read("G38.2 Z-5 F50\n");
  EXPECT_EQ(faults(p), "");
  const auto probes = std::find_if(p.blocks.begin(), p.blocks.end(), [](const Block& b) { return b.probes; });
  ASSERT_NE(probes, p.blocks.end());
  EXPECT_EQ(probes->to.z, -5.0);
  EXPECT_TRUE(finds(read("G38.2 F50\n"), "CHK-WORD"));
  EXPECT_FALSE(read("G38.2 Z-5 F50\nG1 X9\n")
                   .blocks[static_cast<std::size_t>(probes - p.blocks.begin()) + 1]
                   .known_from[2]);
}

// protocol.h: 80 characters with the end; blanks and comments are not kept.
TEST(GrblReader, ALineIsAsLongAsGrblTakes) {
  const std::string digits(70, '0');
  const auto block = [&](std::size_t n) { return "G1 X1." + digits.substr(0, n - 5) + " (and a comment)\n"; };
  EXPECT_EQ(faults(read("F100\n" + block(kLongestBlock - 4) + "F100\n")), "");
  std::string longer = "G1 X1." + std::string(kLongestBlock - 4, '0') + "\n";
  EXPECT_TRUE(finds(read(longer), "CHK-SYNTAX"));
}

TEST(GrblReader, ItEndsWithM2OrM30AndNothingFollows) {
  EXPECT_TRUE(read("").ended);
  EXPECT_TRUE(finds(read_program(std::string(kStart) + "M5\nM2\nG0 X1\n", machine()), "CHK-END"));
}

}  // namespace
}  // namespace capstan::verify::grbl

#include "planner/proof/verify/program_signs.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

namespace capstan::verify {
namespace {

std::string told(std::string_view program) {
  const auto sign = dialect_sign(program);
  if (!sign) return "any";
  std::string out;
  for (const auto d : sign->dialects) out += (out.empty() ? "" : " ") + std::string(d);
  return out + " " + std::to_string(sign->line);
}

TEST(DialectSign, AProgramNumberIsFanucsOrHaass) {
  EXPECT_EQ(told("%\nO0001\nG21\n"), "fanuc haas 2");
  EXPECT_EQ(told("%\no1234 (PART)\nG21\n"), "fanuc haas 2");
  EXPECT_EQ(told("O12345678\n"), "fanuc haas 1");
}

TEST(DialectSign, WhatOnlyOneOfThemReadsTellsThemApart) {
  EXPECT_EQ(told("%\nO0001\nG187 P3 E0.01\n"), "haas 3");
  EXPECT_EQ(told("%\nO0001\nN10 G154 P2\n"), "haas 3");
  EXPECT_EQ(told("%\nO0001\nG5.1 Q1\n"), "fanuc 3");
  EXPECT_EQ(told("G54.1 P7\n"), "fanuc haas 1");
  EXPECT_EQ(told("M29 S500\n"), "fanuc haas 1");
}

TEST(DialectSign, OWordsNamedParametersAndAToleranceAreLinuxCncs) {
  EXPECT_EQ(told("O100 SUB\n"), "linuxcnc 1");
  EXPECT_EQ(told("o<peck> call [3]\n"), "linuxcnc 1");
  EXPECT_EQ(told("G0 X#<_x>\n"), "linuxcnc 1");
  EXPECT_EQ(told("G64 P0.01\n"), "linuxcnc 1");
}

TEST(DialectSign, TheHeadOfAConversationalProgramIsHeidenhains) {
  EXPECT_EQ(told("0 BEGIN PGM PART MM\n1 BLK FORM 0.1 Z X+0 Y+0 Z-20\n"), "heidenhain 1");
  EXPECT_EQ(told("BEGIN PGM 123 MM\n"), "heidenhain 1");
}

TEST(DialectSign, WhatEachReadsSaysNothing) {
  EXPECT_EQ(told(""), "any");
  EXPECT_EQ(told("%\nG21 G17 G90\nG64\nG54\nT1 M6\nG1 X1. F100.\nM30\n%\n"), "any");
  EXPECT_EQ(told("(O0001)\n(G64 P0.01) G64 ;P1\n"), "any");
  EXPECT_EQ(told("G64.1 P1\nM298 S1\n"), "any");  // other words
}

TEST(DialectSign, ABlockThatIsTooLongOrEndsNowhereIsNoTrouble) {
  EXPECT_EQ(told(std::string(100000, 'O')), "any");  // no keyword of LinuxCNC stands behind it
  EXPECT_EQ(told("((((((" + std::string(1000, ')')), "any");
  EXPECT_EQ(told("N"), "any");
  EXPECT_EQ(told("/"), "any");
}

TEST(StepsOfProgram, AreTheMarkersInTheirOrder) {
  model::Machine machine;
  machine.control.dialect = "linuxcnc";
  const std::string text = "(CAPSTAN STEP id=\"b\" n=1)\nG0 X0\n(CAPSTAN STEP id=\"a%20c\" n=2)\nM2\n";
  EXPECT_EQ(steps_of_program(text, machine), (std::vector<std::string>{"b", "a c"}));
  EXPECT_TRUE(steps_of_program("G0 X0\nM2\n", machine).empty());
  machine.control.dialect = "abacus";
  EXPECT_TRUE(steps_of_program(text, machine).empty());
}

TEST(MachineOfProgram, IsReadFromTheHeaderOfEveryControlsProgram) {
  EXPECT_EQ(machine_of_program("(CAPSTAN PROGRAM version=1)\n(machine: generic_vmc)\nG21\n"), "generic_vmc");
  EXPECT_EQ(machine_of_program("%\nO0001\n(MACHINE: GENERIC_VMC)\r\n"), "GENERIC_VMC");
  EXPECT_EQ(machine_of_program(";part: A\n;machine: small router \n"), "small router");
  EXPECT_EQ(machine_of_program("0 BEGIN PGM A MM\n6 ; machine: tnc\n"), "tnc");
}

TEST(MachineOfProgram, IsNoneBehindTheFirstStepOrInABlock) {
  EXPECT_EQ(machine_of_program("(CAPSTAN STEP id=\"a\" n=1)\n(machine: late)\n"), "");
  EXPECT_EQ(machine_of_program("G0 X1 (machine: block)\n"), "");
  EXPECT_EQ(machine_of_program(""), "");
}

}  // namespace
}  // namespace capstan::verify

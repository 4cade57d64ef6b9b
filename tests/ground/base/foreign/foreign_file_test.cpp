#include "planner/ground/base/foreign/foreign_file.h"

#include <gtest/gtest.h>

#include <string>
#include <utility>
#include <vector>

#include "tests/support/corpus.h"

namespace capstan {
namespace {

using namespace std::string_literals;

/// Beginnings as the formats' own documents show them.
std::vector<std::pair<std::string, std::string>> foreign() {
  std::string iges(72, ' ');
  iges.append("S      1\n");
  return {
      {"999\nmade by hand\n  0\nSECTION\n  2\nHEADER\n", "DXF"},
      {"0\r\nSECTION\r\n2\r\nENTITIES\r\n", "DXF"},
      {"%PDF-1.7\n%...", "PDF"},
      {"400 30 1 0\n16 Autodesk AutoCAD 8 ACIS 4.0 24 Mon Jan 01 00:00:00 2001\n", "ACIS"},
      {"22200 0 1 0\r\n@16 Autodesk AutoCAD @12 ASM 222.0.0 @24 ...\r\n", "ACIS"},
      {"ASM BinaryFile4 ...", "ACIS"},
      {"AC1027\0\0\0"s, "DWG"},
      {"\xD0\xCF\x11\xE0\xA1\xB1\x1A\xE1 SldPrt", "SolidWorks"},
      {"V5_CFV2\0"s, "CATIA"},
      {"**ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz****", "Parasolid"},
      {iges, "IGES"},
      {"PK\x03\x04...", "ZIP"},
      {"%\nO1001 (PART)\nN10 G21 G90\nG0 X0. Y0.\nM30\n%\n", "G-code"},
      {"; a comment\nG21\nG90 G1 X10 F200\nM2\n", "G-code"},
      {"<?xml version=\"1.0\"?><a/>", "XML"},
  };
}

TEST(ForeignFile, IsToldForWhatItIs) {
  for (const auto& [bytes, word] : foreign()) {
    const auto told = foreign_file(bytes);
    ASSERT_TRUE(told) << word;
    EXPECT_NE(told->what.find(word), std::string_view::npos) << told->what;
    EXPECT_FALSE(told->hint.empty());
  }
}

TEST(ForeignFile, IsAProgramWhereItsLinesAreThoseOfOneThoughSomeAreTheControlsOwn) {
  const auto siemens = foreign_file(
      ";part: PLATE\n;file: two.p21\nG17 G40 G90 G94 G710\nMCALL\nT=\"MILL\" M6\nG0 X0 Y0\nG1 Z-1 "
      "F100\nM30\n");
  ASSERT_TRUE(siemens);
  EXPECT_TRUE(siemens->program);
  // More than 50 lines of comments at its head.
  std::string head;
  for (int n = 0; n < 80; ++n) head += "; CAPSTAN a line\n";
  EXPECT_TRUE(foreign_file(head + "G21 G90\nG0 X0\nM2\n"));
  EXPECT_FALSE(foreign_file("%PDF-1.7\n")->program);
  EXPECT_FALSE(foreign_file("M3 screws\nM4 screws\nM5 screws\n")) << "a list of words";
}

TEST(ForeignFile, NoPartOrPlanIsTakenForOne) {
  const std::string examples = capstan::testing::source_dir() + "/examples/";
  for (const char* name : {"bracket.p21", "two_setups.p21", "surface.stl"})
    EXPECT_FALSE(foreign_file(capstan::testing::slurp(examples + name))) << name;
  for (const char* text :
       {"", " ", "{\"version\": 1}", "solid part\nendsolid\n", "T1 P1 D10 Z50\n", "ISO-10303-21;\nHEADER;\n",
        "/* G1 */ ISO-10303-21;", "400 30 1 0\n16 20 3\n", "capstan_machine: 1\nid: m1\naxes: [x, y]\n"})
    EXPECT_FALSE(foreign_file(text)) << text;
}

}  // namespace
}  // namespace capstan

#include "planner/door/service/foreign/foreign_file.h"

#include <gtest/gtest.h>

#include <string>
#include <utility>
#include <vector>

#include "planner/door/service/reading.h"
#include "tests/support/corpus.h"

namespace capstan::service {
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

TEST(ForeignFile, EndsReadingWithOneErrorThatNamesItAndSaysWhatToDo) {
  for (const auto& [bytes, word] : foreign()) {
    Job job;
    const auto plan = read_plan(bytes, "part.xyz", job);
    ASSERT_FALSE(plan) << word;
    EXPECT_EQ(plan.error().code, "READ-FOREIGN");
    EXPECT_NE(plan.error().message.find(word), std::string::npos) << plan.error().message;
    EXPECT_EQ(plan.error().file, "part.xyz");
    EXPECT_TRUE(job.diagnostics().empty()) << "no fault of a reader for another format";
  }
}

TEST(ForeignFile, NoPartOrPlanIsTakenForOne) {
  const std::string examples = capstan::testing::source_dir() + "/examples/";
  for (const char* name : {"bracket.p21", "two_setups.p21", "surface.stl"})
    EXPECT_FALSE(foreign_file(capstan::testing::slurp(examples + name))) << name;
  for (const char* text : {"", " ", "{\"version\": 1}", "solid part\nendsolid\n", "T1 P1 D10 Z50\n",
                           "ISO-10303-21;\nHEADER;\n", "/* G1 */ ISO-10303-21;"})
    EXPECT_FALSE(foreign_file(text)) << text;
}

}  // namespace
}  // namespace capstan::service

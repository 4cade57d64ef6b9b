#include "planner/controls/gcode/text.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace capstan::controls::gcode {
namespace {

using Lines = std::vector<std::string>;

TEST(GcodeText, ACommentIsPlainAndHasNoBracketsInside) {
  EXPECT_EQ(comment_lines("bore \xC3\x98 6 (two)\n", 80), Lines{"bore ? 6 [two] "});
  EXPECT_EQ(comment_lines("", 80), Lines{""});
}

// 12 characters of a line stay free: 72 leave 60.
TEST(GcodeText, ACommentThatIsLongerThanALineGoesOnInTheNextAndLosesNoWord) {
  const std::string text =
      "set-up 1: the workpiece's +z up, its +x to the right, its +y to the back, and nothing is left out";
  const Lines lines = comment_lines(text, 72);
  EXPECT_EQ(lines, (Lines{"set-up 1: the workpiece's +z up, its +x to the right, its +y",
                          "   to the back, and nothing is left out"}));
  for (const std::string& l : lines) EXPECT_LE(l.size(), 60U);
}

TEST(GcodeText, AWordThatIsLongerThanALineIsBroken) {
  std::string all;
  for (const std::string& l : comment_lines(std::string(500, 'a'), 80)) {
    EXPECT_LE(l.size(), 68U);
    all += l.substr(std::min(l.find('a'), l.size()));
  }
  EXPECT_EQ(all, std::string(500, 'a'));
  EXPECT_FALSE(comment_lines("abcdefgh", 0).empty());
}

// read_comment takes two blanks before a marker at most.
TEST(GcodeText, ALineThatGoesOnIsNeverReadAsAMarker) {
  const std::string text = "part: " + std::string(60, 'x') + " CAPSTAN STEP id=\"a\" n=1";
  const Lines lines = comment_lines(text, 72);
  ASSERT_GT(lines.size(), 1U);
  for (const std::string& l : lines) {
    const std::size_t at = l.find("CAPSTAN");
    EXPECT_TRUE(at == std::string::npos || at > 2) << l;
  }
}

TEST(GcodeText, ATextIsShortenedByWords) {
  EXPECT_EQ(shortened("clamp the piece anew", 20), "clamp the piece anew");
  EXPECT_EQ(shortened("clamp the piece anew", 19), "clamp the piece...");
}

// As in a URL: a blank is 20, u umlaut C3 BC, brackets 28 and 29, a line's end 0A, the sign itself 25.
TEST(GcodeText, AMarkerEncodesWhatWouldEndItAsInAUrl) {
  EXPECT_EQ(marker_text("bohrung \xC3\xBC (1)\nM3%41"), "bohrung%20%C3%BC%20%281%29%0AM3%2541");
}

TEST(GcodeText, MarkersOfLongIdsDifferWhereTheIdsDo) {
  const std::string a = marker_text(std::string(500, 'a')), b = marker_text(std::string(501, 'a'));
  EXPECT_NE(a, b);
  EXPECT_LE(a.size(), 160U);
}

}  // namespace
}  // namespace capstan::controls::gcode

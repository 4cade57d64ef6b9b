#include "planner/controls/gcode/text.h"

#include <gtest/gtest.h>

namespace capstan::controls::gcode {
namespace {

TEST(GcodeText, ACommentIsPlainHasNoBracketsInsideAndEndsWithinTheLine) {
  EXPECT_EQ(comment_text("bore \xC3\x98 6 (two)\n", 80), "bore ? 6 [two] ");
  EXPECT_LE(comment_text(std::string(500, 'a'), 80).size(), 78U);  // with its parentheses 80
  EXPECT_EQ(comment_text("a", 0), "");
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

#include "planner/ground/base/text.h"

#include <gtest/gtest.h>

#include <numbers>

namespace capstan {
namespace {

TEST(LowerText, ChangesAsciiLettersOnly) {
  EXPECT_EQ(lower_text("M6 x 1 [LH] @Z"), "m6 x 1 [lh] @z");
  EXPECT_EQ(lower_text("FR\xC3\x84SER"), "fr\xC3\x84ser");
  EXPECT_EQ(lower_text(""), "");
}

TEST(MmText, HasTheUnitAndAtMostSoManyDecimals) {
  EXPECT_EQ(mm_text(1.5), "1.5 mm");
  EXPECT_EQ(mm_text(1.23456), "1.235 mm");
  EXPECT_EQ(mm_text(1.23456, 4), "1.2346 mm");
  EXPECT_EQ(mm_text(-0.0001), "0 mm");
}

TEST(DegText, IsInDegrees) {
  EXPECT_EQ(deg_text(std::numbers::pi / 4.0), "45 deg");
  EXPECT_EQ(deg_text(0.1, 2), "5.73 deg");
}

TEST(Utf8, IsToldFromOtherBytes) {
  for (const char* text : {"", "bore", "Bohrung \xC3\x98", "\xE2\x82\xAC", "\xF0\x9F\x94\xA9"})
    EXPECT_TRUE(is_utf8(text)) << text;
  // Latin-1, a character cut off, an overlong one, half of a pair, beyond U+10FFFF, UTF-16's mark.
  for (const char* text :
       {"Bohrung \xD8", "\xE2\x82", "\xC0\xAF", "\xED\xA0\x80", "\xF4\x90\x80\x80", "\xFF\xFE"})
    EXPECT_FALSE(is_utf8(text)) << text;
}

TEST(Utf8, StandsForOtherBytesAndIsCutBetweenCharacters) {
  EXPECT_EQ(utf8_text("a\xD8 b"), "a\xEF\xBF\xBD b");
  EXPECT_EQ(utf8_text("a\xC3\x98 b"), "a\xC3\x98 b");
  EXPECT_EQ(utf8_text("a\xC3\x98 b", 2), "a");
  EXPECT_EQ(utf8_text("a\xC3\x98 b", 3), "a\xC3\x98");
}

TEST(Text, IsEscapedWithWhatXmlReadsAsMarkup) {
  EXPECT_EQ(xml_escaped("a <b> & \"c\" 'd'"), "a &lt;b&gt; &amp; &quot;c&quot; 'd'");
}

TEST(Text, OfAnyBytesHasNothingThatXmlDoesNotTake) {
  EXPECT_EQ(xml_text("a\x01<\n\xC3\x98\xD8"), "a &lt; \xC3\x98\xEF\xBF\xBD");
  EXPECT_EQ(xml_text("\xEF\xBF\xBE|\xEF\xBF\xBF"), "\xEF\xBF\xBD|\xEF\xBF\xBD");
}

}  // namespace
}  // namespace capstan

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

TEST(Text, IsEscapedWithWhatXmlReadsAsMarkup) {
  EXPECT_EQ(xml_escaped("a <b> & \"c\" 'd'"), "a &lt;b&gt; &amp; &quot;c&quot; 'd'");
}

}  // namespace
}  // namespace capstan

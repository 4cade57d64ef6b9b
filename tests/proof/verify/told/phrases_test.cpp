#include "planner/proof/verify/told/phrases.h"

#include <gtest/gtest.h>

namespace capstan::verify {
namespace {

bool alike(std::string_view a, std::string_view b) {
  const auto x = phrases_of(a), y = phrases_of(b);
  return x.size() == y.size() && stands_at(x, y, 0, 0.00051);
}

TEST(Phrases, ATextIsTheSameInCapitalsWithPointsAndOtherMarks) {
  EXPECT_TRUE(alike("zero G54: Z0 30 mm above; that is X0 Y0 Z-1.5",
                    "ZERO G54: Z0 30. MM ABOVE, THAT IS X0. Y0. Z-1.5"));
  EXPECT_TRUE(alike("the workpiece's +Z up (twice)", "THE WORKPIECE'S +Z UP [TWICE]"));
  EXPECT_TRUE(alike("50 % of it", "50 PERCENT OF IT"));
  EXPECT_TRUE(
      alike("Spannb\xc3\xbc"
            "chse 8",
            "Spannb?chse 8"));
}

TEST(Phrases, AnotherNumberSignSideOrNameIsAnotherText) {
  EXPECT_FALSE(alike("Z0 30 mm", "Z0 60 mm"));
  EXPECT_FALSE(alike("Z0 30 mm", "Z0 -30 mm"));
  EXPECT_FALSE(alike("its +Z up", "its -Z up"));
  EXPECT_FALSE(alike("Z1 up", "Z-1 up"));
  EXPECT_FALSE(alike("at its left side", "at its right side"));
  EXPECT_FALSE(alike("set G54", "set G55"));
}

TEST(Phrases, AHyphenWithinAWordIsNoSign) {
  const auto said = phrases_of("set-up 2: clamp");
  ASSERT_EQ(said.size(), 5U);
  EXPECT_EQ(said[0].word, "SET");
  EXPECT_EQ(said[1].word, "UP");
  EXPECT_EQ(said[2].number, 2.0);
  EXPECT_EQ(said[3].word, ":");
  EXPECT_EQ(said[4].word, "CLAMP");
}

TEST(Phrases, NumbersWithinTheUnitCountAsEqual) {
  EXPECT_TRUE(alike("X53.3488", "X53.349"));
  EXPECT_FALSE(alike("X53.347", "X53.349"));
}

}  // namespace
}  // namespace capstan::verify

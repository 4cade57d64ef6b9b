#include "planner/files/exchange/toolpaths/distance_text.h"

#include <gtest/gtest.h>

#include <limits>

namespace capstan::exchange {
namespace {

// The square of 1e200 overflows: a gap between such points ended the reading by an exception.
TEST(DistanceText, OfADistanceThatOverflowedIsWordsAndNoException) {
  EXPECT_EQ(distance_text(0.5249, 3), "0.525 mm");
  EXPECT_EQ(distance_text(1e200 * 1e200, 3), "more mm than a number holds");
  EXPECT_EQ(distance_text(std::numeric_limits<double>::quiet_NaN(), 3), "more mm than a number holds");
}

}  // namespace
}  // namespace capstan::exchange

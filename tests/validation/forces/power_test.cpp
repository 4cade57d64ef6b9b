#include "tests/validation/forces/power.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace capstan::validation {
namespace {

// What planning expects may be more than a table says; far less would overload a spindle.
TEST(ExpectedPower, IsWithinAQuarterOfMostRowsOfEachTableAndNowhereBelow84Percent) {
  const auto rows = power_rows();
  EXPECT_EQ(rows.size(), 56U);
  EXPECT_EQ(rows_within(rows, "Mitsubishi"), std::pair(14, 24));
  EXPECT_EQ(rows_within(rows, "Tungaloy"), std::pair(13, 18));
  EXPECT_EQ(rows_within(rows, "Machinery's Handbook"), std::pair(10, 14));
  for (const PowerRow& r : rows) EXPECT_GE(r.ratio(), 0.84) << r.source << ": " << r.row << " at " << r.fz_mm;
}

TEST(ExpectedPower, OfEachCommonMaterialIsWithinAQuarterOfOneRowAtLeast) {
  for (const char* material : {"C45", "42CrMo4", "42CrMo4+QT", "C60", "AISI 303", "AISI 304", "GG25",
                               "S235JR", "CW614N", "EN AW-6061", "EN AW-7075"}) {
    double nearest = 1e300;
    for (const PowerRow& r : power_rows()) {
      if (r.material == material) nearest = std::min(nearest, std::abs(r.ratio() - 1.0));
    }
    EXPECT_LE(nearest, kPowerBound) << material;
  }
}

}  // namespace
}  // namespace capstan::validation
